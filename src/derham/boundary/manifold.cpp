#include "derham/boundary/manifold.hpp"

#include "derham/boundary/collapse.hpp"
#include "derham/boundary/manifold_text.hpp"
#include "derham/boundary/rings.hpp"
#include "derham/boundary/small_homology.hpp"
#include "derham/boundary/star_proof.hpp"
#include "derham/boundary/surface_name.hpp"
#include "derham/complex/incidence.hpp"
#include "derham/core/disjoint_sets.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace derham {
namespace {

constexpr Offset grain = 1024;         // simplices judged by one task
constexpr int collapse_attempts = 32;  // before a link that has the right homology is called unproved

/// What is known about a simplex before it is judged.
enum class Mark : char { none, face_of_unproved, flawed };

/// What the report says of the orientation.
template <int n>
void add_orientation(const SimplicialComplex<n>& K, ManifoldReport& report) {
  report.orientable = K.is_orientable();
  if (report.orientable) return;
  const auto walk = std::span<const Index>(K.orientation().one_sided);
  const auto vertices = K.simplex(n, walk.front());
  report.defects.push_back(
      {DefectKind::orientation,
       {vertices.begin(), vertices.end()},
       text("not orientable: a closed walk across facets through ",
            detail::counted(static_cast<Offset>(walk.size()), n), " (", detail::numbered(walk, n),
            ") returns to it with the orientation reversed. Cut the complex along a facet of the walk, or use its "
            "orientable double cover")});
}

template <int n>
class ManifoldCheck {
 public:
  explicit ManifoldCheck(const SimplicialComplex<n>& K) : K_(K), cofaces_(facet_cofaces(K)) {
    for (int k = 0; k < n; ++k) marks_[index(k)].assign(index(K.size(k)), Mark::none);
  }

  ManifoldReport run() {
    report_.pure = K_.is_pure();
    report_.closed = report_.pure && std::ranges::find(cofaces_.count, Index{1}) == cofaces_.count.end();
    for (const auto [degree, simplex] : K_.maximal_lower()) marks_[index(degree)][index(simplex)] = Mark::flawed;
    check_degree<n - 1>();
    add_orientation(K_, report_);
    if (std::ranges::any_of(report_.defects, [](const auto& d) { return d.kind < DefectKind::unproved; }))
      report_.verdict = Verdict::no;
    else if (report_.count(DefectKind::unproved) > 0)
      report_.verdict = Verdict::unproved;
    return std::move(report_);
  }

 private:
  using Finding = std::optional<std::pair<DefectKind, std::string>>;

  template <class T>
  static std::size_t index(T i) {
    return static_cast<std::size_t>(i);
  }

  /// The kind of a definite defect of a k-simplex.
  static DefectKind kind(int k) {
    if (k == n - 1) return DefectKind::facet;
    return k == n - 2 && k >= 1 ? DefectKind::ring : DefectKind::link;
  }

  /// Judges the simplices of degree k, tells their faces, and goes on with degree k-1.
  template <int k>
  void check_degree() {
    if constexpr (k >= 0) {
      report_maximal(k);
      if constexpr (k == n - 1)
        check_facets();
      else if constexpr (k == n - 2)
        check_rings();
      else if constexpr (k == n - 3)
        check_surfaces();
      else
        check_links<k>();
      if constexpr (k >= 1) mark_faces(k);
      check_degree<k - 1>();
    }
  }

  void report_maximal(int k) {
    for (const auto [degree, simplex] : K_.maximal_lower())
      if (degree == k) add(k, simplex, kind(k), detail::impurity_text(n));
  }

  void mark_faces(int k) {
    for (Index i = 0; i < K_.size(k); ++i) {
      const Mark mark = marks_[index(k)][index(i)];
      if (mark == Mark::none) continue;
      for (const Index face : K_.faces(k, i)) {
        Mark& below = marks_[index(k - 1)][index(face)];
        below = std::max(below, mark);
      }
    }
  }

  void add(int k, Index simplex, DefectKind what, std::string detail) {
    const auto vertices = K_.simplex(k, simplex);
    report_.defects.push_back({what, {vertices.begin(), vertices.end()}, std::move(detail)});
    marks_[index(k)][index(simplex)] = what == DefectKind::unproved ? Mark::face_of_unproved : Mark::flawed;
  }

