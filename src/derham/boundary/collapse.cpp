// This follows Benedetti & Lutz, "Random discrete Morse theory and a new library of triangulations", 2014.
#include "derham/boundary/collapse.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace derham {
namespace {

/// The alive cofaces of a face: their number and the exclusive-or of their indices, which is the coface when it is one.
struct CofaceCount {
  Index count = 0;
  Index combined = 0;

  void add(Index coface) {
    ++count;
    combined ^= coface;
  }
  void remove(Index coface) {
    --count;
    combined ^= coface;
  }
};

/// The free faces that wait to be collapsed through: taken in order of arrival, or at random.
class Worklist {
 public:
  explicit Worklist(unsigned attempt) : random_(attempt), in_order_(attempt == 0) {}
  void clear() {
    items_.clear();
    head_ = 0;
  }
  [[nodiscard]] bool empty() const { return head_ == items_.size(); }
  void push(Index item) { items_.push_back(item); }
  Index pop() {
    if (!in_order_) std::swap(items_[head_], items_[head_ + random_() % (items_.size() - head_)]);
    return items_[head_++];
  }

 private:
  std::minstd_rand random_;
  bool in_order_;
  std::vector<Index> items_;
  std::size_t head_ = 0;
};

/// Collapses the alive k-simplices, given by the indices of their `width` = k+1 faces, as far as it goes; `alive_faces`
/// loses the faces collapsed through. True when none is left.
bool collapse_degree(std::span<const Index> faces, std::size_t width, const std::vector<char>& alive,
                     std::vector<char>& alive_faces, Worklist& free_faces) {
  auto left = std::ranges::count(alive, char{1});
  std::vector<CofaceCount> cofaces(alive_faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (alive[i / width]) cofaces[static_cast<std::size_t>(faces[i])].add(static_cast<Index>(i / width));
  free_faces.clear();
  for (std::size_t face = 0; face < cofaces.size(); ++face)
    if (cofaces[face].count == 1) free_faces.push(static_cast<Index>(face));
  while (!free_faces.empty()) {
    const auto face = static_cast<std::size_t>(free_faces.pop());
    if (cofaces[face].count != 1) continue;  // its coface went through another face
    const Index coface = cofaces[face].combined;
    alive_faces[face] = 0;
    --left;
    for (const Index other : faces.subspan(static_cast<std::size_t>(coface) * width, width)) {
      CofaceCount& rest = cofaces[static_cast<std::size_t>(other)];
      rest.remove(coface);
      if (rest.count == 1) free_faces.push(other);
    }
  }
  return left == 0;
}

template <int n>
bool collapses(const SimplicialComplex<n>& K, Index removed_top, unsigned attempt) {
  Worklist free_faces(attempt);
  std::vector<char> alive(static_cast<std::size_t>(K.size(n)), 1);
  if (removed_top >= 0) alive[static_cast<std::size_t>(removed_top)] = 0;
  for (int k = n; k >= 1; --k) {
    std::vector<char> alive_faces(static_cast<std::size_t>(K.size(k - 1)), 1);
    if (!collapse_degree(K.face_table(k), static_cast<std::size_t>(k) + 1, alive, alive_faces, free_faces))
      return false;
    alive.swap(alive_faces);
  }
  return std::ranges::count(alive, char{1}) == 1;
}

}  // namespace

template <int n>
bool collapses_to_point(const SimplicialComplex<n>& K, Puncture puncture, int attempts) {
  if (attempts < 1) throw InputError(text("attempts is ", attempts, "; it must be at least 1"));
  const Index tops = K.size(n);
  if (tops == 0) return false;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const auto spread = static_cast<std::uint64_t>(attempt) * 2654435761U;  // another top simplex in every attempt
    const Index removed =
        puncture == Puncture::none ? Index{-1} : static_cast<Index>(spread % static_cast<std::uint64_t>(tops));
    if (collapses(K, removed, static_cast<unsigned>(attempt))) return true;
  }
  return false;
}

template bool collapses_to_point(const SimplicialComplex<0>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<1>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<2>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<3>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<4>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<5>&, Puncture, int);
template bool collapses_to_point(const SimplicialComplex<6>&, Puncture, int);

}  // namespace derham
