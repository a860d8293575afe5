#include "commands.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/write_mesh.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/example.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/tori.hpp"
#include "derham/meshes/voxels.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>

namespace derham::cli {
namespace {

constexpr std::array<std::string_view, 12> shape_options{"--dimension", "--cells",  "--jitter", "--seed",
                                                         "--layers",    "--level",  "--rings",  "--segments",
                                                         "--sides",     "--radius", "--minor",  "--spec"};

/// All options of all kinds; each kind reads its own.
struct Recipe {
  std::string kind, out, format, spec;
  int dimension = 3;
  bool dimension_given = false;
  std::string cells_text;
  std::vector<Index> cells;
  Index layers = 8, rings = 6, segments = 94, sides = 24;
  int level = 3;
  double jitter = 0, radius = 1, minor = 0.4;
  std::uint64_t seed = 1;
};

/// "4" or "4,3,2".
std::vector<Index> parsed_cells(const std::string& numbers) {
  std::vector<Index> cells;
  for (const char *at = numbers.data(), *end = at + numbers.size(); at < end; ++at) {
    Index count = 0;
    const auto [next, error] = std::from_chars(at, end, count);
    if (error != std::errc() || (next != end && (*next != ',' || next + 1 == end)))
      throw Failure(Exit::usage, "usage",
                    "--cells is '" + numbers + "'; it is one number, or one per axis as in 4,3,2");
    cells.push_back(count);
    at = next;
  }
  return cells;
}

/// One number stands for all axes.
std::vector<Index> cells_of(const Recipe& r) {
  if (r.dimension < 1 || r.dimension > max_dimension)
    throw Failure(Exit::usage, "usage",
                  text("--dimension is ", r.dimension, "; ", r.kind, " has 1 to ", max_dimension));
  const auto axes = static_cast<std::size_t>(r.dimension);
  if (r.cells.empty()) return std::vector<Index>(axes, 4);
  if (r.cells.size() == 1) return std::vector<Index>(axes, r.cells[0]);
  if (r.dimension_given && r.cells.size() != static_cast<std::size_t>(r.dimension))
    throw Failure(
        Exit::usage, "usage",
        text("--cells has ", r.cells.size(), " numbers for dimension ", r.dimension, "; give one, or one per axis"));
  return r.cells;
}

Index cells_per_axis(const Recipe& r, Index usual) {
  if (r.cells.size() > 1) throw Failure(Exit::usage, "usage", text("'", r.kind, "' takes one number of --cells"));
  return r.cells.empty() ? usual : r.cells[0];
}

meshes::BoxOptions box_options(const Recipe& r) {
  meshes::BoxOptions options;
  options.jitter = r.jitter;
  options.seed = r.seed;
  return options;
}

struct Generator {
  std::vector<std::string> options;  // those that this kind takes
  std::function<MeshData(const Recipe&)> make;
};

const std::map<std::string, Generator>& generators() {
  static const std::vector<std::string> of_a_box{"--dimension", "--cells", "--jitter", "--seed"};
  static const std::map<std::string, Generator> all{
      {"box", {of_a_box, [](const Recipe& r) { return meshes::box(cells_of(r), box_options(r)); }}},
      {"periodic-box", {of_a_box, [](const Recipe& r) { return meshes::periodic_box(cells_of(r), box_options(r)); }}},
      {"ball",
       {{"--dimension", "--layers", "--radius"},
        [](const Recipe& r) { return meshes::ball(r.dimension, r.layers, r.radius); }}},
      {"sphere", {{"--level", "--radius"}, [](const Recipe& r) { return meshes::icosphere(r.level, r.radius); }}},
      {"torus",
       {{"--segments", "--sides", "--radius", "--minor"},
        [](const Recipe& r) { return meshes::torus(r.segments, r.sides, r.radius, r.minor); }}},
      {"solid-torus",
       {{"--rings", "--segments", "--radius", "--minor"},
        [](const Recipe& r) { return meshes::solid_torus(r.rings, r.segments, r.radius, r.minor); }}},
      {"simplex-boundary", {{"--dimension"}, [](const Recipe& r) { return meshes::simplex_boundary(r.dimension); }}},
      {"cross-polytope", {{"--dimension"}, [](const Recipe& r) { return meshes::cross_polytope(r.dimension); }}},
      {"bcc", {{"--cells"}, [](const Recipe& r) { return meshes::bcc_lattice(cells_per_axis(r, 3)); }}},
      {"a-star",
       {{"--dimension", "--cells"},
        [](const Recipe& r) { return meshes::a_star_lattice(r.dimension, cells_per_axis(r, 3)); }}},
      {"600-cell", {{}, [](const Recipe&) { return meshes::cell_600(); }}},
      {"voxels", {{"--spec"}, [](const Recipe& r) { return meshes::voxels(r.spec); }}},
      {"example", {{}, [](const Recipe&) { return meshes::example(); }}},
  };
  return all;
}

/// An option that the kind does not take would be ignored: better say so.
void refuse_foreign_options(const CLI::App& command, const std::string& kind, const std::vector<std::string>& taken) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::ranges::find(shape_options, name) == shape_options.end() ||
        std::ranges::find(taken, name) != taken.end())
      continue;
    std::string listed;
    for (const auto& other : taken) listed += (listed.empty() ? "" : ", ") + other;
    throw Failure(Exit::usage, "usage",
                  text("'", kind, "' does not take ", name, "; it takes ", taken.empty() ? "no options" : listed));
  }
}

