#pragma once

#include "cli.hpp"
#include "load.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace derham::cli {

/// Adds the positional MESH, --format and --drop-unused.
void add_input_options(CLI::App& command, Input& input);

/// One subcommand each: adds its options and returns what runs it.
using Run = std::function<Exit()>;
Run add_info(CLI::App& parent, Common& common);
Run add_check(CLI::App& parent, Common& common);
Run add_operators(CLI::App& parent, Common& common);
Run add_generate(CLI::App& parent, Common& common);
Run add_demo(CLI::App& parent, Common& common);

}  // namespace derham::cli
