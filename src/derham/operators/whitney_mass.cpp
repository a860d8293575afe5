#include "derham/operators/whitney_mass.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/complex/local_faces.hpp"
#include "derham/core/bulk_array.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/scratch_pool.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/operators/local_mass.hpp"
#include "derham/operators/not_flat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace derham {
namespace {

constexpr Offset grain = 4096;

template <int n>
void require_degree(int k) {
  if (k < 0 || k > n) throw InputError(text("a mass matrix of degree ", k, "; degrees are 0 to ", n));
}

/// The symmetric part of a tensor of R^d in the frame of a simplex.
template <int n>
std::array<std::array<double, n>, n> tensor_in_frame(const SimplexFrame<n>& frame, const double* tensor,
                                                     std::size_t d) {
  std::array<std::array<double, n>, n> result{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t a = 0; a < d; ++a)
        for (std::size_t b = 0; b < d; ++b)
          result[i][j] +=
              frame.axes()[i * d + a] * (tensor[a * d + b] + tensor[b * d + a]) / 2 * frame.axes()[j * d + b];
  return result;
}

/// What A does to k-forms in components, (C(n, k), C(n, k)): the compound matrix of its minors of order k for k <= n/2,
/// else that of order n-k on ⋆ of the forms. With complements in the reverse order and ⋆e_I = ± e_I', I' = rest of I.
template <int n, int k>
void compound(const std::array<std::array<double, n>, n>& A, double* result) {
  constexpr bool direct = 2 * k <= n;
  constexpr int order = direct ? k : n - k;
  constexpr auto sets = detail::lexicographic_subsets<n, order>();
  constexpr std::size_t size = sets.size();
  for (std::size_t p = 0; p < size; ++p)
    for (std::size_t q = 0; q < size; ++q) {
      std::array<const double*, static_cast<std::size_t>(order)> rows{};
      int sum = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = A[static_cast<std::size_t>(sets[p][i])].data();
        sum += sets[p][i] + sets[q][i];
      }
      const double minor = minor_of<order>(rows, sets[q]);
      result[direct ? p * size + q : (size - 1 - p) * size + size - 1 - q] = direct || sum % 2 == 0 ? minor : -minor;
    }
}

/// The products of constant forms on every top simplex, shape (|K_n|, products).
template <int n, int k>
BulkArray<double> constant_products(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                    const Material& material) {
  using Local = detail::LocalMass<n, k>;
  constexpr bool takes_tensors = 0 < k && k < n;
  if (material.width != 0 && !takes_tensors)
    throw InputError(text("a material of tensors for ", k, "-forms in dimension ", n,
                          "; functions and densities have no direction to weigh: give numbers"));
  if (material.width != 0 && 1 < k && k < n - 1) require_positive(material, K);  // minors would hide signs
  BulkArray<double> result(static_cast<std::size_t>(K.size(n)) * Local::products);
  parallel_blocks(K.size(n), grain, [&](Offset begin, Offset end) {
    const int d = geometry.coordinate_dimension();
    SimplexFrame<n> frame(d);
    std::array<double, Local::sets * Local::sets> tensor{};
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      frame.set(geometry.corners(K, t));
      double* const products = result.data() + static_cast<std::size_t>(t) * Local::products;
      if constexpr (takes_tensors) {
        if (material.width != 0) {
          compound<n, k>(tensor_in_frame<n>(frame, material.of(t), static_cast<std::size_t>(d)), tensor.data());
          Local::multiply(frame, 1, tensor.data(), products);
          continue;
        }
      }
      Local::multiply(frame, *material.of(t), nullptr, products);
    }
  });
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!std::isfinite(result[i]))
      throw GeometryError(text("the mass of ", simplex_text(K, n, static_cast<Index>(i / Local::products)),
                               " is out of the range of doubles; scale the mesh so that edge lengths are closer to 1"));
  return result;
}

/// The k-faces of every top simplex, shape (|K_n|, faces).
template <int n, int k>
BulkArray<Index> faces_of_tops(const SimplicialComplex<n>& K) {
  constexpr auto masks = detail::masks_of<n, k + 1>();
  BulkArray<Index> result(static_cast<std::size_t>(K.size(n)) * masks.size());
  parallel_blocks(K.size(n), grain, [&](Offset begin, Offset end) {
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      const auto index = face_indices(K, t);
      for (std::size_t a = 0; a < masks.size(); ++a)
        result[static_cast<std::size_t>(t) * masks.size() + a] = index[masks[a]];
    }
  });
  return result;
}

/// The columns of a row that were met so far, found by their place in the row.
class RowColumns {
 public:
  explicit RowColumns(Index columns) : place_(static_cast<std::size_t>(columns)) {}

  void clear() noexcept { met_.clear(); }

  /// The place of a column, a new one at the end if it was not met yet.
  std::size_t place(Index column) {
    Index& at = place_[static_cast<std::size_t>(column)];
    if (at >= static_cast<Index>(met_.size()) || met_[static_cast<std::size_t>(at)] != column) {
      at = static_cast<Index>(met_.size());
      met_.push_back(column);
    }
    return static_cast<std::size_t>(at);
  }

  [[nodiscard]] const std::vector<Index>& met() const noexcept { return met_; }

 private:
  std::vector<Index> place_;
  std::vector<Index> met_;
};

/// Assembles row by row.
template <int n, int k>
class Assembly {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Assembly(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Material& material)
      : size_(K.size(k)), products_(constant_products<n, k>(K, geometry, material)), faces_(faces_of_tops<n, k>(K)),
        tops_(incidence(K, k, n)), scratch_([this] {
          return Scratch{RowColumns(size_), {}, {}};
        }) {}