  /// Calls judge(i, scratch) for every k-simplex that is not flawed already, in parallel; reports findings in order.
  template <class Judge>
  void judge_all(int k, Judge&& judge) {
    const Offset size = K_.size(k);
    std::vector<std::vector<std::pair<Index, Finding>>> findings(index((size + grain - 1) / grain));
    parallel_blocks(size, grain, [&](Offset begin, Offset end) {
      DisjointSets scratch;
      for (auto i = static_cast<Index>(begin); i < end; ++i) {
        if (marks_[index(k)][index(i)] == Mark::flawed) continue;
        if (Finding finding = judge(i, scratch)) findings[index(begin / grain)].emplace_back(i, std::move(finding));
      }
    });
    for (auto& block : findings)
      for (auto& [simplex, finding] : block) add(k, simplex, finding->first, std::move(finding->second));
  }

  void check_facets() {
    if (std::ranges::none_of(cofaces_.count, [](Index count) { return count > 2; })) return;
    const Incidence star = incidence(K_, n - 1, n);
    judge_all(n - 1, [&](Index i, auto&) -> Finding {
      if (star[i].size() <= 2) return {};
      return std::pair(DefectKind::facet, detail::facet_text(star[i], n));
    });
  }

  void check_rings() {
    const Rings<n> rings(K_);
    judge_all(n - 2, [&](Index i, auto&) -> Finding {
      if (rings.is_single_ring(i)) return {};
      return std::pair(kind(n - 2), detail::rings_text(rings.rings(i), n));
    });
  }

  /// Calls visit(position, facet) for the facets of `star` (top simplices) that contain `simplex` of degree k.
  template <class Visit>
  void for_facets_about(int k, Index simplex, std::span<const Index> star, Visit&& visit) const {
    const auto vertices = K_.simplex(k, simplex);
    for (std::size_t s = 0; s < star.size(); ++s) {
      const auto corners = K_.simplex(n, star[s]);
      std::size_t matched = 0;
      for (int j = 0; j <= n; ++j) {
        if (matched < vertices.size() && vertices[matched] == corners[index(j)])
          ++matched;
        else
          visit(s, K_.face_opposite(n, star[s], j));
      }
    }
  }

  /// The link as top simplices minus the simplex, with its own vertex numbers.
  SimplexList link(int k, Index simplex, std::span<const Index> star) const {
    const auto vertices = K_.simplex(k, simplex);
    std::vector<Index> rows;
    rows.reserve(star.size() * index(n - k));
    for (const Index top : star) std::ranges::set_difference(K_.simplex(n, top), vertices, std::back_inserter(rows));
    return detail::compact_rows(n - k - 1, std::move(rows));
  }

  /// Codimension 3. The link is a surface with an arc or circle about each of its vertices: it is a sphere or a disc
  /// iff it is connected and has Euler characteristic 2, or 1 and a boundary.
  void check_surfaces() {
    constexpr int k = n - 3;
    const Incidence star = incidence(K_, k, n);
    std::vector<Index> link_vertices(index(K_.size(k)), 0);
    for (Index coface = 0; coface < K_.size(k + 1); ++coface)
      for (const Index face : K_.faces(k + 1, coface)) ++link_vertices[index(face)];
    judge_all(k, [&](Index i, DisjointSets& scratch) -> Finding {
      if (is_sphere_or_disc(i, star[i], link_vertices[index(i)], scratch)) return {};
      const SimplexList triangles = link(k, i, star[i]);
      const bool split = SimplicialComplex<2>(triangles).component_count() > 1;
      return std::pair(DefectKind::link, detail::link_text(detail::surface_name(triangles), 2, k, split));
    });
  }

  bool is_sphere_or_disc(Index simplex, std::span<const Index> star, Index vertices, DisjointSets& joined) const {
    joined.reset(static_cast<Index>(star.size()));
    Offset boundary = 0;
    for_facets_about(n - 3, simplex, star, [&](std::size_t s, Index facet) {
      if (cofaces_.count[index(facet)] == 1) ++boundary;
      const Index earlier = cofaces_.first[index(facet)];  // the coface with the smaller index
      if (earlier == star[s]) return;
      const auto neighbour = std::ranges::lower_bound(star, earlier) - star.begin();
      joined.unite(static_cast<Index>(s), static_cast<Index>(neighbour));
    });
    const auto triangles = static_cast<Offset>(star.size());
    const Offset euler = vertices - (3 * triangles + boundary) / 2 + triangles;
    return joined.count() == 1 && euler == (boundary == 0 ? 2 : 1);
  }

