#include "commands.hpp"
#include "survey.hpp"

#include "derham/core/text.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/hodge/laplacian.hpp"
#include "derham/io/form_picture.hpp"
#include "derham/meshes/tori.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

namespace derham::cli {
namespace {

/// Whether everything that the demonstration promises holds.
bool holds(const Survey& s) {
  return s.manifold == Verdict::yes && s.orientable && s.boundary_of_boundary_zero &&
         std::ranges::all_of(s.identity_error, [](double error) { return error < 1e-9; });
}

/// What the certificate says, exact laws, timings.
std::string story(const std::string& title, const Survey& s) {
  std::string out = title + "\n" + to_text(s);
  out += text("  boundary of a boundary: ", s.boundary_of_boundary_zero ? "zero, exactly" : "NOT ZERO", "\n");
  char line[160];
  for (std::size_t k = 0; k < s.identity_error.size(); ++k) {
    std::snprintf(line, sizeof line, "  sum of |s||*s| over degree %zu = C(%d,%zu) volume to %.1e\n", k, s.dimension, k,
                  s.identity_error[k]);
    out += line;
  }
  for (const Survey::Stage& stage : s.stages) {
    std::snprintf(line, sizeof line, "  %-22s %9.3f ms\n", stage.name.c_str(), stage.seconds * 1e3);
    out += line;
  }
  return out + "\n";
}

Json story_json(const std::string& title, const Survey& s) {
  Json json = to_json(s), seconds = Json::object();
  for (const Survey::Stage& stage : s.stages) seconds[stage.name] = stage.seconds;
  json["mesh"] = title;
  json["boundary_of_boundary_zero"] = s.boundary_of_boundary_zero;
  json["identity_error"] = s.identity_error;
  json["seconds"] = seconds;
  return json;
}

/// The angle about the axis as a multivalued function: its steps along edges are a closed 1-form that is no gradient.
Form<3, 1> winding_form(const SimplicialComplex<3>& K, const std::vector<double>& points) {
  const auto angle = [&](Index v) {
    return std::atan2(points[3 * static_cast<std::size_t>(v) + 1], points[3 * static_cast<std::size_t>(v)]);
  };
  Form<3, 1> form(K);
  for (Index e = 0; e < K.size(1); ++e) {
    const auto edge = K.simplex<1>(e);
    form[e] = std::remainder(angle(edge[1]) - angle(edge[0]), 2 * std::acos(-1.0)) / (2 * std::acos(-1.0));
  }
  return form;
}

/// Writes the torus with forms of every degree: the picture of the demonstration.
void write_picture(const std::string& path, const LoadedMesh& loaded) {
  SimplicialComplex<3> K = build_complex<3>(loaded);
  const auto geometry = Geometry<3>::from_mesh(K, loaded.mesh);
  orient_by_volume(K, geometry);
  const HodgeStar<3> star(K, geometry);
  Form<3, 0> height(K);
  for (Index v = 0; v < K.size(0); ++v) height[v] = loaded.mesh.points[3 * static_cast<std::size_t>(v) + 2];
  const Form<3, 1> winding = winding_form(K, loaded.mesh.points);
  Form<3, 3> volume(K);
  for (Index t = 0; t < K.size(3); ++t) volume[t] = 1 / star.diagonal(3)[static_cast<std::size_t>(t)];
  FormPicture<3>(K, 3, loaded.mesh.points)
      .add("height", height)
      .add("laplacian_of_height", laplacian(star, height))
      .add("winding", winding)
      .add("flux_of_winding", star(winding))
      .add("volume", volume)
      .write(path);
}

}  // namespace

Run add_demo(CLI::App& parent, Common& common) {
  CLI::App& command =
      *parent.add_subcommand("demo", "runs everything on a solid torus and on the meshes given, and draws a .vtu");
  const auto paths = std::make_shared<std::vector<std::string>>();
  const auto out = std::make_shared<std::string>("derham_demo.vtu");
  command.add_option("MESH", *paths, "further mesh files");
  command.add_option("-o,--out", *out, "file to draw to");
  const auto reorder = std::make_shared<bool>(false);
  command.add_flag("--reorder", *reorder, "renumber vertices and simplices of the files so that neighbours are near");
  return [&common, paths, out, reorder] {
    Console console(common);
    Json meshes_json = Json::array();
    bool good = true;
    const auto show = [&](const std::string& title, const std::function<LoadedMesh()>& get) {
      const auto start = std::chrono::steady_clock::now();
      LoadedMesh loaded = get();
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      Survey s = survey(loaded, console, true);
      s.stages.insert(s.stages.begin(), {"read or generate", seconds});
      good = good && holds(s);
      if (common.json)
        meshes_json.push_back(story_json(title, s));
      else
        print(story(title, s));
      return loaded;
    };
    const LoadedMesh torus = show("solid torus, generated", [] {
      LoadedMesh generated;
      generated.path = "solid torus";
      generated.mesh = meshes::solid_torus(6, 94);
      return generated;
    });
    for (const std::string& path : *paths) {
      Input input;
      input.path = path;
      input.reorder = *reorder;
      show(path, [&] { return load_mesh(input, console); });
    }
    write_picture(*out, torus);
    if (common.json)
      print(Json{{"ok", good}, {"meshes", meshes_json}, {"picture", *out}});
    else
      print("wrote " + *out + ": open it in ParaView\n");
    return good ? Exit::ok : Exit::check_failed;
  };
}

}  // namespace derham::cli
