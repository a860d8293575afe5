#pragma once

#include "derham/boundary/chain.hpp"
#include "derham/complex/simplicial_map.hpp"
#include "derham/core/error.hpp"

namespace derham {

/// The image of a chain under a simplicial map; collapsed simplices vanish.
/// Laws     boundary(pushforward(phi, c)) = pushforward(phi, boundary(c));  functorial; exact
/// Cost     a search for every term
/// Throws   InputError if the chain is of another complex
/// Source   Munkres, "Elements of Algebraic Topology", 1984, §12
template <int n, int m, int k>
  requires(k <= m)
[[nodiscard]] Chain<m, k> pushforward(const SimplicialMap<n, m>& phi, const Chain<n, k>& chain) {
  if (&chain.complex() != &phi.source()) throw InputError("the chain and the map belong to different complexes");
  std::vector<typename Chain<m, k>::Term> terms;
  for (const auto& [simplex, coefficient] : chain.terms())
    if (const SignedIndex image = phi.image(k, simplex)) terms.push_back({image.index, image.sign * coefficient});
  return Chain<m, k>(phi.target(), std::move(terms));
}

}  // namespace derham
