#include "commands.hpp"

#include "derham/core/text.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/geometry/circumcenter.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/text_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace derham::cli {
namespace {

/// A point of the page: x to the right, y downwards, depth towards the eye.
struct Place {
  double x = 0, y = 0, depth = 0;
};

/// Parallel projection. The plane is seen from above, space a little from above and from the side.
class Projection {
 public:
  /// `up` is the axis that points upwards in space.
  Projection(int dimension, int up) : plane_(dimension == 2), up_(static_cast<std::size_t>(up)) {}

  [[nodiscard]] Place operator()(const double* point) const {
    if (plane_) return {point[0], -point[1], 0};
    const double first = point[(up_ + 1) % 3], second = point[(up_ + 2) % 3], height = point[up_];
    const double across = std::cos(turn) * second - std::sin(turn) * first,
                 ahead = std::cos(turn) * first + std::sin(turn) * second;
    return {across, std::sin(tilt) * ahead - std::cos(tilt) * height, std::cos(tilt) * ahead + std::sin(tilt) * height};
  }

 private:
  static constexpr double turn = 0.6, tilt = 0.45;  // radians, about the vertical and the horizontal axis

  bool plane_;
  std::size_t up_;
};

/// How a picture is made.
struct Style {
  double width = 800;  // pixels
  bool mesh_alone = false;
  std::string up = "z";
};

/// Something to draw: a triangle, a side of it, or what lies of a dual edge in the plane of the triangle.
struct Stroke {
  enum Kind : std::uint8_t { triangle, edge, positive, zero, negative };

  double depth = 0;
  Kind kind = triangle;
  std::array<Place, 3> corner;  // two of them for lines
  double brightness = 1;        // of a triangle
};

/// Brightness of a triangle, by the angle between its normal and the line of sight.
double brightness(const std::array<Place, 3>& p) {
  const double ax = p[1].x - p[0].x, ay = p[1].y - p[0].y, az = p[1].depth - p[0].depth;
  const double bx = p[2].x - p[0].x, by = p[2].y - p[0].y, bz = p[2].depth - p[0].depth;
  const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
  const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
  return length > 0 ? 0.55 + 0.45 * std::abs(nz) / length : 1;
}

/// The strokes of triangle t: its sides, and from its circumcentre to the middles of the sides.
void add_triangle(const SimplicialComplex<2>& K, const Geometry<2>& geometry, const Projection& projected,
                  const CircumcentricDual<2>* dual, Index t, std::vector<Stroke>& strokes) {
  const auto points = geometry.corners<2>(K, t);
  const std::array<Place, 3> corner{projected(points[0]), projected(points[1]), projected(points[2])};
  const double depth = (corner[0].depth + corner[1].depth + corner[2].depth) / 3;
  strokes.push_back({depth, Stroke::triangle, corner, brightness(corner)});
  for (std::size_t v = 0; v < 3; ++v)
    strokes.push_back({depth, Stroke::edge, {corner[(v + 1) % 3], corner[(v + 2) % 3], {}}, 1});
  if (dual == nullptr || std::ranges::binary_search(dual->degenerate, t)) return;
  const Place center = projected(circumcenter<2>(K, geometry, 2, t).point.data());
  for (std::size_t v = 0; v < 3; ++v) {
    const std::size_t a = (v + 1) % 3, b = (v + 2) % 3;
    const double length = dual->dual[1][static_cast<std::size_t>(K.face_opposite(2, t, static_cast<int>(v)))];
    const Place middle{(corner[a].x + corner[b].x) / 2, (corner[a].y + corner[b].y) / 2, 0};
    const auto kind = length > 0 ? Stroke::positive : length < 0 ? Stroke::negative : Stroke::zero;
    strokes.push_back({depth, kind, {center, middle, {}}, 1});
  }
}

/// Back to front; where nothing lies behind anything, triangles under lines under dual edges.
std::vector<Stroke> strokes_of(const SimplicialComplex<2>& K, const Geometry<2>& geometry, const Projection& projected,
                               const CircumcentricDual<2>* dual) {
  std::vector<Stroke> strokes;
  for (Index t = 0; t < K.size(2); ++t) add_triangle(K, geometry, projected, dual, t, strokes);
  std::ranges::stable_sort(strokes, [](const Stroke& a, const Stroke& b) {
    return std::pair(a.depth, a.kind) < std::pair(b.depth, b.kind);
  });
  return strokes;
}

/// An SVG file whose triangles fill a page of the given width, in pixels.
class SvgPage {
 public:
  SvgPage(const std::string& path, const std::vector<Stroke>& strokes, double width)
      : file_(path), out_(file_), width_(width) {
    double triangles = 0;
    for (const Stroke& stroke : strokes) {
      if (stroke.kind != Stroke::triangle) continue;
      ++triangles;
      for (const Place& p : stroke.corner) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      }
    }
    const double across = high_.x - low_.x, down = high_.y - low_.y, extent = std::max(across, down / 2);
    scale_ = extent > 0 ? (width - 2 * margin) / extent : 1;
    height_ = down * scale_ + 2 * margin;
    pen_ = std::min(1.0, std::sqrt(width * height_ / triangles) / 40);
    write_head();
    for (const Stroke& stroke : strokes) write(stroke);
    out_.put("</svg>\n").flush();
    file_.commit();
  }

