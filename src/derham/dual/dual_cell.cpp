#include "derham/dual/dual_cell.hpp"

#include "derham/complex/local_faces.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/circumcenter.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace derham {

namespace {

// One top simplex seen from a face of it: all its circumcentres, moved so that the face's own is at a common place.
template <int n>
class TopAround {
 public:
  TopAround(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Index t, int k, Index i)
      : complex_(&K), geometry_(&geometry), top_(t), index_(face_indices(K, t)) {
    for (unsigned m = 1; m <= full_mask<n>; ++m)
      if (mask_degree(m) == k && index_[m] == i) mask_ = m;
  }

  [[nodiscard]] Index top() const noexcept { return top_; }
  [[nodiscard]] unsigned mask() const noexcept { return mask_; }
  [[nodiscard]] Index index(unsigned mask) const noexcept { return index_[mask]; }

  // Circumcentre of a face, in the chart of this top simplex.
  [[nodiscard]] std::vector<double> center(unsigned mask) const {
    const auto corner = geometry_->corners(*complex_, top_);
    const int d = geometry_->coordinate_dimension();
    std::vector<double> points;
    for (int v = 0; v <= n; ++v)
      if ((mask >> v) & 1U) points.insert(points.end(), corner[v], corner[v] + d);
    try {
      return circumcenter(points, mask_degree(mask), d, geometry_->relative_flatness()).point;
    } catch (const GeometryError&) {
      throw GeometryError(simplex_text(*complex_, mask_degree(mask), index_[mask]) +
                          " is flat, so the dual cells around it do not exist");
    }
  }

 private:
  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  Index top_;
  FaceArray<n, Index> index_;
  unsigned mask_ = 0;
};

// The circumcentres of one cell, each once, in a common chart.
template <int n>
class Points {
 public:
  explicit Points(DualCell& cell) : cell_(&cell) {}

  Index operator()(const TopAround<n>& around, unsigned mask) {
    const auto [entry, fresh] =
        number_.try_emplace({mask_degree(mask), around.index(mask)}, static_cast<Index>(number_.size()));
    if (fresh) {
      auto point = around.center(mask);
      const auto own = around.center(around.mask());
      if (home_.empty()) home_ = own;
      for (std::size_t c = 0; c < point.size(); ++c) point[c] += home_[c] - own[c];
      cell_->points.insert(cell_->points.end(), point.begin(), point.end());
    }
    return entry->second;
  }

 private:
  DualCell* cell_;
  std::map<std::pair<int, Index>, Index> number_;
  std::vector<double> home_;
};

// A top simplex in the ring about an (n-2)-simplex, with the two facets that lead on.
struct Step {
  Index top, facet[2];  // point numbers
};

// The rings made of steps, as loops facet, top, facet, top, …; an open ring is closed through the point `apex`.
std::vector<std::vector<Index>> rings(std::vector<Step> steps, Index apex) {
  std::map<Index, std::vector<std::size_t>> at;  // facet -> steps
  for (std::size_t s = 0; s < steps.size(); ++s)
    for (const Index f : steps[s].facet) at[f].push_back(s);
  std::vector<bool> visited(steps.size(), false);
  std::vector<std::vector<Index>> result;
  const auto walk = [&](std::size_t s, Index facet, bool open) {
    std::vector<Index> loop;
    if (open) loop.push_back(apex);
    loop.push_back(facet);
    while (!visited[s]) {
      visited[s] = true;
      loop.push_back(steps[s].top);
      facet = steps[s].facet[0] == facet ? steps[s].facet[1] : steps[s].facet[0];
      if (facet != loop[open ? 1 : 0]) loop.push_back(facet);
      const auto& next = at[facet];
      if (next.size() == 2) s = next[0] == s ? next[1] : next[0];
    }
    result.push_back(std::move(loop));
  };
  for (const auto& [facet, around] : at)
    if (around.size() == 1 && !visited[around[0]]) walk(around[0], facet, true);
  for (std::size_t s = 0; s < steps.size(); ++s)
    if (!visited[s]) walk(s, steps[s].facet[0], false);
  return result;
}

}  // namespace

template <int n>
DualCells<n>::DualCells(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k)
    : complex_(&K), geometry_(&geometry), degree_(k), tops_(incidence(K, k, n)) {
  geometry.require_fits(K);
}

template <int n>
void DualCells<n>::require_index(Index i) const {
  const Index size = complex_->size(degree_);
  if (i < 0 || i >= size)
    throw InputError(text("the dual cell of ", degree_, "-simplex ", i, "; the complex has ", size, " ", degree_,
                          "-simplices, numbered from 0"));
}