  /// Into a matrix that is given, because Eigen copies what it might move.
  void write(Matrix& result) {
    result.resize(size_, size_);
    auto* const offsets = result.outerIndexPtr();
    for_each_row([&](Scratch& scratch, Index i) {
      scratch.columns.clear();
      for (const Index t : tops_[i])
        for (const Index j : faces(t)) scratch.columns.place(j);
      offsets[i + 1] = static_cast<int>(scratch.columns.met().size());
    });
    Offset entries = 0;
    for (Index i = 0; i < size_; ++i) {
      entries += offsets[i + 1];
      if (entries > std::numeric_limits<int>::max())
        throw LimitError("a Whitney mass matrix has more entries than Eigen's index type counts, 2^31");
      offsets[i + 1] = static_cast<int>(entries);
    }
    result.resizeNonZeros(entries);
    for_each_row([&](Scratch& scratch, Index i) {
      const Offset begin = offsets[i];
      sum_row(scratch, i);
      scratch.write(result.innerIndexPtr() + begin, result.valuePtr() + begin);
    });
  }

 private:
  using Local = detail::LocalMass<n, k>;

  struct Scratch {
    RowColumns columns;
    std::vector<double> values;
    std::vector<std::size_t> order;

    void write(int* indices, double* entries) {
      const auto& met = columns.met();
      order.resize(met.size());
      for (std::size_t place = 0; place < met.size(); ++place) {  // insertion sort: rows are short
        std::size_t at = place;
        for (; at > 0 && met[order[at - 1]] > met[place]; --at) order[at] = order[at - 1];
        order[at] = place;
      }
      for (std::size_t at = 0; at < order.size(); ++at) {
        indices[at] = static_cast<int>(met[order[at]]);
        entries[at] = values[order[at]];
      }
    }
  };

  [[nodiscard]] std::span<const Index, Local::faces> faces(Index t) const noexcept {
    return std::span<const Index, Local::faces>(faces_.data() + static_cast<std::size_t>(t) * Local::faces,
                                                Local::faces);
  }

  /// The sums over the top simplices of row i, in their order.
  void sum_row(Scratch& scratch, Index i) const {
    scratch.columns.clear();
    scratch.values.clear();
    for (const Index t : tops_[i]) {
      const auto columns = faces(t);
      const auto a = static_cast<std::size_t>(std::ranges::find(columns, i) - columns.begin());
      const double* const products = products_.data() + static_cast<std::size_t>(t) * Local::products;
      std::array<double, Local::faces> row{};
      for (std::size_t p = 0; p < Local::products; ++p)
        for (std::size_t b = 0; b < Local::faces; ++b) row[b] += table_[a][p][b] * products[p];
      for (std::size_t b = 0; b < Local::faces; ++b) {
        const std::size_t place = scratch.columns.place(columns[b]);
        if (place == scratch.values.size()) scratch.values.push_back(0);
        scratch.values[place] += row[b];
      }
    }
  }

  template <class Body>
  void for_each_row(Body&& body) {
    parallel_blocks(size_, grain, [&](Offset begin, Offset end) {
      const auto scratch = scratch_.take();
      for (auto i = static_cast<Index>(begin); i < end; ++i) body(*scratch, i);
    });
  }

  const typename Local::Table table_ = Local::table();
  Index size_;
  BulkArray<double> products_;
  BulkArray<Index> faces_;
  Incidence tops_;
  ScratchPool<Scratch> scratch_;
};

}  // namespace

template <int n>
Eigen::SparseMatrix<double, Eigen::RowMajor> whitney_mass(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                                          int k, const Material& material) {
  require_degree<n>(k);
  geometry.require_fits(K);
  require_fits(material, K, geometry);
  detail::require_not_flat(K, geometry);
  Eigen::SparseMatrix<double, Eigen::RowMajor> result;
  [&]<int... degree>(std::integer_sequence<int, degree...>) {
    ((k == degree ? Assembly<n, degree>(K, geometry, material).write(result) : void()), ...);
  }(std::make_integer_sequence<int, n + 1>{});
  return result;
}

template <int n>
std::vector<double> lumped_mass(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k,
                                const Material& material) {
  require_degree<n>(k);
  geometry.require_fits(K);
  require_fits(material, K, geometry);
  if (k != 0 && k != n)
    throw InputError(text("a lumped mass of ", k, "-forms in dimension ", n, " does not converge; only degrees 0 and ",
                          n, " have one: use whitney_mass or the circumcentric HodgeStar"));
  if (material.width != 0) throw InputError("a lumped mass with a material of tensors; degrees 0 and n take numbers");
  if (k == n) detail::require_not_flat(K, geometry);
  const auto volume = top_volumes(K, geometry).volume;
  std::vector<double> result(static_cast<std::size_t>(K.size(k)));
  for (Index t = 0; t < K.size(n); ++t) {
    const double value = std::abs(volume[static_cast<std::size_t>(t)]), weight = *material.of(t);
    if (k == n) {
      result[static_cast<std::size_t>(t)] = n == 0 ? weight : weight / value;
    } else {
      for (const Index v : K.simplex(n, t)) result[static_cast<std::size_t>(v)] += weight * value / (n + 1);
    }
  }
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                                         \
  template Eigen::SparseMatrix<double, Eigen::RowMajor> whitney_mass(const SimplicialComplex<n>&, const Geometry<n>&, \
                                                                     int, const Material&);                           \
  template std::vector<double> lumped_mass(const SimplicialComplex<n>&, const Geometry<n>&, int, const Material&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
