#include "derham/boundary/matrix_free.hpp"

#include "derham/boundary/stencil.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"

#include <algorithm>

namespace derham {
namespace {

using detail::for_panels;
using detail::negated_if;

constexpr Offset grain = 1 << 14;  // simplices per block of a parallel loop

/// The face table of one degree, and the signs of its simplices where they are not all +1.
struct FaceTable {
  const Index* faces;
  const Sign* signs;
  Offset rows;

  template <int n>
  FaceTable(const SimplicialComplex<n>& K, int k)
      : faces(K.face_table(k).data()), signs(k == n ? K.orientation().sign.data() : nullptr), rows(K.size(k)) {}
};

template <int k, bool top, class Columns>
void gather_faces(const FaceTable& K, const double* __restrict x, double* __restrict y, Columns columns) {
  parallel_blocks(K.rows, grain, [=](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      const Index* const f = K.faces + i * (k + 1);
      const bool negative = top && K.signs[i] < 0;
      for_panels(columns, [&](Offset c, auto width) {
        for (int q = 0; q < width; ++q)
          y[i * columns + c + q] =
              negated_if(negative, detail::alternating_sum<k>([&](int j) { return x[f[j] * columns + c + q]; }));
      });
    }
  });
}

template <int k, bool top, class Columns>
void scatter_to_faces(const FaceTable& K, bool minus, const double* __restrict x, double* __restrict y,
                      Columns columns) {
  for (Offset i = 0; i < K.rows; ++i) {
    const Index* const f = K.faces + i * (k + 1);
    const bool negative = top ? (K.signs[i] < 0) != minus : minus;
    for_panels(columns, [&](Offset c, auto width) {
      double term[width];
      for (int q = 0; q < width; ++q) term[q] = negated_if(negative, x[i * columns + c + q]);
      detail::add_to_faces<k>(term, [&](int j) { return y + f[j] * columns + c; });
    });
  }
}

template <bool top, class Columns>
void gather_cofaces(const FaceTable& K, const Cofaces& cofaces, bool minus, const double* __restrict x,
                    double* __restrict y, Columns columns) {
  const Index* const offsets = cofaces.offsets().data();
  const Index* const packed = cofaces.packed().data();
  parallel_blocks(cofaces.rows(), grain, [=](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i)
      for_panels(columns, [&](Offset c, auto width) {
        double sum[width] = {};
        for (Index p = offsets[i]; p < offsets[i + 1]; ++p) {
          const bool complement = packed[p] < 0;
          const Index coface = complement ? ~packed[p] : packed[p];
          const bool negative = complement != (top ? (K.signs[coface] < 0) != minus : minus);
          for (int q = 0; q < width; ++q) sum[q] += negated_if(negative, x[coface * columns + c + q]);
        }
        std::copy_n(sum, width, y + i * columns + c);
      });
  });
}

}  // namespace

void detail::require_degree(int n, int k, int low, int high) {
  if (k < low || k > high)
    throw InputError(text("degree ", k, " in a complex of dimension ", n, "; allowed are ", low, " to ", high));
}

void detail::require_shape(const char* name, std::size_t found, Index simplices, Index columns) {
  if (columns < 1) throw InputError(text("there are ", columns, " columns; allowed are 1 and more"));
  if (found % static_cast<std::size_t>(columns) != 0 || found / columns != static_cast<std::size_t>(simplices))
    throw InputError(text(name, " has ", found, " entries; there are ", simplices, " simplices and ", columns,
                          columns == 1 ? " column" : " columns"));
}

template <int n>
void apply_coboundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y,
                      Index columns) {
  detail::require_degree(n, k, 0, n - 1);
  detail::require_shape("x", x.size(), K.size(k), columns);
  detail::require_shape("y", y.size(), K.size(k + 1), columns);
  const FaceTable table(K, k + 1);
  detail::with_degree<1, n>(k + 1, [&]<int m>(std::integral_constant<int, m>) {
    detail::with_columns(columns, [&](auto r) { gather_faces<m, m == n>(table, x.data(), y.data(), r); });
  });
}

template <int n>
void apply_boundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y,
                    Index columns) {
  detail::apply_boundary(K, k, false, x, y, columns);
}

template <int n>
void apply_boundary(const SimplicialComplex<n>& K, const Cofaces& cofaces, std::span<const double> x,
                    std::span<double> y, Index columns) {
  detail::apply_boundary(K, cofaces, false, x, y, columns);
}

template <int n>
void detail::apply_boundary(const SimplicialComplex<n>& K, int k, bool minus, std::span<const double> x,
                            std::span<double> y, Index columns) {
  require_degree(n, k, 1, n);
  require_shape("x", x.size(), K.size(k), columns);
  require_shape("y", y.size(), K.size(k - 1), columns);
  std::ranges::fill(y, 0.0);
  with_degree<1, n>(k, [&]<int m>(std::integral_constant<int, m>) {
    with_columns(columns, [&](auto r) { scatter_to_faces<m, m == n>(FaceTable(K, k), minus, x.data(), y.data(), r); });
  });
}

template <int n>
void detail::apply_boundary(const SimplicialComplex<n>& K, const Cofaces& cofaces, bool minus,
                            std::span<const double> x, std::span<double> y, Index columns) {
  const int k = cofaces.degree() + 1;
  require_degree(n, k, 1, n);
  require_shape("x", x.size(), K.size(k), columns);
  require_shape("y", y.size(), K.size(k - 1), columns);
  if (cofaces.rows() != K.size(k - 1) || cofaces.packed().size() != K.face_table(k).size())
    throw InputError(text("the cofaces are those of ", cofaces.rows(), " simplices of degree ", k - 1,
                          " of another complex; this one has ", K.size(k - 1)));
  with_columns(columns, [&](auto r) {
    if (k == n)
      gather_cofaces<true>(FaceTable(K, k), cofaces, minus, x.data(), y.data(), r);
    else
      gather_cofaces<false>(FaceTable(K, k), cofaces, minus, x.data(), y.data(), r);
  });
}

#define DERHAM_INSTANTIATE(n)                                                                                          \
  template void apply_coboundary(const SimplicialComplex<n>&, int, std::span<const double>, std::span<double>, Index); \
  template void apply_boundary(const SimplicialComplex<n>&, int, std::span<const double>, std::span<double>, Index);   \
  template void apply_boundary(const SimplicialComplex<n>&, const Cofaces&, std::span<const double>,                   \
                               std::span<double>, Index);                                                              \
  template void detail::apply_boundary(const SimplicialComplex<n>&, int, bool, std::span<const double>,                \
                                       std::span<double>, Index);                                                      \
  template void detail::apply_boundary(const SimplicialComplex<n>&, const Cofaces&, bool, std::span<const double>,     \
                                       std::span<double>, Index);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
