#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// A simplicial map from an n-complex K to an m-complex L: a map of vertices that takes the vertices of every simplex of K
/// to those of a simplex of L, which may be of lower dimension. K and L must outlive it.
/// Source   Munkres, "Elements of Algebraic Topology", 1984, §2
template <int n, int m>
class SimplicialMap {
 public:
  /// vertex_images (|V(K)|,): where every vertex of K goes.
  /// Cost     a search in L for every maximal simplex of K
  /// Throws   InputError on a wrong length, naming a vertex whose image is no vertex of L, or a simplex of K whose image
  ///          is no simplex of L
  SimplicialMap(const SimplicialComplex<n>& K, const SimplicialComplex<m>& L, std::vector<Index> vertex_images)
      : source_(&K), target_(&L), vertex_images_(std::move(vertex_images)) {
    if (vertex_images_.size() != static_cast<std::size_t>(K.size(0)))
      throw InputError(text("there are ", vertex_images_.size(), " images for ", K.size(0), " vertices"));
    for (std::size_t v = 0; v < vertex_images_.size(); ++v)
      if (vertex_images_[v] < 0 || vertex_images_[v] >= L.size(0))
        throw InputError(text("vertex ", v, " goes to ", vertex_images_[v], "; the other complex has vertices 0 to ",
                              L.size(0) - 1));
    for (Index t = 0; t < K.size(n); ++t) require_image(K.simplex(n, t));
    for (const RowTarget& lower : K.maximal_lower()) require_image(K.simplex(lower.degree, lower.index));
  }
  SimplicialMap(SimplicialComplex<n>&&, const SimplicialComplex<m>&, std::vector<Index>) = delete;
  SimplicialMap(const SimplicialComplex<n>&, SimplicialComplex<m>&&, std::vector<Index>) = delete;

  [[nodiscard]] const SimplicialComplex<n>& source() const noexcept { return *source_; }
  [[nodiscard]] const SimplicialComplex<m>& target() const noexcept { return *target_; }
  [[nodiscard]] std::span<const Index> vertex_images() const noexcept { return vertex_images_; }

  /// Where the positively oriented k-simplex i of K goes: a k-simplex of L and the sign of its orientation there; {-1, 0}
  /// if it is collapsed.
  /// Cost     a search in L
  [[nodiscard]] SignedIndex image(int k, Index i) const noexcept {
    std::array<Index, n + 1> storage{};
    const std::span<Index> tuple(storage.data(), static_cast<std::size_t>(k) + 1);
    std::ranges::transform(source_->simplex(k, i), tuple.begin(), image_of_vertex());
    const Sign sorting = sort_with_sign(tuple);
    if (sorting == 0 || k > m) return {};
    const SignedIndex found = target_->find(tuple);
    return {found.index, static_cast<Sign>(sorting * found.sign * source_->sign(k, i))};
  }

 private:
  [[nodiscard]] auto image_of_vertex() const noexcept {
    return [this](Index v) { return vertex_images_[static_cast<std::size_t>(v)]; };
  }

  void require_image(std::span<const Index> simplex) const {
    std::array<Index, n + 1> storage{};
    const auto end = std::ranges::transform(simplex, storage.begin(), image_of_vertex()).out;
    sort_with_sign(std::span<Index>(storage.begin(), end));
    const std::span<const Index> tuple(storage.begin(), std::unique(storage.begin(), end));
    if (tuple.size() > m + 1 || !target_->find(tuple))
      throw InputError(text("the simplex ", tuple_text(simplex), " goes to ", tuple_text(tuple),
                            ", which is no simplex of the other complex"));
  }

  const SimplicialComplex<n>* source_;
  const SimplicialComplex<m>* target_;
  std::vector<Index> vertex_images_;
};

/// First phi, then psi.
/// Throws   InputError unless psi begins where phi ends
template <int n, int m, int r>
[[nodiscard]] SimplicialMap<n, r> composition(const SimplicialMap<m, r>& psi, const SimplicialMap<n, m>& phi) {
  if (&phi.target() != &psi.source())
    throw InputError("the first map ends in another complex than the second begins in");
  std::vector<Index> images(phi.vertex_images().begin(), phi.vertex_images().end());
  for (Index& v : images) v = psi.vertex_images()[static_cast<std::size_t>(v)];
  return SimplicialMap<n, r>(phi.source(), psi.target(), std::move(images));
}

}  // namespace derham
