// This follows Benedetti & Lutz, "Random discrete Morse theory and a new library of triangulations", 2014.
#include "derham/boundary/collapse.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace derham {
namespace {

/// The alive cofaces of a face: their number and the exclusive-or of their indices, which is the coface when it is one.
struct Cofaces {
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

template <int n>
bool collapses(const SimplicialComplex<n>& K, Index removed_top, unsigned attempt) {
  Worklist free_faces(attempt);
  std::vector<char> alive(static_cast<std::size_t>(K.size(n)), 1), alive_below;
  Index left = K.size(n);
  if (removed_top >= 0) {
    alive[static_cast<std::size_t>(removed_top)] = 0;
    --left;
  }
  for (int k = n; k >= 1; --k) {
    Index left_below = K.size(k - 1);
    alive_below.assign(static_cast<std::size_t>(left_below), 1);
    std::vector<Cofaces> cofaces(static_cast<std::size_t>(left_below));
    for (Index s = 0; s < K.size(k); ++s) {
      if (!alive[static_cast<std::size_t>(s)]) continue;
      for (const Index face : K.faces(k, s)) cofaces[static_cast<std::size_t>(face)].add(s);
    }
    free_faces.clear();
    for (Index face = 0; face < K.size(k - 1); ++face)
      if (cofaces[static_cast<std::size_t>(face)].count == 1) free_faces.push(face);
    while (!free_faces.empty()) {
      const auto face = static_cast<std::size_t>(free_faces.pop());
      if (cofaces[face].count != 1) continue;  // its coface went through another face
      const Index coface = cofaces[face].combined;
      alive_below[face] = 0;
      --left_below;
      --left;
      for (const Index other : K.faces(k, coface)) {
        Cofaces& rest = cofaces[static_cast<std::size_t>(other)];
        rest.remove(coface);
        if (rest.count == 1) free_faces.push(other);
      }
    }
    if (left > 0) return false;
    alive.swap(alive_below);
    left = left_below;
  }
  return left == 1;
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
