#include "commands.hpp"
#include "survey.hpp"

#include <memory>

namespace derham::cli {

Run add_info(CLI::App& parent, Common& common) {
  CLI::App& command = *parent.add_subcommand("info", "counts, topology, orientation, volumes and verdicts of a mesh");
  const auto input = std::make_shared<Input>();
  add_input_options(command, *input);
  return [&common, input] {
    Console console(common);
    const LoadedMesh loaded = load_mesh(*input, console);
    const Survey result = survey(loaded, console);
    if (common.json)
      print(to_json(result));
    else
      print(input->path + "\n" + to_text(result));
    return Exit::ok;
  };
}

}  // namespace derham::cli