 private:
  static constexpr double margin = 10, infinite = std::numeric_limits<double>::infinity();

  void write_head() {
    out_.put("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
    number(width_).put("\" height=\"");
    number(height_).put("\">\n<style>\npath { stroke-linejoin: round; stroke-linecap: round; fill: none }\n");
    define_line("edge", "#5c6b77", 0.8);
    define_line("positive", "#1f77b4", 1.6);
    define_line("zero", "#e6a700", 3);
    define_line("negative", "#d62728", 2.2);
    out_.put("</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n");
  }

  void define_line(const char* name, const char* colour, double thickness) {
    out_.put('.').put(name).put(" { stroke: ").put(colour).put("; stroke-width: ");
    number(thickness * pen_).put(" }\n");
  }

  void write(const Stroke& stroke) {
    constexpr std::array<const char*, 5> classes{"", "edge", "positive", "zero", "negative"};
    const bool filled = stroke.kind == Stroke::triangle;
    if (filled) {
      out_.put("<path style=\"fill: rgb(").put(static_cast<int>(236 * stroke.brightness));
      out_.put(',').put(static_cast<int>(240 * stroke.brightness));
      out_.put(',').put(static_cast<int>(243 * stroke.brightness)).put(")\"");
    } else {
      out_.put("<path class=\"").put(classes[stroke.kind]).put('"');
    }
    place(" d=\"M", stroke.corner[0]);
    place("L", stroke.corner[1]);
    if (filled) place("L", stroke.corner[2]);
    out_.put(filled ? "Z\"/>\n" : "\"/>\n");
  }

  void place(const char* command, const Place& p) {
    out_.put(command);
    number((p.x - low_.x) * scale_ + margin).put(' ');
    number((p.y - low_.y) * scale_ + margin);
  }

  TextWriter& number(double x) { return out_.put(std::round(x * 100) / 100); }

  AtomicFile file_;
  TextWriter out_;
  double width_, height_ = 0, scale_ = 1;
  double pen_ = 1;  // thinner for small triangles
  Place low_{infinite, infinite}, high_{-infinite, -infinite};
};

Exit draw(const LoadedMesh& loaded, const std::string& path, const Style& style, const Common& common,
          Console& console) {
  const MeshData& mesh = loaded.mesh;
  if (mesh.simplices.dimension() != 2 || !(mesh.has_points() || mesh.has_corners()) || mesh.ambient_dimension < 2 ||
      mesh.ambient_dimension > 3)
    throw Failure(Exit::unreadable, "input",
                  "draw takes triangles with positions in the plane or in space; other meshes can be written as .vtu "
                  "by 'derham convert'",
                  loaded.path);
  const SimplicialComplex<2> K = build_complex<2>(loaded);
  const auto geometry = Geometry<2>::from_mesh(K, mesh);
  const Projection projected(geometry.coordinate_dimension(), style.up[0] - 'x');
  const bool with_dual = !style.mesh_alone;
  CircumcentricDual<2> dual;
  if (with_dual) dual = circumcentric_dual(K, geometry);
  const SvgPage page(path, strokes_of(K, geometry, projected, with_dual ? &dual : nullptr), style.width);
  std::array<Index, 3> signs{};  // negative, zero, positive
  if (with_dual)
    for (const double length : dual.dual[1]) ++signs[length < 0 ? 0 : length > 0 ? 2 : 1];
  if (common.json) {
    Json summary{{"picture", path}, {"triangles", K.size(2)}, {"dual_edges", nullptr}};
    if (with_dual) summary["dual_edges"] = {{"negative", signs[0]}, {"zero", signs[1]}, {"positive", signs[2]}};
    if (path != "-") print(summary);
  } else if (with_dual) {
    console.message(text("dual lengths: ", signs[2], " positive (blue), ", signs[1], " zero (yellow), ", signs[0],
                         " negative (red)"));
  }
  return Exit::ok;
}

}  // namespace

Run add_draw(CLI::App& parent, Common& common) {
  CLI::App& command = *parent.add_subcommand("draw", "draws triangles and their dual cells as an SVG picture");
  const auto input = std::make_shared<Input>();
  const auto path = std::make_shared<std::string>();
  const auto style = std::make_shared<Style>();
  add_input_options(command, *input);
  command.add_option("-o,--out", *path, "file to draw to, - for stdout")->required();
  command.add_option("--width", style->width, "in pixels")->check(CLI::Range(100.0, 20000.0));
  command.add_option("--up", style->up, "the axis that points upwards in space: x, y or z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command.add_flag("--mesh-alone", style->mesh_alone, "without dual cells");
  return [&common, input, path, style] {
    Console console(common);
    const LoadedMesh loaded = load_mesh(*input, console);
    return draw(loaded, *path, *style, common, console);
  };
}

}  // namespace derham::cli
