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

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace derham::cli {
namespace {

/// One mesh from file or generator to verdicts: what the certificate says, exact laws, timings.
bool show(const std::string& title, const LoadedMesh& loaded, double seconds_to_get, Console& console) {
  const Survey s = survey(loaded, console, true);
  std::string out = title + "\n" + to_text(s);
  out += text("  boundary of a boundary: ", s.boundary_of_boundary_zero ? "zero, exactly" : "NOT ZERO", "\n");
  bool identities = true;
  for (std::size_t k = 0; k < s.identity_error.size(); ++k) {
    char line[160];
    std::snprintf(line, sizeof line, "  sum of |s||*s| over degree %zu = C(%d,%zu) volume to %.1e\n", k, s.dimension, k,
                  s.identity_error[k]);
    out += line;
    identities = identities && s.identity_error[k] < 1e-9;
  }
  const auto time = [&](const std::string& stage, double seconds) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-22s %9.3f ms\n", stage.c_str(), seconds * 1e3);
    out += line;
  };
  time("read or generate", seconds_to_get);
  for (const Survey::Stage& stage : s.stages) time(stage.name, stage.seconds);
  print(out + "\n");
  return s.manifold == Verdict::yes && s.orientable && s.boundary_of_boundary_zero && identities;
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
  add_common_options(command, common);
  return [&common, paths, out] {
    Console console(common);
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto since = [&](auto start) { return std::chrono::duration<double>(now() - start).count(); };
    auto start = now();
    LoadedMesh torus;
    torus.path = "solid torus";
    torus.mesh = meshes::solid_torus(6, 94);
    bool good = show("solid torus, generated", torus, since(start), console);
    for (const std::string& path : *paths) {
      start = now();
      const LoadedMesh loaded = load_mesh({path, "", false}, console);
      good = show(path, loaded, since(start), console) && good;
    }
    write_picture(*out, torus);
    print("wrote " + *out + ": open it in ParaView\n");
    return good ? Exit::ok : Exit::check_failed;
  };
}

}  // namespace derham::cli
