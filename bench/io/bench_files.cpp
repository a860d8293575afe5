#include "bench/io/bench_files.hpp"

#include "bench/support/meshes.hpp"
#include "derham/io/write_mesh.hpp"

#include <zlib.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace derham::bench {
namespace {

using Encoding = WriteOptions::Encoding;

template <MeshFormat format, Encoding encoding = Encoding::usual, bool gmsh_41 = false>
void write(const std::string& path, const MeshData& mesh) {
  write_mesh(path, mesh, format, {encoding, gmsh_41});
}

// Gmsh 4.1 with one block, and so one header line, per element.
void write_gmsh_blocks(const std::string& path, const MeshData& mesh) {
  write<MeshFormat::gmsh, Encoding::ascii, true>(path, mesh);
  std::string content;
  {
    std::ifstream file(path, std::ios::binary);
    content.assign(std::istreambuf_iterator(file), {});
  }
  content.resize(content.find("$Elements"));
  const auto rows = mesh.simplices.size();
  std::ofstream file(path, std::ios::binary);
  file << content << "$Elements\n" << rows << ' ' << rows << " 1 " << rows << '\n';
  for (Offset i = 0; i < rows; ++i) {
    file << "3 1 4 1\n" << i + 1;
    for (const Index v : mesh.simplices[i]) file << ' ' << v + 1;
    file << '\n';
  }
  file << "$EndElements\n";
}

// The array in blocks of zlib, as VTK compresses them: numbers of blocks and bytes, then the blocks.
template <class Number>
std::string compressed(const std::vector<Number>& numbers) {
  constexpr std::size_t block = 1 << 15;
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  std::vector<std::uint64_t> header{(bytes.size() + block - 1) / block, block, bytes.size() % block};
  std::string blocks;
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const auto part = bytes.substr(at, block);
    std::array<Bytef, block + block / 100> packed{};
    uLongf size = packed.size();
    if (compress2(packed.data(), &size, reinterpret_cast<const Bytef*>(part.data()), part.size(), 5) != Z_OK)
      throw std::runtime_error("zlib could not compress");
    blocks.append(reinterpret_cast<const char*>(packed.data()), size);
    header.push_back(size);
  }
  return std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]) + blocks;
}

void write_vtu_zlib(const std::string& path, const MeshData& mesh) {
  const auto ids = mesh.simplices.vertices();
  const std::vector<std::int64_t> connectivity(ids.begin(), ids.end());
  std::vector<std::int64_t> offsets;
  for (Offset i = 1; i <= mesh.simplices.size(); ++i) offsets.push_back(i * (mesh.simplices.dimension() + 1));
  const std::vector<std::uint8_t> types(offsets.size(), 10);
  const std::array arrays{compressed(mesh.points), compressed(connectivity), compressed(offsets), compressed(types)};
  std::size_t offset = 0;
  std::ofstream file(path, std::ios::binary);
  const auto array = [&](const char* attributes, std::size_t i) {
    file << "<DataArray " << attributes << " format=\"appended\" offset=\"" << offset << "\"/>\n";
    offset += arrays[i].size();
  };
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << mesh.vertex_count << "\" NumberOfCells=\"" << mesh.simplices.size() << "\">\n<Points>\n";
  array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", 0);
  file << "</Points>\n<Cells>\n";
  array("type=\"Int64\" Name=\"connectivity\"", 1);
  array("type=\"Int64\" Name=\"offsets\"", 2);
  array("type=\"UInt8\" Name=\"types\"", 3);
  file << "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  for (const auto& bytes : arrays) file << bytes;
  file << "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

const std::vector<BenchFile>& bench_files() {
  using F = MeshFormat;
  using E = Encoding;
  static const std::vector<BenchFile> files{
      {"gmsh 2.2 text", ".msh", F::gmsh, false, write<F::gmsh, E::ascii>},
      {"gmsh 2.2 binary", ".msh", F::gmsh, false, write<F::gmsh, E::binary>},
      {"gmsh 4.1 text", ".msh", F::gmsh, false, write<F::gmsh, E::ascii, true>},
      {"gmsh 4.1 text, a block per element", ".msh", F::gmsh, false, write_gmsh_blocks},
      {"gmsh 4.1 binary", ".msh", F::gmsh, false, write<F::gmsh, E::binary, true>},
      {"medit", ".mesh", F::medit, false, write<F::medit>},
      {"tetgen", ".node", F::tetgen, false, write<F::tetgen>},
      {"vtk text", ".vtk", F::vtk, false, write<F::vtk, E::ascii>},
      {"vtk binary", ".vtk", F::vtk, false, write<F::vtk, E::binary>},
      {"vtu text", ".vtu", F::vtu, false, write<F::vtu, E::ascii>},
      {"vtu raw", ".vtu", F::vtu, false, write<F::vtu, E::binary>},
      {"vtu zlib", ".vtu", F::vtu, false, write_vtu_zlib},
      {"npz", ".npz", F::npz, false, write<F::npz>},
      {"off", ".off", F::off, true, write<F::off>},
      {"obj", ".obj", F::obj, true, write<F::obj>},
      {"ply text", ".ply", F::ply, true, write<F::ply, E::ascii>},
      {"ply binary", ".ply", F::ply, true, write<F::ply, E::binary>},
      {"stl text", ".stl", F::stl, true, write<F::stl, E::ascii>},
      {"stl binary", ".stl", F::stl, true, write<F::stl, E::binary>},
  };
  return files;
}

BenchMeshes::BenchMeshes(std::int64_t simplices) : solid(box_of(simplices)), surface(torus_of(simplices)) {}

BenchDirectory::BenchDirectory() {
  auto name = (std::filesystem::temp_directory_path() / "derham_bench_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a directory like " + name);
  path_ = name;
}

BenchDirectory::~BenchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void BenchDirectory::clear() {
  for (const auto& entry : std::filesystem::directory_iterator(path_)) std::filesystem::remove(entry);
}

std::vector<std::string> BenchDirectory::paths(const BenchFile& file, const BenchMeshes& meshes) {
  const auto path = (path_ / ("mesh" + file.extension)).string();
  if (present_ != file.name) {
    clear();
    file.write(path, file.is_surface ? meshes.surface : meshes.solid);
    present_ = file.name;
  }
  if (file.format != MeshFormat::tetgen) return {path};
  return {path, (path_ / "mesh.ele").string()};
}

}  // namespace derham::bench
