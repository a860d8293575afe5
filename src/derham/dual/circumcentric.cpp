#include "derham/dual/circumcentric.hpp"

#include "derham/core/bulk_array.hpp"
#include "derham/core/error.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/ordered_blocks.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/block_metric.hpp"
#include "derham/geometry/naming.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace derham {

namespace {

// Relative to its size, the error allowed for in a height that is not zero.
constexpr double height_error = 1e-10;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// A dual volume as far as it has been summed up, and what the errors of the heights in it may amount to. Side by side, so
// that adding to both costs one access to memory.
struct alignas(16) Estimate {
  double value, error;

  // What error cannot explain.
  [[nodiscard]] double settled() const noexcept { return std::abs(value) <= error ? 0 : value; }
};

// x * unit^power, NaN where that is out of the range of doubles.
double in_range(double x, double unit, int power) {
  const double result = in_units(x, unit, power);
  return x == 0 || std::isnormal(result) ? result : not_a_number;
}

// The recursion from the top degree to the vertices. Every simplex is measured once, many at a time and on all threads;
// shares are added in the order of the simplices, one block of them at a time, so that the sums are always the same.
template <int n>
class Recursion {
 public:
  Recursion(const SimplicialComplex<n>& K, const Geometry<n>& geometry) : complex_(K), metric_(K, geometry) {
    for (int k = 0; k <= n; ++k) {
      const auto size = static_cast<std::size_t>(K.size(k));
      reserve_large(result_.primal[k], size);
      reserve_large(result_.dual[k], size);
    }
  }

  CircumcentricDual<n> run() {
    unrolled<n>([&]<int i>() { add_shares<n - i>(); });
    result_.primal[0].assign(static_cast<std::size_t>(complex_.size(0)), 1.0);
    settle<0>(result_.primal[0].size());
    result_.well_centered = result_.well_centered && result_.degenerate.empty();
    return std::move(result_);
  }

 private:
  // What k-simplices give to their faces.
  template <int k>
  void add_shares() {
    sums_[k - 1] = Sums(static_cast<std::size_t>(complex_.size(k - 1)));
    std::ranges::fill(sums_[k - 1], Estimate{0, 0});
    using Block = MetricBlock<k>;
    const Index size = complex_.size(k);
    const auto bounds = [&](Offset block) {
      const auto begin = static_cast<Index>(block * Block::capacity);
      return std::pair{begin, size - begin < Block::capacity ? size : begin + Block::capacity};
    };
    ordered_blocks((Offset{size} + Block::capacity - 1) / Block::capacity, [] { return std::make_unique<Block>(); },
                   [&](const std::unique_ptr<Block>& block, Offset number) {
                     const auto [begin, end] = bounds(number);
                     metric_.measure(begin, end, *block);
                   },
                   [&](const std::unique_ptr<Block>& block, Offset number) {
                     const auto [begin, end] = bounds(number);
                     add_shares(begin, end, *block);
                   },
                   [](const std::unique_ptr<Block>&, Offset) {});
    sums_[k] = Sums();
  }

  template <int k>
  void add_shares(Index begin, Index end, const MetricBlock<k>& block) {
    const auto count = static_cast<std::size_t>(end - begin);
    Estimate* const sums = sums_[k - 1].data();
    const Index* face = complex_.face_table(k).data() + static_cast<std::size_t>(begin) * (k + 1);
    bool centered = true;
    for (std::size_t i = 0; i < count; ++i, face += k + 1) {
      double value = 1, error = 0;
      if constexpr (k < n) {
        const Estimate& own = sums_[k][static_cast<std::size_t>(begin) + i];
        value = own.settled();
        error = own.error;
      }
      value /= n - k + 1;
      error /= n - k + 1;
      const double most = std::abs(value) + error;
      for (int j = 0; j <= k; ++j) {
        const double h = block.height[static_cast<std::size_t>(k - j)][i], distance = std::abs(h);
        Estimate& sum = sums[face[j]];
        sum.value += h * value;
        sum.error += (height_error * distance + block.rounding[i]) * most + distance * error;
        centered &= h > 0;
      }
    }
    result_.well_centered = result_.well_centered && centered;
    result_.primal[k].insert(result_.primal[k].end(), block.volume.begin(), block.volume.begin() + (end - begin));
    settle<k>(count);
    for (const Index t : block.degenerate) result_.dual[k][t] = not_a_number;
    result_.degenerate.insert(result_.degenerate.end(), block.degenerate.begin(), block.degenerate.end());
  }

  // Dual volumes of the next `count` k-simplices, in true units.
  template <int k>
  void settle(std::size_t count) {
    auto& dual = result_.dual[k];
    const std::size_t begin = dual.size();
    dual.resize(begin + count, 1.0);
    if constexpr (k < n)
      for (std::size_t i = begin; i < dual.size(); ++i)
        dual[i] = in_range(sums_[k][i].settled(), metric_.unit(), n - k);
  }

  using Sums = BulkArray<Estimate>;

  const SimplicialComplex<n>& complex_;
  BlockMetric<n> metric_;
  CircumcentricDual<n> result_;
  std::array<Sums, n + 1> sums_;  // [k < n]: dual volumes in units, while they are needed
};

}  // namespace

template <int n>
CircumcentricDual<n> circumcentric_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  return Recursion<n>(K, geometry).run();
}

template <int n>
ByDegree<n> dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  auto result = circumcentric_dual(K, geometry);
  if (!result.degenerate.empty())
    throw GeometryError(text("dual volumes do not exist: ", result.degenerate.size(), " flat top simplices: ",
                             simplices_text<n>(K, n, result.degenerate), "; move their vertices or remove them"));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i)
      if (std::isnan(result.dual[k][i]))
        throw GeometryError(
            text("the dual volume of ", simplex_text(K, k, i),
                 " is out of the range of doubles; scale the mesh so that edge lengths are closer to 1"));
  return std::move(result.dual);
}

#define DERHAM_INSTANTIATE(n)                                                                           \
  template CircumcentricDual<n> circumcentric_dual<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template ByDegree<n> dual_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
