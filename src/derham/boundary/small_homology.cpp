#include "derham/boundary/small_homology.hpp"

#include "derham/boundary/smith_form.hpp"
#include "derham/complex/simplex.hpp"

#include <algorithm>

namespace derham {
namespace {

/// The boundary matrix of k-simplices given by the indices of their k+1 faces, without the columns in `skipped`. Signs
/// of top simplices do not matter here: they only reverse columns. Not inlined: g++ 12 at -O2 makes the loop run too
/// far once it is inlined into one over k (range propagation; -O1, clang and -fno-tree-vrp are right).
IntegerMatrix boundary_matrix(std::span<const Index> face_table, int k, Index rows, const std::vector<char>& skipped) {
  IntegerMatrix A{rows, {0}, {}};
  const auto width = static_cast<std::size_t>(k) + 1;
  for (std::size_t i = 0; i < skipped.size(); ++i) {
    if (skipped[i]) continue;
    for (std::size_t j = 0; j < width; ++j)
      A.entries.push_back({face_table[i * width + j], face_sign(k - static_cast<int>(j))});
    A.offsets.push_back(static_cast<Offset>(A.entries.size()));
  }
  return A;
}

}  // namespace

template <int n>
std::vector<HomologyGroup> small_homology(const SimplicialComplex<n>& K) {
  std::vector<HomologyGroup> groups(n + 1);
  std::vector<char> skipped(static_cast<std::size_t>(K.size(n)), 0);
  Index rank_above = 0;
  for (int k = n; k >= 0; --k) {
    Index rank = 0;
    std::vector<char> skipped_below(static_cast<std::size_t>(K.size(k - 1)), 0);
    if (k > 0) {
      // A unit pivot of the boundary above writes its row's simplex as the others modulo a boundary, so that simplex
      // adds nothing to the image of the boundary here: its column is skipped.
      const SmithForm form = smith_form(boundary_matrix(K.face_table(k), k, K.size(k - 1), skipped));
      rank = form.rank;
      for (const Index row : form.unit_rows) skipped_below[static_cast<std::size_t>(row)] = 1;
      groups[static_cast<std::size_t>(k) - 1].torsion = form.divisors;
    }
    groups[static_cast<std::size_t>(k)].betti = K.size(k) - rank - rank_above;
    rank_above = rank;
    skipped = std::move(skipped_below);
  }
  return groups;
}

bool is_homology_of_sphere(std::span<const HomologyGroup> groups) {
  const std::size_t n = groups.size() - 1;
  for (std::size_t k = 0; k <= n; ++k)
    if (!groups[k].torsion.empty() || groups[k].betti != (k == 0 ? 1 : 0) + (k == n ? 1 : 0)) return false;
  return true;
}

bool is_homology_of_point(std::span<const HomologyGroup> groups) {
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (!groups[k].torsion.empty() || groups[k].betti != (k == 0 ? 1 : 0)) return false;
  return true;
}

std::string homology_text(std::span<const HomologyGroup> groups) {
  std::string out;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    std::string sum;
    const auto add = [&](const std::string& summand) { sum += (sum.empty() ? "" : " + ") + summand; };
    if (groups[k].betti == 1) add("Z");
    if (groups[k].betti > 1) add("Z^" + std::to_string(groups[k].betti));
    for (const auto d : groups[k].torsion) add("Z_" + std::to_string(d));
    out += (k ? ", H_" : "H_") + std::to_string(k) + " = " + (sum.empty() ? "0" : sum);
  }
  return out;
}

template std::vector<HomologyGroup> small_homology(const SimplicialComplex<0>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<1>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<2>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<3>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<4>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<5>&);
template std::vector<HomologyGroup> small_homology(const SimplicialComplex<6>&);

}  // namespace derham
