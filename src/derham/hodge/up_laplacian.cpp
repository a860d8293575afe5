#include "derham/hodge/up_laplacian.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>

namespace derham {
namespace {

using detail::for_panels;
using detail::ScatterPiece;

constexpr Index small = 1 << 14;  // simplices that are not worth a second thread

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

template <int k, class Columns>
void apply_piece(const ScatterPiece& piece, const Index* faces, const double* weights, const double* __restrict x,
                 double* __restrict y, Columns columns) {
  std::fill(y + piece.first_face * columns, y + piece.last_face * columns, 0.0);
  const auto run = [&](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i)
      visit<k>(faces + i * (k + 1), weights[i], x, columns, [&](Offset face) { return y + face * columns; });
  };
  std::vector<double> elsewhere(static_cast<std::size_t>(columns));
  const auto one = [&](Offset i) {
    visit<k>(faces + i * (k + 1), weights[i], x, columns, [&](Offset face) {
      return face >= piece.first_face && face < piece.last_face ? y + face * columns : elsewhere.data();
    });
  };
  detail::for_each_in_order(piece, run, one);
}

}  // namespace

template <int n>
  requires(n >= 1)
UpLaplacian<n>::UpLaplacian(const SimplicialComplex<n>& K, int k, std::span<const double> weights)
    : complex_(&K), degree_(k), weights_(weights) {
  detail::require_degree(n, k, 0, n - 1);
  detail::require_shape("the weights", weights.size(), K.size(k + 1), 1);
  pieces_ = detail::scatter_pieces(K, k + 1, K.size(k) < small ? 1 : thread_count());
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
        apply_piece<m>(pieces_[static_cast<std::size_t>(p)], faces, weights_.data(), x.data(), y.data(), r);
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
