#include "survey.hpp"

#include "derham/complex/subcomplex.hpp"
#include "derham/core/text.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_report.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/quality.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace derham::cli {
namespace {

/// Runs one stage, shown on a terminal and timed.
template <class Action>
void timed(Survey& s, Console& console, const std::string& name, Action&& action) {
  console.stage(name);
  const auto start = std::chrono::steady_clock::now();
  action();
  s.stages.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
}

/// ∂∂ = 0, entry by entry: in every k-simplex each face of a face is met twice, with opposite signs.
template <int n>
bool boundary_of_boundary_is_zero(const SimplicialComplex<n>& K) {
  std::vector<std::pair<Index, int>> met;
  for (int k = 2; k <= n; ++k) {
    for (Index i = 0; i < K.size(k); ++i) {
      met.clear();
      const auto faces = K.faces(k, i);
      for (int a = 0; a <= k; ++a) {
        const auto ridge = K.faces(k - 1, faces[static_cast<std::size_t>(a)]);
        for (int b = 0; b < k; ++b)
          met.emplace_back(ridge[static_cast<std::size_t>(b)], K.sign(k, i) * face_sign(k - a) * face_sign(k - 1 - b));
      }
      std::ranges::sort(met);
      for (std::size_t j = 0; j < met.size(); j += 2)
        if (met[j].first != met[j + 1].first || met[j].second + met[j + 1].second != 0) return false;
    }
  }
  return true;
}

template <int n>
void fill_metric(Survey& s, const LoadedMesh& loaded, SimplicialComplex<n>& K, Console& console, bool verify) {
  const MeshData& mesh = loaded.mesh;
  if (!mesh.has_points() && !mesh.has_corners()) {
    s.star_missing = "the mesh has no positions";
    return;
  }
  s.ambient_dimension = mesh.ambient_dimension;
  if (!K.is_pure()) {
    s.star_missing = "the complex is not pure";
    return;
  }
  std::optional<Geometry<n>> geometry;
  timed(s, console, "volumes", [&] {
    geometry.emplace(Geometry<n>::from_mesh(K, mesh));
    const QualityReport q = oriented_quality(K, *geometry);
    s.volume = q.total_volume;
    s.degenerate = static_cast<Offset>(q.degenerate.size());
    if (geometry->has_signed_volume() && K.is_orientable()) s.inverted = static_cast<Offset>(q.inverted.size());
  });
  if (!K.is_orientable()) {
    s.star_missing = "the complex is not orientable";
    return;
  }
  if (*s.degenerate > 0) {
    s.star_missing = "there are degenerate simplices";
    return;
  }
  timed(s, console, "dual volumes", [&] {
    const auto [dual, report] = judged_dual(K, *geometry);
    s.delaunay = report.pairwise_delaunay;
    s.one_sided = report.one_sided;
    s.well_centered = report.well_centered;
    s.star.emplace();
    for (const StarVerdict& star : report.star)
      s.star->push_back({star.min, static_cast<Offset>(star.zero.size()), static_cast<Offset>(star.negative.size())});
    for (std::size_t k = 0; verify && k <= n; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < dual.dual[k].size(); ++i) sum += dual.primal[k][i] * dual.dual[k][i];
      const double expected = static_cast<double>(binomial(n, static_cast<int>(k))) * *s.volume;
      s.identity_error.push_back(std::abs(sum / expected - 1));
    }
  });
}

std::string in_words(const std::optional<bool>& value) { return !value ? "undefined" : *value ? "yes" : "no"; }

std::string number(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.10g", value);
  return digits;
}

/// What the file names besides the complex.
template <int n>
void fill_parts(Survey& s, const MeshData& mesh, const SimplicialComplex<n>& K) {
  for (const MeshPart& part : mesh.parts)
    s.parts.push_back({part.name, part.number, part.degree, static_cast<Offset>(part.members.size())});
  s.lower_simplices = mesh.lower_count();
  for (const SimplexList& list : mesh.lower)
    for (Offset i = 0; i < list.size(); ++i)
      if (!K.find(list[i])) ++s.not_faces;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string listed(const std::vector<Index>& counts) {
  std::string out;
  for (std::size_t k = 0; k < counts.size(); ++k) out += (k ? ", " : "") + std::to_string(counts[k]);
  return counts.empty() ? "none" : out;
}

}  // namespace

