#pragma once

#include "cli.hpp"
#include "load.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace derham::cli {

/// Adds the positional MESH, --format and what `add_reading_options` adds.
void add_input_options(CLI::App& command, Input& input);
/// Adds --triangulate, --corner-nodes, --planar, --drop-unused and --reorder.
void add_reading_options(CLI::App& command, Input& input);

/// The extensions of files to read and to write, for help texts.
inline constexpr const char* mesh_extensions =
    ".node/.ele, .msh, .mesh, .vtk, .vtu, .obj, .off, .ply, .stl, .facets, .npz";

/// One subcommand each: adds its options and returns what runs it.
using Run = std::function<Exit()>;
Run add_info(CLI::App& parent, Common& common);
Run add_check(CLI::App& parent, Common& common);
Run add_operators(CLI::App& parent, Common& common);
Run add_convert(CLI::App& parent, Common& common);
Run add_generate(CLI::App& parent, Common& common);
Run add_demo(CLI::App& parent, Common& common);
Run add_draw(CLI::App& parent, Common& common);

}  // namespace derham::cli
