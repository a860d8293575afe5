#include "derham/dual/dual_report.hpp"

#include "derham/dual/dual_recursion.hpp"
#include "derham/dual/kept_volumes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace derham {

namespace {

/// The verdict on simplices that come block after block, in increasing order.
class StarJudge {
 public:
  void add(const detail::SettledBlock& block) {
    detail::SettledBlock::Row star{};
    verdict_.min = std::min(verdict_.min, block.stars(star));
    std::array<Index, detail::SettledBlock::capacity> zero{}, negative{};
    std::size_t zeros = 0, negatives = 0, defined = 0;
    for (std::size_t i = 0; i < block.simplices.size(); ++i) {  // without a branch: signs look random
      zero[zeros] = negative[negatives] = block.simplices[i];
      const bool is_defined = !std::isnan(star[i]);
      zeros += static_cast<std::size_t>(is_defined & (block.dual[i] == 0));
      negatives += static_cast<std::size_t>(is_defined & (block.dual[i] < 0));
      defined += static_cast<std::size_t>(is_defined);
    }
    verdict_.zero.insert(verdict_.zero.end(), zero.data(), zero.data() + zeros);
    verdict_.negative.insert(verdict_.negative.end(), negative.data(), negative.data() + negatives);
    verdict_.undefined += static_cast<Index>(block.simplices.size() - defined);
  }

  /// Adds simplices that come after those that have been judged here.
  void append(const StarJudge& later) {
    verdict_.min = std::min(verdict_.min, later.verdict_.min);
    verdict_.undefined += later.verdict_.undefined;
    verdict_.zero.insert(verdict_.zero.end(), later.verdict_.zero.begin(), later.verdict_.zero.end());
    verdict_.negative.insert(verdict_.negative.end(), later.verdict_.negative.begin(), later.verdict_.negative.end());
  }

  [[nodiscard]] StarVerdict verdict() const {
    StarVerdict result = verdict_;
    if (result.min == none) result.min = std::numeric_limits<double>::quiet_NaN();
    return result;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::infinity();

  StarVerdict verdict_{.min = none, .zero = {}, .negative = {}, .undefined = 0};
};

template <int n>
using Judges = std::array<StarJudge, n + 1>;

/// Keeps volumes and dual volumes, and judges them on the way.
template <int n>
class JudgedVolumes {
 public:
  JudgedVolumes(const SimplicialComplex<n>& K, CircumcentricDual<n>& result)
      : kept_(K, result), judges_(detail::dual_pieces(K)) {}

  template <int k>
  void take(std::size_t piece, const detail::SettledBlock& block) {
    kept_.template take<k>(piece, block);
    judges_[piece][k].add(block);
  }

  [[nodiscard]] const Judges<n>& joined() {
    for (std::size_t piece = 1; piece < judges_.size(); ++piece)
      for (std::size_t k = 0; k <= n; ++k) judges_[0][k].append(judges_[piece][k]);
    return judges_[0];
  }

 private:
  detail::KeptVolumes<n> kept_;
  std::vector<Judges<n>> judges_;
};

StarJudge judged(const std::vector<double>& dual, const std::vector<double>& volume) {
  constexpr std::size_t capacity = detail::SettledBlock::capacity;
  StarJudge judge;
  std::array<Index, capacity> simplices{};
  for (std::size_t begin = 0; begin < dual.size(); begin += capacity) {
    std::iota(simplices.begin(), simplices.end(), static_cast<Index>(begin));
    judge.add({{simplices.data(), std::min(capacity, dual.size() - begin)}, &volume[begin], &dual[begin]});
  }
  return judge;
}

// For each facet 1 if it has one top simplex, more if it has more.
template <int n>
std::vector<std::uint8_t> top_counts(const SimplicialComplex<n>& K) {
  std::vector<std::uint8_t> count(static_cast<std::size_t>(K.size(n - 1)));
  for (const Index f : K.face_table(n)) {
    auto& own = count[static_cast<std::size_t>(f)];
    own = static_cast<std::uint8_t>(2 * own + 1);  // 0, 1, 3, 7, …, 255, 255
  }
  return count;
}

// The verdicts on facets.
template <int n>
void judge_facets(const SimplicialComplex<n>& K, std::span<const double> dual, DualReport& report) {
  const auto is_sound = [](double volume) { return volume >= 0; };
  if (std::ranges::all_of(dual, is_sound)) return;
  const auto count = top_counts(K);
  for (std::size_t f = 0; f < dual.size(); ++f)
    if (!is_sound(dual[f])) (count[f] == 1 ? report.one_sided : report.pairwise_delaunay) = false;
}

template <int n>
DualReport report_of(const SimplicialComplex<n>& K, const CircumcentricDual<n>& dual, const Judges<n>& judges) {
  DualReport report;
  report.well_centered = dual.well_centered;
  report.degenerate = dual.degenerate;
  for (const StarJudge& judge : judges) report.star.push_back(judge.verdict());
  if constexpr (n > 0) judge_facets(K, dual.dual[n - 1], report);
  return report;
}

}  // namespace

template <int n>
DualReport dual_report(const SimplicialComplex<n>& K, const CircumcentricDual<n>& dual) {
  Judges<n> judges;
  for (std::size_t k = 0; k <= n; ++k) judges[k] = judged(dual.dual[k], dual.primal[k]);
  return report_of(K, dual, judges);
}

template <int n>
JudgedDual<n> judged_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  JudgedDual<n> result;
  JudgedVolumes<n> sink(K, result.volumes);
  detail::run_recursion(K, geometry, sink, result.volumes);
  result.report = report_of(K, result.volumes, sink.joined());
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                   \
  template DualReport dual_report<n>(const SimplicialComplex<n>&, const CircumcentricDual<n>&); \
  template JudgedDual<n> judged_dual<n>(const SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
