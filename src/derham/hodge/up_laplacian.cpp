#include "derham/hodge/up_laplacian.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>

namespace derham {
namespace {

using detail::for_panels;

/// The weighted alternating sum over the faces of one simplex. Signs of top simplices would enter twice and cancel.
template <int k, class Columns, class Place>
[[gnu::always_inline]] inline void visit(const Index* f, double weight, const double* __restrict x, Columns columns,
                                         Place&& place) {
  for_panels(columns, [&](Offset c, auto width) {
    double term[width];
    for (int q = 0; q < width; ++q)
      term[q] = weight * detail::alternating_sum<k>([&](int j) { return x[f[j] * columns + c + q]; });
    detail::add_to_faces<k>(term, [&](int j) { return place(f[j]) + c; });
  });
}

}  // namespace

template <int n>
  requires(n >= 1)
UpLaplacian<n>::UpLaplacian(const SimplicialComplex<n>& K, int k, std::span<const double> weights)
    : complex_(&K), degree_(k), weights_(weights) {
  detail::require_degree(n, k, 0, n - 1);
  detail::require_shape("the weights", weights.size(), K.size(k + 1), 1);
  pieces_ = detail::pieces_for_threads(K, k + 1);
}

template <int n>
  requires(n >= 1)
void UpLaplacian<n>::apply(std::span<const double> x, std::span<double> y, Index columns) const {
  const auto& K = *complex_;
  detail::require_shape("x", x.size(), K.size(degree_), columns);
  detail::require_shape("y", y.size(), K.size(degree_), columns);
  const Index* const faces = K.face_table(degree_ + 1).data();
  detail::with_degree<1, n>(degree_ + 1, [&]<int m>(std::integral_constant<int, m>) {
    detail::with_columns(columns, [&](auto r) {
      parallel_blocks(static_cast<Offset>(pieces_.size()), 1, [&](Offset p, Offset) {
        const auto& piece = pieces_[static_cast<std::size_t>(p)];
        std::fill(y.begin() + Offset{piece.first_face} * r, y.begin() + Offset{piece.last_face} * r, 0.0);
        detail::scatter(piece, y.data(), r, [=, weights = weights_.data(), from = x.data()](Offset i, auto&& place) {
          visit<m>(faces + i * (m + 1), weights[i], from, r, place);
        });
      });
    });
  });
}

template class UpLaplacian<1>;
template class UpLaplacian<2>;
template class UpLaplacian<3>;
template class UpLaplacian<4>;
template class UpLaplacian<5>;
template class UpLaplacian<6>;

}  // namespace derham
