#include "commands.hpp"

#include "derham/boundary/matrix.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/matrix_market.hpp"

#include <charconv>
#include <filesystem>
#include <memory>

namespace derham::cli {
namespace {

/// Writes the files of one directory and remembers their names.
class Writer {
 public:
  explicit Writer(std::string directory) : directory_(std::move(directory)) {
    std::error_code code;
    std::filesystem::create_directories(directory_, code);
    if (code || !std::filesystem::is_directory(directory_))
      throw FileError(FileError::Action::write, directory_, 0,
                      "cannot make this directory" + (code ? ": " + code.message() : std::string()));
    remove_old_files();
  }

  [[nodiscard]] std::string next(const std::string& name) {
    names_.push_back(name);
    return directory_ + "/" + name;
  }
  void matrix(const std::string& name, const SignMatrix& m) {
    write_matrix_market(next(name), m.rows, m.cols, m.offsets, m.columns, m.values);
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  /// What an earlier run wrote here: files of another mesh must not stand beside the new ones.
  void remove_old_files() const {
    std::error_code code;
    for (int k = 0; k <= max_dimension; ++k)
      for (const char* name : {"simplices", "d", "boundary", "star"})
        std::filesystem::remove(text(directory_, "/", name, k, std::string_view(name) == "simplices" ? ".txt" : ".mtx"),
                                code);
  }

  std::string directory_;
  std::vector<std::string> names_;
};

/// One simplex a line in index order; top simplices are preceded by their sign.
template <int n>
void write_simplices(const std::string& path, const LoadedMesh& loaded, const SimplicialComplex<n>& K, int k) {
  AtomicFile file(path);
  std::string buffer;
  char digits[24];
  for (Index i = 0; i < K.size(k); ++i) {
    if (k == n) buffer += K.sign(n, i) > 0 ? "+1 " : "-1 ";
    for (const Index v : K.simplex(k, i)) {
      const auto end = std::to_chars(digits, digits + sizeof digits, loaded.position(v)).ptr;
      buffer.append(digits, end);
      buffer += ' ';
    }
    buffer.back() = '\n';
    if (buffer.size() > (1U << 20)) {
      file.write(buffer);
      buffer.clear();
    }
  }
  file.write(buffer);
  file.commit();
}

/// Writes the stars; the reason why there are none, or an empty string.
template <int n>
std::string write_stars(const LoadedMesh& loaded, const SimplicialComplex<n>& K, Writer& writer) {
  if constexpr (n > 4) {
    return text("metric operators are built for dimensions 0 to 4, this complex has ", n);
  } else {
    if (!loaded.mesh.has_points() && !loaded.mesh.has_corners()) return "the mesh has no positions";
    try {
      const HodgeStar<n> star(K, Geometry<n>::from_mesh(K, loaded.mesh));
      for (int k = 0; k <= n; ++k) write_matrix_market(writer.next(text("star", k, ".mtx")), star.diagonal(k));
      return {};
    } catch (const TopologyError& error) {
      return error.what();
    } catch (const GeometryError& error) {
      return error.what();
    }
  }
}

template <int n>
Exit write_operators(const LoadedMesh& loaded, const std::string& directory, const Common& common, Console& console) {
  console.stage("building the complex");
  SimplicialComplex<n> K = build_complex<n>(loaded);
  if constexpr (n <= 4) {
    const MeshData& mesh = loaded.mesh;
    if (K.is_pure() && mesh.ambient_dimension >= n && (mesh.has_points() || mesh.has_corners()))
      orient_by_volume(K, Geometry<n>::from_mesh(K, mesh));
  }
  Writer writer(directory);
  console.stage("writing " + directory);
  for (int k = 0; k <= n; ++k) write_simplices(writer.next(text("simplices", k, ".txt")), loaded, K, k);
  for (int k = 1; k <= n; ++k) {
    writer.matrix(text("d", k - 1, ".mtx"), coboundary_matrix(K, k - 1));
    writer.matrix(text("boundary", k, ".mtx"), boundary_matrix(K, k));
  }
  const std::string why_no_star = write_stars(loaded, K, writer);
  console.clear_stage();
  if (common.json) {
    Json summary{
        {"directory", directory}, {"files", writer.names()}, {"stars", why_no_star.empty()}, {"reason", nullptr}};
    if (!why_no_star.empty()) summary["reason"] = why_no_star;
    print(summary);
  } else {
    print(text(writer.names().size(), " files in ", directory, "\n"));
  }
  if (why_no_star.empty()) return Exit::ok;
  console.message("no star*.mtx: " + why_no_star);
  return Exit::check_failed;
}

}  // namespace

Run add_operators(CLI::App& parent, Common& common) {
  CLI::App& command = *parent.add_subcommand("operators", "writes d, boundary and star as Matrix Market files");
  const auto input = std::make_shared<Input>();
  const auto directory = std::make_shared<std::string>();
  add_input_options(command, *input);
  command.add_option("-o,--out", *directory, "directory to write to, made if need be")->required();
  return [&common, input, directory] {
    if (*directory == "-")
      throw Failure(Exit::usage, "usage", "--out is a directory: several files cannot go to standard output");
    Console console(common);
    const LoadedMesh loaded = load_mesh(*input, console);
    return with_dimension(loaded, [&](auto n) { return write_operators<n()>(loaded, *directory, common, console); });
  };
}

}  // namespace derham::cli