template <int n>
std::vector<DualFlag> DualCells<n>::flags(Index i) const {
  require_index(i);
  const int d = geometry_->coordinate_dimension();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  std::vector<DualFlag> result;
  DualCell cell;
  Points<n> points(cell);
  for (const Index t : tops_[i]) {
    const TopAround<n> around(*complex_, *geometry_, t, degree_, i);
    const auto corners = geometry_->corners(*complex_, t);
    const SimplexMetric<n> metric(corners, d, geometry_->relative_flatness(), geometry_->roundoff(corners),
                                  scratch.data());
    if (metric.degenerate)
      throw GeometryError(simplex_text(*complex_, n, t) + " is flat, so the dual cells around it do not exist");
    std::vector<int> order;  // in which the missing vertices join
    for (int v = 0; v <= n; ++v)
      if (((around.mask() >> v) & 1U) == 0) order.push_back(v);
    do {
      DualFlag flag{t, {}, 1};
      unsigned mask = around.mask();
      const auto add = [&] {
        const auto d_size = static_cast<std::size_t>(d), at = static_cast<std::size_t>(points(around, mask)) * d_size;
        for (std::size_t c = 0; c < d_size; ++c) flag.points.push_back(cell.points[at + c]);
      };
      add();
      for (std::size_t j = 0; j < order.size(); ++j) {
        mask |= 1U << order[j];
        add();
        flag.signed_volume *= metric.height[mask][order[j]] / static_cast<double>(j + 1) * metric.unit;
      }
      result.push_back(std::move(flag));
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return result;
}

template <int n>
DualCell DualCells<n>::cell(Index i) const {
  require_index(i);
  DualCell result;
  result.dimension = n - degree_;
  if (result.dimension > 3)
    throw InputError(text("the dual cell of a ", degree_, "-simplex has dimension ", result.dimension,
                          "; up to 3 can be drawn; take its flags instead"));
  Points<n> point(result);
  std::map<Index, std::vector<Step>> steps;                     // about each (n-2)-simplex
  std::map<Index, Index> apex;                                  // its own point, should its ring be open
  std::map<Index, std::vector<std::pair<Index, unsigned>>> at;  // facet -> top simplices and masks
  const int k = degree_;
  std::vector<TopAround<n>> around;
  for (const Index t : tops_[i]) around.emplace_back(*complex_, *geometry_, t, k, i);
  for (std::size_t a = 0; a < around.size(); ++a)
    for (int v = 0; v <= n; ++v) {
      const unsigned facet = full_mask<n> & ~(1U << v);
      if (k < n && (facet & around[a].mask()) == around[a].mask())
        at[around[a].index(facet)].push_back({static_cast<Index>(a), facet});
    }
  for (const auto& [facet, tops] : at)
    if (tops.size() > 2)
      throw TopologyError(text(simplex_text(*complex_, n - 1, facet), " has ", tops.size(),
                               " top simplices; dual cells exist where every facet has at most two"));
  if (result.dimension == 0) (void)point(around.front(), full_mask<n>);
  if (result.dimension == 1) {
    std::vector<Index> path;
    for (const auto& [top, facet] : at.at(i)) {
      if (path.size() == 1) path.push_back(point(around[static_cast<std::size_t>(top)], facet));
      path.push_back(point(around[static_cast<std::size_t>(top)], full_mask<n>));
    }
    if (path.size() == 1) path.push_back(point(around.front(), at.at(i).front().second));
    result.polylines.push_back(std::move(path));
  }
  if (result.dimension < 2) return result;
  for (const auto& top : around)
    for (int v = 0; v <= n; ++v)
      for (int w = v + 1; w <= n; ++w) {
        const unsigned ridge = full_mask<n> & ~(1U << v) & ~(1U << w);
        if ((ridge & top.mask()) != top.mask()) continue;
        const Index r = top.index(ridge);
        steps[r].push_back({point(top, full_mask<n>), {point(top, ridge | (1U << v)), point(top, ridge | (1U << w))}});
      }
  // Boundary facets open the rings of their ridges, and cut a quadrilateral from the boundary of a solid cell.
  for (const auto& [facet, tops] : at) {
    if (tops.size() != 1) continue;
    const auto& top = around[static_cast<std::size_t>(tops[0].first)];
    const unsigned mask = tops[0].second;
    std::vector<Index> quadrilateral{point(top, top.mask())};
    for (int v = 0; v <= n; ++v) {
      const unsigned ridge = mask & ~(1U << v);
      if (ridge == mask || (ridge & top.mask()) != top.mask()) continue;
      apex[top.index(ridge)] = point(top, ridge);
      quadrilateral.push_back(point(top, ridge));
      if (quadrilateral.size() == 2) quadrilateral.push_back(point(top, mask));
    }
    if (result.dimension == 3) result.polygons.push_back(std::move(quadrilateral));
  }
  for (auto& [ridge, ring] : steps) {
    const auto own = apex.find(ridge);
    for (auto& loop : rings(std::move(ring), own == apex.end() ? -1 : own->second))
      result.polygons.push_back(std::move(loop));
  }
  return result;
}

template class DualCells<0>;
template class DualCells<1>;
template class DualCells<2>;
template class DualCells<3>;
template class DualCells<4>;

}  // namespace derham