MeshFormat output_format(const Recipe& r) {
  if (const auto format = named_format(r.format, writable_formats())) return *format;
  if (r.out == "-") return MeshFormat::facets;
  if (const auto format = format_by_extension(r.out)) return *format;
  throw Failure(Exit::usage, "usage",
                "the name '" + r.out + "' does not tell the format; use " + mesh_extensions + " or --format");
}

}  // namespace

Run add_generate(CLI::App& parent, Common& common) {
  CLI::App& command = *parent.add_subcommand("generate", "makes a mesh");
  const auto recipe = std::make_shared<Recipe>();
  std::vector<std::string> kinds;
  for (const auto& [kind, generator] : generators()) kinds.push_back(kind);
  std::string listed;
  for (const auto& kind : kinds) listed += (listed.empty() ? "" : ", ") + kind;
  command.add_option("KIND", recipe->kind, listed)->required();
  command.add_option("-o,--out", recipe->out, std::string("file to write (") + mesh_extensions + "), - for stdout")
      ->required();
  command.add_option("--format", recipe->format, "instead of the one the file's extension names");
  CLI::Option* dimension =
      command.add_option("--dimension", recipe->dimension,
                         "of the mesh (box, periodic-box, ball, a-star, simplex-boundary, cross-polytope; 3)");
  command.add_option("--cells", recipe->cells_text,
                     "cubes per axis, one number or one per axis (box, periodic-box: 4; bcc, a-star: 3)");
  command.add_option("--jitter", recipe->jitter, "random displacement, in cell sizes (box, periodic-box)");
  command.add_option("--seed", recipe->seed, "of the jitter");
  command.add_option("--layers", recipe->layers, "shells (ball: 8)");
  command.add_option("--level", recipe->level, "subdivisions (sphere: 3)");
  command.add_option("--rings", recipe->rings, "rings of a disk (solid-torus: 6)");
  command.add_option("--segments", recipe->segments, "the long way round (torus, solid-torus: 94)");
  command.add_option("--sides", recipe->sides, "around the tube (torus: 24)");
  command.add_option("--radius", recipe->radius, "ball, sphere; of the core circle (torus, solid-torus): 1");
  command.add_option("--minor", recipe->minor, "radius of the tube (torus, solid-torus): 0.4");
  command.add_option("--spec", recipe->spec,
                     "voxels: a box and boxes taken away (-) or put back (+), e.g. 3x3x1-1,1,0");
  return [&common, recipe, dimension, kinds, listed, self = &command] {
    recipe->dimension_given = dimension->count() > 0;
    recipe->cells = parsed_cells(recipe->cells_text);
    const auto generator = generators().find(recipe->kind);
    if (generator == generators().end())
      throw Failure(
          Exit::usage, "usage",
          "there is no mesh '" + recipe->kind + "'" + suggestion(recipe->kind, kinds) + "; kinds are " + listed);
    refuse_foreign_options(*self, recipe->kind, generator->second.options);
    if (recipe->kind == "voxels" && recipe->spec.empty())
      throw Failure(Exit::usage, "usage", "voxels need --spec, e.g. --spec 3x3x1-1,1,0");
    const MeshFormat format = output_format(*recipe);
    MeshData mesh;
    try {
      mesh = generator->second.make(*recipe);
      write_mesh(recipe->out, mesh, format);
    } catch (const InputError& error) {
      throw Failure(Exit::usage, "usage", error.what());
    }
    const Console console(common);
    if (common.json && recipe->out != "-")
      print(Json{{"file", recipe->out},
                 {"vertices", mesh.vertex_count},
                 {"top_simplices", mesh.simplices.size()},
                 {"dimension", mesh.simplices.dimension()}});
    else
      console.message(text(recipe->out, ": ", mesh.vertex_count, " vertices, ", mesh.simplices.size(),
                           " simplices of dimension ", mesh.simplices.dimension()));
    return Exit::ok;
  };
}

}  // namespace derham::cli
