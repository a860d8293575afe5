#pragma once

#include "derham/complex/simplex.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/bulk_array.hpp"
#include "derham/core/types.hpp"

#include <limits>
#include <span>

namespace derham {

/// The cofaces of every k-simplex, with signs: the transposed boundary table of degree k+1.
///
/// `cofaces[i]` lists the (k+1)-simplices that have k-simplex i as a face, in increasing order, each with its relative
/// orientation (-1)^v when i omits vertex v of the sorted coface. That times K.sign(k+1, coface) is the entry of
/// ∂_{k+1}; so the table stays true when components are reversed (`orient_by`).
///
/// A positive coface c is stored as c, a negative one as ~c, the complement: the sign costs no memory.
/// Shape    |K_k| rows with (k+2)|K_{k+1}| entries together
/// Memory   one Index per row and per entry: of all degrees of a tetrahedral mesh about 63 bytes per tetrahedron
class Cofaces {
 public:
  class Iterator {
   public:
    explicit Iterator(const Index* place) noexcept : place_(place) {}
    [[nodiscard]] SignedIndex operator*() const noexcept {
      return *place_ < 0 ? SignedIndex{~*place_, -1} : SignedIndex{*place_, 1};
    }
    Iterator& operator++() noexcept {
      ++place_;
      return *this;
    }
    friend bool operator==(Iterator, Iterator) = default;

   private:
    const Index* place_;
  };

  /// The cofaces of one simplex.
  class Row {
   public:
    explicit Row(std::span<const Index> packed) noexcept : packed_(packed) {}
    [[nodiscard]] Iterator begin() const noexcept { return Iterator(packed_.data()); }
    [[nodiscard]] Iterator end() const noexcept { return Iterator(packed_.data() + packed_.size()); }
    [[nodiscard]] std::size_t size() const noexcept { return packed_.size(); }

   private:
    std::span<const Index> packed_;
  };

  /// The cofaces of the k-simplices of K.
  /// Cost     a counting sort of the face table, on up to 8 threads; the result does not depend on their number
  /// Throws   InputError unless 0 <= k < n; LimitError if the entries cannot be counted by an Index
  template <int n>
  Cofaces(const SimplicialComplex<n>& K, int k);

  [[nodiscard]] int degree() const noexcept { return degree_; }
  [[nodiscard]] Index rows() const noexcept { return static_cast<Index>(offsets_.size() - 1); }
  [[nodiscard]] Row operator[](Index i) const noexcept {
    const Index begin = offsets_[static_cast<std::size_t>(i)];
    return Row({packed_.data() + begin, static_cast<std::size_t>(offsets_[static_cast<std::size_t>(i) + 1] - begin)});
  }

  /// The arrays behind it: row i is packed()[offsets()[i]] to packed()[offsets()[i+1]-1], each c or ~c.
  [[nodiscard]] std::span<const Index> offsets() const noexcept { return {offsets_.data(), offsets_.size()}; }
  [[nodiscard]] std::span<const Index> packed() const noexcept { return {packed_.data(), packed_.size()}; }

 private:
  int degree_;
  BulkArray<Index> offsets_;  // (|K_k|+1,)
  BulkArray<Index> packed_;   // ((k+2)|K_{k+1}|,)
};

namespace detail {
/// Throws LimitError if `entries` cofaces of simplices of degree k are more than `limit`.
void require_cofaces_fit(Offset entries, int k, Offset limit = std::numeric_limits<Index>::max());
}  // namespace detail

}  // namespace derham
