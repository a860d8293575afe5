#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace derham {

/// The answer to a question that cannot always be decided.
enum class Verdict : std::uint8_t { yes, no, unproved };

/// "yes", "no" or "unproved".
[[nodiscard]] std::string_view name(Verdict verdict) noexcept;

/// What is wrong at a simplex of an n-dimensional complex.
enum class DefectKind : std::uint8_t {
  facet,        ///< a simplex of degree n-1 has more than two cofaces (n = 1: a vertex of more than two edges)
  ring,         ///< the top simplices about one of degree n-2 >= 1 form no single open or closed ring
  link,         ///< the link of a simplex of lower degree, or of any vertex (n >= 2), is neither a sphere nor a ball
  unproved,     ///< that link has the homology of a sphere or ball, but was not proven to be one (links of degree >= 3)
  orientation,  ///< a top simplex on a closed walk that reverses orientation; does not touch the verdict
};

/// "facet", "ring", "link", "unproved" or "orientation".
[[nodiscard]] std::string_view name(DefectKind kind) noexcept;

struct ManifoldDefect {
  DefectKind kind = DefectKind::facet;
  std::vector<Index> simplex;  ///< its vertex ids, sorted
  std::string detail;          ///< what it is instead of what it should be, and how to mend it
};

/// The answer of `check_manifold`.
struct ManifoldReport {
  Verdict verdict =
      Verdict::yes;        ///< no if there is a facet, ring or link defect; else unproved if there is one of those
  bool pure = true;        ///< every maximal simplex has degree n
  bool closed = true;      ///< pure, and no simplex of degree n-1 has exactly one coface
  bool orientable = true;  ///< as K.orientation() says
  std::vector<ManifoldDefect> defects;  ///< by falling degree, then index; the orientation defect last

  [[nodiscard]] Offset count(DefectKind kind) const noexcept;
};

/// Whether K is a combinatorial manifold, possibly with boundary: the link of every k-simplex is a sphere or a ball of
/// dimension n-k-1. Orientability is reported, not demanded.
///
/// Degree by degree from the top: at most two cofaces per facet; one ring about every simplex of codimension 2 (the
/// walk); for codimension 3 the link surface is a sphere or disc by connectivity, boundary and Euler characteristic;
/// for codimension >= 4 the link, a manifold by then, is certified by collapsing and refuted by integer homology; what
/// neither decides is `unproved`. A maximal simplex of degree < n has an empty link: a defect of the kind of its
/// degree.
///
/// A face of a defective simplex is not judged, because its own link is bad for that reason already: mend, check again.
/// A face of an unproved simplex is only tested by homology.
///
/// For n = 2 and 3 a quick proof is tried first (`star_proof.hpp`): two passes, and no star is listed.
/// Cost     linear in the stars (log of the star's size for surfaces); same report for any number of threads
/// Source   Elcott & Schröder, "Building your own DEC at home", §2, with the vertex test made decidable;
///          Whitehead, "Simplicial spaces, nuclei and m-groups", 1939
template <int n>
[[nodiscard]] ManifoldReport check_manifold(const SimplicialComplex<n>& K);

namespace detail {
/// `check_manifold` without the quick proof: the same report.
template <int n>
[[nodiscard]] ManifoldReport check_every_link(const SimplicialComplex<n>& K);
}  // namespace detail

/// Throws TopologyError with the first defect and the number of all unless check_manifold(K) answers yes.
template <int n>
void require_manifold(const SimplicialComplex<n>& K);

}  // namespace derham
