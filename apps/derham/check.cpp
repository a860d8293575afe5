#include "commands.hpp"

#include "derham/boundary/manifold.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/quality.hpp"

#include <algorithm>
#include <map>
#include <memory>

namespace derham::cli {
namespace {

struct Defect {
  std::string kind;
  std::vector<std::int64_t> simplex;
  std::string detail;
};

class DefectList {
 public:
  DefectList(const LoadedMesh& loaded, bool all) : loaded_(loaded), all_(all) {}

  void add(const std::string& kind, std::span<const Index> simplex, std::string detail) {
    if (++counts_[kind] > most_shown && !all_) return;
    const std::string tags = loaded_.tags_text(simplex);
    if (!tags.empty()) detail += " [" + tags + "]";
    Defect defect{kind, {}, std::move(detail)};
    for (const Index v : simplex) defect.simplex.push_back(loaded_.position(v));
    std::ranges::sort(defect.simplex);
    defects_.push_back(std::move(defect));
  }
  [[nodiscard]] const std::vector<Defect>& shown() const { return defects_; }
  [[nodiscard]] const std::map<std::string, Offset>& counts() const { return counts_; }

 private:
  static constexpr Offset most_shown = 20;
  const LoadedMesh& loaded_;
  bool all_;
  std::vector<Defect> defects_;
  std::map<std::string, Offset> counts_;
};

/// Rows that no complex can hold are defects here; the certificate then looks at the others. Whether there were any.
bool take_out_bad_rows(LoadedMesh& loaded, DefectList& defects, Console& console) {
  const SimplexList& rows = loaded.mesh.simplices;
  const InputReport report = check_input(rows, loaded.mesh.vertex_count);
  std::vector<Offset> bad;
  for (const auto& [row, vertex] : report.repeats) {
    bad.push_back(row);
    defects.add("repeat", rows[row],
                text("row ", row, loaded.row_text(row), " has vertex ", loaded.position(vertex),
                     " more than once; the vertices of a simplex are distinct. Remove the row, or give the corner a "
                     "vertex of its own"));
  }
  for (const auto& [row, first_row] : report.duplicates) {
    bad.push_back(row);
    defects.add(
        "duplicate", rows[row],
        text("row ", row, loaded.row_text(row), " has the same vertices as row ", first_row, loaded.row_text(first_row),
             "; remove one, or, where a glued mesh identifies too much, subdivide it"));
  }
  if (bad.empty()) return false;
  std::ranges::sort(bad);
  bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
  loaded.remove_rows(bad);
  console.message(text(loaded.path, ": looking at the complex without the ", bad.size(),
                       " rows that none can hold; details below number its simplices without them"));
  return true;
}

template <int n>
void check_metric(const LoadedMesh& loaded, SimplicialComplex<n>& K, DefectList& defects) {
  const MeshData& mesh = loaded.mesh;
  if constexpr (n >= 1 && n <= 4) {
    if (!K.is_pure() || !(mesh.has_points() || mesh.has_corners())) return;
    const auto geometry = Geometry<n>::from_mesh(K, mesh);
    const QualityReport report = oriented_quality(K, geometry);
    for (const Index t : report.inverted)
      defects.add("inverted", K.simplex(n, t),
                  "its volume has the sign opposite to its neighbours': it is folded over them" + loaded.row_text(t) +
                      ". Move a vertex, or flip the simplices around it");
    for (const Index t : report.degenerate)
      defects.add("degenerate", K.simplex(n, t),
                  "it is flat: its circumcentre and its duals do not exist" + loaded.row_text(t) +
                      ". Move a vertex, or collapse its shortest edge");
  }
}

template <int n>
bool check(const LoadedMesh& loaded, DefectList& defects, Console& console) {
  console.stage("building the complex");
  SimplicialComplex<n> K = build_complex<n>(loaded);
  console.stage("checking links");
  const ManifoldReport report = check_manifold(K);
  for (const ManifoldDefect& defect : report.defects)
    defects.add(std::string(name(defect.kind)), defect.simplex, defect.detail);
  console.stage("checking volumes");
  check_metric(loaded, K, defects);
  console.clear_stage();
  return report.verdict == Verdict::yes && report.orientable;
}

void print_text(const std::string& path, const DefectList& defects, bool ok) {
  std::string out = path + ": " + (ok ? "an oriented manifold, nothing inverted or degenerate" : "not sound") + "\n";
  for (const auto& [kind, count] : defects.counts()) out += text("  ", kind, ": ", count, "\n");
  for (const Defect& defect : defects.shown()) {
    out += defect.kind + " (";
    for (std::size_t i = 0; i < defect.simplex.size(); ++i) out += (i ? ", " : "") + std::to_string(defect.simplex[i]);
    out += "): " + defect.detail + "\n";
  }
  Offset hidden = -static_cast<Offset>(defects.shown().size());
  for (const auto& [kind, count] : defects.counts()) hidden += count;
  if (hidden > 0) out += text(hidden, " more; --all lists them\n");
  print(out);
}

void print_json(const DefectList& defects, bool ok) {
  Json list = Json::array(), counts = Json::object();
  for (const Defect& defect : defects.shown())
    list.push_back({{"kind", defect.kind}, {"simplex", defect.simplex}, {"detail", defect.detail}});
  for (const auto& [kind, count] : defects.counts()) counts[kind] = count;
  print(Json{{"ok", ok}, {"counts", counts}, {"defects", list}});
}

}  // namespace

Run add_check(CLI::App& parent, Common& common) {
  CLI::App& command =
      *parent.add_subcommand("check", "the certificate: manifold, oriented, nothing inverted or degenerate");
  const auto input = std::make_shared<Input>();
  const auto all = std::make_shared<bool>(false);
  add_input_options(command, *input);
  command.add_flag("--all", *all, "list every defect, not 20 of a kind");
  return [&common, input, all] {
    Console console(common);
    LoadedMesh loaded = read_only(*input, console);
    DefectList defects(loaded, *all);
    const bool bad_rows = take_out_bad_rows(loaded, defects, console);
    settle_unused(loaded, input->drop_unused || bad_rows, console);
    reorder_if_asked(loaded, *input, console);
    const bool sound = with_dimension(loaded, [&](auto n) { return check<n()>(loaded, defects, console); });
    const bool ok = sound && defects.counts().empty();
    if (common.json)
      print_json(defects, ok);
    else
      print_text(input->path, defects, ok);
    return ok ? Exit::ok : Exit::check_failed;
  };
}

}  // namespace derham::cli