  /// Codimension 4 and more. Unless a coface is unproved the link is a combinatorial manifold, so a collapse proves it.
  template <int k>
  void check_links() {
    const Incidence star = incidence(K_, k, n);
    judge_all(k, [&](Index i, auto&) { return judge_link<k>(i, star[i]); });
  }

  template <int k>
  Finding judge_link(Index simplex, std::span<const Index> star) const {
    constexpr int d = n - k - 1;
    const bool is_manifold = marks_[index(k)][index(simplex)] == Mark::none;
    bool has_boundary = false;
    for_facets_about(k, simplex, star,
                     [&](std::size_t, Index facet) { has_boundary |= cofaces_.count[index(facet)] == 1; });
    const Puncture puncture = has_boundary ? Puncture::none : Puncture::one_top_simplex;
    const SimplicialComplex<d> L(link(k, simplex, star));
    if (is_manifold && collapses_to_point(L, puncture, 1)) return {};
    const auto homology = small_homology(L);
    if (!(has_boundary ? is_homology_of_point(homology) : is_homology_of_sphere(homology)))
      return std::pair(DefectKind::link, detail::link_text(text("a ", d, is_manifold ? "-manifold" : "-complex",
                                                                " with ", homology_text(homology)),
                                                           d, k, homology.front().betti > 1));
    if (!is_manifold || collapses_to_point(L, puncture, collapse_attempts)) return {};
    return std::pair(
        DefectKind::unproved,
        text("its link has the homology of a ", d, has_boundary ? "-ball" : "-sphere", ", but ", collapse_attempts,
             " greedy collapses did not prove it to be one. Remesh the simplices about "
             "the ",
             detail::noun(k), ", or prove it by other means"));
  }

  const SimplicialComplex<n>& K_;
  FacetCofaces cofaces_;
  std::array<std::vector<Mark>, n + 1> marks_;  // [k] for k < n
  ManifoldReport report_;
};

}  // namespace

std::string_view name(Verdict verdict) noexcept {
  constexpr std::array<std::string_view, 3> names{"yes", "no", "unproved"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string_view name(DefectKind kind) noexcept {
  constexpr std::array<std::string_view, 5> names{"facet", "ring", "link", "unproved", "orientation"};
  return names[static_cast<std::size_t>(kind)];
}

Offset ManifoldReport::count(DefectKind kind) const noexcept {
  return std::ranges::count(defects, kind, &ManifoldDefect::kind);
}

template <int n>
ManifoldReport detail::check_every_link(const SimplicialComplex<n>& K) {
  return ManifoldCheck<n>(K).run();
}

template <int n>
ManifoldReport check_manifold(const SimplicialComplex<n>& K) {
  if constexpr (n == 2 || n == 3) {
    if (const detail::StarProof proof = detail::prove_by_stars(K); proof.is_manifold) {
      ManifoldReport report;
      report.closed = proof.closed;
      add_orientation(K, report);
      return report;
    }
  }
  return detail::check_every_link(K);
}

template <int n>
void require_manifold(const SimplicialComplex<n>& K) {
  const ManifoldReport report = check_manifold(K);
  if (report.verdict == Verdict::yes) return;
  const auto defects = static_cast<Offset>(report.defects.size()) - report.count(DefectKind::orientation);
  const ManifoldDefect& first = report.defects.front();
  throw TopologyError(text(report.verdict == Verdict::no ? "the complex is not a manifold: "
                                                         : "the complex is not proven to be a manifold: ",
                           defects, defects == 1 ? " defect, " : " defects, the first ", "at ",
                           detail::noun(static_cast<int>(first.simplex.size()) - 1), " ",
                           tuple_text(std::span(first.simplex)), ": ", first.detail));
}

#define DERHAM_INSTANTIATE(n)                                                    \
  template ManifoldReport detail::check_every_link(const SimplicialComplex<n>&); \
  template ManifoldReport check_manifold(const SimplicialComplex<n>&);           \
  template void require_manifold(const SimplicialComplex<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
