#include "derham/hodge/hodge_star.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_recursion.hpp"
#include "derham/dual/kept_volumes.hpp"
#include "derham/dual/power.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/top_volumes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace derham {
namespace {

/// y = factor(diagonal) x, row by row. Returns whether the diagonal holds a zero.
template <class Factor>
bool scale(std::span<const double> diagonal, std::span<const double> x, std::span<double> y, Index columns,
           Factor&& factor) {
  detail::require_shape("x", x.size(), static_cast<Index>(diagonal.size()), columns);
  detail::require_shape("y", y.size(), static_cast<Index>(diagonal.size()), columns);
  constexpr Offset grain = 1 << 14;
  std::atomic<bool> zero = false;
  detail::with_columns(columns, [&](auto r) {
    parallel_blocks(
        static_cast<Offset>(diagonal.size()), grain,
        [&zero, &factor, r, d = diagonal.data(), from = x.data(), to = y.data()](Offset first, Offset last) {
          bool any = false;
          for (Offset i = first; i < last; ++i) {
            const double times = factor(d[i]);
            any |= d[i] == 0;
            for (Offset c = 0; c < r; ++c) to[i * r + c] = times * from[i * r + c];
          }
          if (any) zero = true;
        });
  });
  return zero;
}

/// Keeps the entries of the diagonals.
template <int n>
class KeptStars {
 public:
  KeptStars(const SimplicialComplex<n>& K, ByDegree<n>& diagonal) : diagonal_(diagonal) {
    detail::make_room<n>(K, diagonal);
  }

  template <int k>
  void take(std::size_t, const detail::SettledBlock& block) {
    detail::SettledBlock::Row star{};
    (void)block.stars(star);
    const auto count = static_cast<std::ptrdiff_t>(block.simplices.size());
    if (std::any_of(star.begin(), star.begin() + count, [](double x) { return std::isnan(x); })) undefined_ = true;
    block.store(star.data(), diagonal_[k]);
  }

  [[nodiscard]] bool undefined() const noexcept { return undefined_; }

 private:
  ByDegree<n>& diagonal_;
  std::atomic<bool> undefined_ = false;
};

/// Throws for the first entry that is undefined.
template <int n>
void refuse(const SimplicialComplex<n>& K, const CircumcentricDual<n>& volumes) {
  if (!volumes.degenerate.empty())
    throw GeometryError(text("the Hodge star divides by volumes, and ", volumes.degenerate.size(),
                             " top simplices are flat: ", simplices_text<n>(K, n, volumes.degenerate),
                             "; move their vertices or remove them"));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i) {
      const double dual = volumes.dual[k][i], primal = volumes.primal[k][i];
      if (std::isnan(star_entry(dual, primal)))
        throw GeometryError(
            text("the Hodge star of ", simplex_text(K, k, i), " is out of the range of doubles: dual volume ", dual,
                 " over volume ", primal,
                 "; scale the mesh so that edge lengths (and the weights of vertices) are closer to 1"));
    }
}

template <int n>
void require_orientable(const SimplicialComplex<n>& K) {
  if (!K.is_orientable())
    throw TopologyError(
        text("the Hodge star needs an orientable complex; orientation is reversed along the closed walk ", "of ",
             K.orientation().one_sided.size(), " top simplices ", simplices_text<n>(K, n, K.orientation().one_sided)));
}

/// The dual volumes of the kind.
template <int n>
CircumcentricDual<n> dual_of(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const StarKind& kind,
                             const Material& material) {
  if (const auto* power = std::get_if<PowerCircumcentric>(&kind))
    return power_dual(K, geometry, power->weights, material);
  if (std::holds_alternative<Circumcentric>(kind)) return power_dual(K, geometry, {}, material);
  CircumcentricDual<n> result;
  result.primal = primal_volumes(K, geometry);
  result.dual = barycentric_dual_volumes(K, geometry, material);
  result.degenerate = top_volumes(K, geometry).degenerate;
  return result;
}

}  // namespace

template <int n>
HodgeStar<n>::HodgeStar(const SimplicialComplex<n>& K, const Geometry<n>& geometry) : complex_(&K) {
  require_orientable(K);
  KeptStars<n> sink(K, diagonal_);
  detail::DualRecursion recursion(K, geometry, sink);
  recursion.run();
  if (sink.undefined()) refuse(K, circumcentric_dual(K, geometry));
}

template <int n>
HodgeStar<n>::HodgeStar(const SimplicialComplex<n>& K, const Geometry<n>& geometry, StarKind kind,
                        const Material& material)
    : complex_(&K), kind_(std::move(kind)), material_(material) {
  const bool has_material = material.width != 0 || material.values != std::vector<double>{1.0};
  if (std::holds_alternative<Circumcentric>(kind_) && !has_material) {
    *this = HodgeStar(K, geometry);
    return;
  }
  require_orientable(K);
  const auto volumes = dual_of(K, geometry, kind_, material);
  refuse(K, volumes);
  for (int k = 0; k <= n; ++k) {
    diagonal_[k].resize(volumes.dual[k].size());
    std::ranges::transform(volumes.dual[k], volumes.primal[k], diagonal_[k].begin(), star_entry);
  }
}

template <int n>
std::span<const double> HodgeStar<n>::diagonal(int k) const {
  if (k < 0 || k > n) throw InputError(text("a Hodge star of degree ", k, "; degrees are 0 to ", n));
  if (k != 0 && k != n && std::holds_alternative<Lumped>(kind_))
    throw InputError(text("a lumped Hodge star of degree ", k, " in dimension ", n,
                          " does not converge; only degrees 0 and ", n,
                          " have one: use Circumcentric{} or whitney_mass"));
  return diagonal_[static_cast<std::size_t>(k)];
}

template <int n>
std::vector<double> HodgeStar<n>::inverse_diagonal(int k) const {
  const auto star = diagonal(k);
  std::vector<double> result(star.begin(), star.end());
  std::vector<Index> zero;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (result[i] == 0) zero.push_back(static_cast<Index>(i));
    result[i] = 1 / result[i];
  }
  if (!zero.empty())
    throw GeometryError(
        text("the Hodge star of degree ", k, " has no inverse: ", zero.size(), " dual volumes are zero, those of ",
             simplices_text<n>(*complex_, k, zero),
             "; use a mesh with positive dual volumes (well-centred), or an operator without the inverse"));
  return result;
}

template <int n>
void HodgeStar<n>::apply(int k, std::span<const double> x, std::span<double> y, Index columns) const {
  scale(diagonal(k), x, y, columns, [](double star) { return star; });
}

template <int n>
void HodgeStar<n>::apply_inverse(int k, bool minus, std::span<const double> x, std::span<double> y,
                                 Index columns) const {
  if (scale(diagonal(k), x, y, columns, [minus](double star) { return (minus ? -1 : 1) / star; }))
    (void)inverse_diagonal(k);  // throws, with the names
}

template class HodgeStar<0>;
template class HodgeStar<1>;
template class HodgeStar<2>;
template class HodgeStar<3>;
template class HodgeStar<4>;

}  // namespace derham