template <int n>
Survey survey(const LoadedMesh& loaded, Console& console, bool verify) {
  Survey s;
  if (loaded.mesh.simplices.empty()) {
    s.star_missing = "the mesh is empty";
    return s;
  }
  std::optional<SimplicialComplex<n>> built;
  timed(s, console, "complex", [&] { built.emplace(build_complex<n>(loaded)); });
  SimplicialComplex<n>& K = *built;
  s.dimension = n;
  timed(s, console, "certificate", [&] {
    const ManifoldReport report = check_manifold(K);
    s.manifold = report.verdict;
    s.pure = report.pure;
    s.closed = report.closed;
    s.orientable = report.orientable;
    const SimplexSet<n> rim = boundary_simplices(K);
    for (int k = 0; k <= n; ++k) {
      s.simplices.push_back(K.size(k));
      s.boundary_simplices.push_back(rim.size(k));
    }
    s.euler_characteristic = K.euler_characteristic();
    s.components = K.component_count();
  });
  fill_parts(s, loaded.mesh, K);
  if constexpr (n <= 4)
    fill_metric(s, loaded, K, console, verify);
  else
    s.star_missing = "metric quantities are built for dimensions 0 to 4";
  if (verify)
    timed(s, console, "boundary of boundary", [&] { s.boundary_of_boundary_zero = boundary_of_boundary_is_zero(K); });
  console.clear_stage();
  return s;
}

Survey survey(const LoadedMesh& loaded, Console& console, bool verify) {
  return with_dimension(loaded, [&](auto n) { return survey<n()>(loaded, console, verify); });
}

Json to_json(const Survey& s) {
  Json json;
  json["dimension"] = s.dimension;
  json["ambient_dimension"] = or_null(s.ambient_dimension);
  json["simplices"] = s.simplices;
  json["euler_characteristic"] = s.euler_characteristic;
  json["components"] = s.components;
  json["boundary_simplices"] = s.boundary_simplices;
  json["orientable"] = s.orientable;
  json["manifold"] = name(s.manifold);
  json["pure"] = s.pure;
  json["closed"] = s.closed;
  json["volume"] = or_null(s.volume);
  json["inverted"] = or_null(s.inverted);
  json["degenerate"] = or_null(s.degenerate);
  json["delaunay"] = or_null(s.delaunay);
  json["one_sided"] = or_null(s.one_sided);
  json["well_centered"] = or_null(s.well_centered);
  json["star"] = nullptr;
  if (s.star) {
    json["star"] = Json::array();
    for (const Survey::Star& star : *s.star)
      json["star"].push_back({{"min", star.min}, {"zero", star.zero}, {"negative", star.negative}});
  }
  json["parts"] = Json::array();
  for (const Survey::Part& part : s.parts)
    json["parts"].push_back(
        {{"name", part.name}, {"number", part.number}, {"dimension", part.dimension}, {"count", part.count}});
  json["lower_simplices"] = s.lower_simplices;
  json["not_faces"] = s.not_faces;
  return json;
}

namespace {

/// A name as it may be printed: control characters and quotes escaped.
std::string printable(const std::string& name) {
  return Json(name).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string parts_text(const Survey& s) {
  constexpr std::size_t most_shown = 20;
  std::string out;
  if (s.lower_simplices > 0)
    out += text("  lower simplices  ", s.lower_simplices, ", ", s.not_faces, " of them no faces of the complex\n");
  for (std::size_t i = 0; i < s.parts.size() && i < most_shown; ++i) {
    const Survey::Part& part = s.parts[i];
    out += text("  part             ", part.name.empty() ? "" : printable(part.name) + ", ", "number ", part.number,
                ": ", part.count, " simplices of dimension ", part.dimension, "\n");
  }
  if (s.parts.size() > most_shown) out += text("  ", s.parts.size() - most_shown, " more parts; --json lists them\n");
  return out;
}

}  // namespace

std::string to_text(const Survey& s) {
  std::string out = text("  dimension        ", s.dimension);
  if (s.ambient_dimension) out += text(" in R^", *s.ambient_dimension);
  out += "\n  simplices        " + listed(s.simplices) + "\n";
  out += text("  Euler            ", s.euler_characteristic, "\n  components       ", s.components, "\n");
  out += "  boundary         " + (s.closed ? "none (closed)" : listed(s.boundary_simplices)) + "\n";
  out += text("  orientable       ", s.orientable ? "yes" : "no", "\n  manifold         ", name(s.manifold),
              s.pure ? "" : " (not pure)", "\n");
  out += parts_text(s);
  if (s.volume) out += "  volume           " + number(*s.volume) + "\n";
  if (s.inverted) out += text("  inverted         ", *s.inverted, "\n");
  if (s.degenerate) out += text("  degenerate       ", *s.degenerate, "\n");
  if (!s.star) return out + "  star             undefined: " + s.star_missing + "\n";
  out += "  Delaunay         " + in_words(s.delaunay) + ", one-sided at the boundary: " + in_words(s.one_sided) +
         "\n  well-centred     " + in_words(s.well_centered) + "\n";
  for (std::size_t k = 0; k < s.star->size(); ++k) {
    const Survey::Star& star = (*s.star)[k];
    out += text("  star ", k, "           min ", number(star.min), ", ", star.zero, " zero, ", star.negative,
                " negative\n");
  }
  return out;
}

}  // namespace derham::cli
