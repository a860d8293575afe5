#include "derham/boundary/manifold_text.hpp"

#include "derham/core/text.hpp"

#include <algorithm>
#include <array>

namespace derham::detail {
namespace {

constexpr std::size_t longest_list = 6;

std::string ring_words(const Ring& ring, int n) {
  if (n == 2) return ring.closed ? "a circle" : "an arc";
  return text(ring.closed ? "a closed one of " : "an open one of ", ring.tops.size());
}

}  // namespace

std::string noun(int k) {
  constexpr std::array names{"vertex", "edge", "triangle", "tet"};
  return k < 4 ? names[static_cast<std::size_t>(k)] : text(k, "-simplex");
}

namespace {
std::string plural(int k) { return k < 4 ? noun(k) + "s" : text(k, "-simplices"); }
}  // namespace

std::string counted(Offset count, int k) {
  if (count == 1) return "1 " + noun(k);
  if (k == 0) return text(count, " vertices");
  return text(count, " ", plural(k));
}

std::string numbered(std::span<const Index> indices, int k) {
  std::string out = plural(k);
  for (std::size_t i = 0; i < std::min(indices.size(), longest_list); ++i)
    out += (i ? ", " : " ") + std::to_string(indices[i]);
  return out + (indices.size() > longest_list ? ", …" : "");
}

std::string impurity_text(int n) {
  return text("it is a face of no ", noun(n), ", so its link is empty; remove it, or make it a face of a ", noun(n));
}

std::string facet_text(std::span<const Index> cofaces, int n) {
  return text("it is a face of ", counted(static_cast<Offset>(cofaces.size()), n), " (", numbered(cofaces, n),
              "); at most 2 are allowed. Remove the others, or give them their own copies of its vertices");
}

std::string rings_text(std::span<const Ring> rings, int n) {
  Offset tops = 0;
  std::string words;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    tops += static_cast<Offset>(rings[i].tops.size());
    if (i < longest_list) words += (i ? ", " : "") + ring_words(rings[i], n);
  }
  if (rings.size() > longest_list) words += ", …";
  if (n == 2)
    return text("its link has ", rings.size(), " components (", words,
                ") instead of being one circle or one arc. Give each fan of triangles its own copy of the vertex");
  return text("the ", counted(tops, n), " about it form ", rings.size(), " rings (", words,
              ") instead of one. Give each ring its own copy of the ", noun(n - 2));
}

std::string link_text(const std::string& link, int link_dimension, int k, bool split) {
  const std::string wanted = link_dimension == 2 ? "a sphere or a disc" : text("a ", link_dimension, "-sphere or ball");
  return text("its link is ", link, " instead of ", wanted, ". ",
              split ? text("Give each component its own copy of the ", noun(k))
                    : text("Remove or remesh the simplices about the ", noun(k)));
}

}  // namespace derham::detail
