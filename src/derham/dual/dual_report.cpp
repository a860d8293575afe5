#include "derham/dual/dual_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace derham {

namespace {

// Collects the indices for which a condition holds, a block at a time: no branch depends on the condition.
class Selection {
 public:
  explicit Selection(std::vector<Index>& list) : list_(list) {}

  void add(std::size_t i, bool condition) noexcept {
    block_[count_] = static_cast<Index>(i);
    count_ += condition ? 1 : 0;
  }
  // To be called after at most `capacity` times add.
  void flush() {
    list_.insert(list_.end(), block_.begin(), block_.begin() + static_cast<std::ptrdiff_t>(count_));
    count_ = 0;
  }
  static constexpr std::size_t capacity = 1024;

 private:
  std::vector<Index>& list_;
  std::array<Index, capacity> block_{};
  std::size_t count_ = 0;
};

StarVerdict star_verdict(std::span<const double> dual, std::span<const double> primal) {
  StarVerdict verdict;
  double least = std::numeric_limits<double>::infinity();
  Selection zero(verdict.zero), negative(verdict.negative);
  for (std::size_t begin = 0; begin < dual.size(); begin += Selection::capacity) {
    for (std::size_t i = begin; i < std::min(begin + Selection::capacity, dual.size()); ++i) {
      const double star = star_entry(dual[i], primal[i]);
      const bool defined = !std::isnan(star);
      least = star < least ? star : least;
      verdict.undefined += defined ? 0 : 1;
      zero.add(i, dual[i] == 0 && defined);
      negative.add(i, dual[i] < 0 && defined);
    }
    zero.flush();
    negative.flush();
  }
  const bool any = static_cast<std::size_t>(verdict.undefined) < dual.size();
  verdict.min = any ? least : std::numeric_limits<double>::quiet_NaN();
  return verdict;
}

// How many top simplices each facet has, 2 for more.
template <int n>
std::vector<std::uint8_t> top_counts(const SimplicialComplex<n>& K) {
  std::vector<std::uint8_t> count(static_cast<std::size_t>(K.size(n - 1)));
  for (const Index f : K.face_table(n)) {
    auto& own = count[static_cast<std::size_t>(f)];
    own = static_cast<std::uint8_t>(own + (own < 2 ? 1 : 0));
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

}  // namespace

template <int n>
DualReport dual_report(const SimplicialComplex<n>& K, const CircumcentricDual<n>& dual) {
  DualReport report;
  report.well_centered = dual.well_centered;
  report.degenerate = dual.degenerate;
  for (int k = 0; k <= n; ++k) report.star.push_back(star_verdict(dual.dual[k], dual.primal[k]));
  if constexpr (n > 0) judge_facets(K, dual.dual[n - 1], report);
  return report;
}

template DualReport dual_report<0>(const SimplicialComplex<0>&, const CircumcentricDual<0>&);
template DualReport dual_report<1>(const SimplicialComplex<1>&, const CircumcentricDual<1>&);
template DualReport dual_report<2>(const SimplicialComplex<2>&, const CircumcentricDual<2>&);
template DualReport dual_report<3>(const SimplicialComplex<3>&, const CircumcentricDual<3>&);
template DualReport dual_report<4>(const SimplicialComplex<4>&, const CircumcentricDual<4>&);

}  // namespace derham
