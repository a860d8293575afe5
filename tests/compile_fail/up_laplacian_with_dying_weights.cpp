// An up-Laplacian refers to its weights, which must outlive it.
#include "derham/hodge/up_laplacian.hpp"

namespace derham {

UpLaplacian<2> result(const SimplicialComplex<2>& K, const std::vector<double>& weights) {
#ifndef CONTROL
  return UpLaplacian<2>(K, 0, std::vector<double>(weights));
#else
  return UpLaplacian<2>(K, 0, weights);
#endif
}

}  // namespace derham
