#include "derham/boundary/boundary_map.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>
#include <cstddef>

namespace derham {
namespace {

/// Adds the values of one simplex to its faces. Of edges, which have few of them, these have been set to zero before.
template <int k, class Columns, class Place>
[[gnu::always_inline]] inline void visit(const Index* f, bool negative, std::uint8_t begun, const double* __restrict x,
                                         Columns columns, Place&& place) {
  detail::for_panels(columns, [&](Offset c, auto width) {
    double term[width];
    for (int q = 0; q < width; ++q) term[q] = detail::negated_if(negative, x[c + q]);
    if constexpr (k == 1)
      detail::add_to_faces<k>(term, [&](int j) { return place(f[j]) + c; });
    else
      detail::add_to_begun_faces<k>(term, begun, [&](int j) { return place(f[j]) + c; });
  });
}

}  // namespace

template <int n>
  requires(n >= 1)
BoundaryMap<n>::BoundaryMap(const SimplicialComplex<n>& K, int k) : complex_(&K), degree_(k) {
  detail::require_degree(n, k, 1, n);
  pieces_ = detail::pieces_for_threads(K, k);
  if (k == 1) return;
  const auto width = static_cast<std::size_t>(k) + 1;
  const auto faces = K.face_table(k);
  begun_.resize(static_cast<std::size_t>(K.size(k)));
  std::vector<bool> met(static_cast<std::size_t>(K.size(k - 1)));
  for (std::size_t i = 0; i < begun_.size(); ++i)
    for (std::size_t j = 0; j < width; ++j) {
      const auto face = static_cast<std::size_t>(faces[i * width + j]);
      begun_[i] |= static_cast<std::uint8_t>(met[face] ? 1U << j : 0U);
      met[face] = true;
    }
  for (std::size_t face = 0; face < met.size(); ++face)
    if (!met[face]) bare_.push_back(static_cast<Index>(face));
}

template <int n>
  requires(n >= 1)
void BoundaryMap<n>::apply(std::span<const double> x, std::span<double> y, Index columns) const {
  const auto& K = *complex_;
  detail::require_shape("x", x.size(), K.size(degree_), columns);
  detail::require_shape("y", y.size(), K.size(degree_ - 1), columns);
  const Index* const faces = K.face_table(degree_).data();
  const std::uint8_t* const begun = begun_.data();
  const Sign* const signs = K.orientation().sign.data();
  detail::with_degree<1, n>(degree_, [&]<int m>(std::integral_constant<int, m>) {
    detail::with_columns(columns, [&](auto r) {
      parallel_blocks(static_cast<Offset>(pieces_.size()), 1, [&](Offset p, Offset) {
        const auto& piece = pieces_[static_cast<std::size_t>(p)];
        if (m == 1) std::fill(y.begin() + Offset{piece.first_face} * r, y.begin() + Offset{piece.last_face} * r, 0.0);
        detail::scatter(piece, y.data(), r, [=, from = x.data()](Offset i, auto&& place) {
          visit<m>(faces + i * (m + 1), m == n && signs[i] < 0, m == 1 ? std::uint8_t{0} : begun[i], from + i * r, r,
                   place);
        });
      });
      for (const Index face : bare_) std::fill_n(y.begin() + Offset{face} * r, Offset{r}, 0.0);
    });
  });
}

template class BoundaryMap<1>;
template class BoundaryMap<2>;
template class BoundaryMap<3>;
template class BoundaryMap<4>;
template class BoundaryMap<5>;
template class BoundaryMap<6>;

}  // namespace derham
