// The command line: one subcommand per file; this one parses, runs and turns failures into messages and exit codes.
#include "commands.hpp"

#include "derham/core/error.hpp"
#include "derham/core/version.hpp"
#include "derham/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <map>
#include <new>
#include <stdexcept>

namespace derham::cli {

void add_input_options(CLI::App& command, Input& input) {
  command.add_option("MESH", input.path, std::string("mesh file (") + mesh_extensions + "), - for stdin")->required();
  command.add_option("--format", input.format, readable_formats() + ", instead of detecting it");
  add_reading_options(command, input);
}

void add_reading_options(CLI::App& command, Input& input) {
  command.add_flag("--triangulate", input.options.triangulate, "split polygons into triangles, else they are refused");
  command.add_flag("--corner-nodes", input.options.corner_nodes,
                   "keep the corners of elements of higher order, else they are refused");
  command.add_flag("--planar", input.options.planar, "read a mesh whose third coordinates are 0 as one in the plane");
  command.add_flag("--drop-unused", input.drop_unused, "leave out vertices that are in no simplex");
  command.add_flag("--reorder", input.reorder, "renumber vertices and simplices so that neighbours are near: faster");
}

namespace {

extern "C" void end_cleanly(int signal) {
  remove_pending_temporaries();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

Exit report(const Failure& failure, const Common& common) {
  if (common.json) {
    Json error{{"kind", failure.kind}, {"message", failure.what()}, {"file", nullptr}, {"line", nullptr}};
    if (!failure.file.empty()) error["file"] = failure.file;
    if (failure.line > 0) error["line"] = failure.line;
    try {
      print(Json{{"error", error}});
    } catch (const Failure&) {
      // stdout is gone: the exit code and stderr remain
    }
  }
  if (!common.json || !common.quiet) std::fprintf(stderr, "derham: %s\n", failure.what());
  return failure.code;
}

/// Runs the command; every exception becomes a message and an exit code here and nowhere else.
Exit run(const Run& command, const Common& common) {
  try {
    return command();
  } catch (const Failure& failure) {
    return report(failure, common);
  } catch (const FileError& error) {
    const bool writing = error.action() == FileError::Action::write;
    return report(
        Failure(writing ? Exit::unwritable : Exit::unreadable, error.kind(), error.what(), error.path(), error.line()),
        common);
  } catch (const LimitError& error) {
    return report(Failure(Exit::limit, error.kind(), error.what()), common);
  } catch (const InputError& error) {  // wrong arguments are told apart where they are used: this is the mesh
    return report(Failure(Exit::unreadable, error.kind(), error.what()), common);
  } catch (const Error& error) {
    return report(Failure(Exit::numerical, error.kind(), error.what()), common);
  } catch (const std::bad_alloc&) {
    return report(Failure(Exit::limit, "memory", "out of memory"), common);
  } catch (const std::length_error&) {
    return report(Failure(Exit::limit, "memory", "a list would be longer than memory can hold"), common);
  } catch (const std::exception& error) {
    return report(Failure(Exit::numerical, "error", error.what()), common);
  }
}

int main_of(int argc, char** argv) {
  CLI::App app("derham: discrete exterior calculus on simplicial meshes", "derham");
  app.set_version_flag("--version", std::string("derham ") + version);
  app.require_subcommand(1);
  app.fallthrough();  // --json and --quiet may stand before or after the command
  app.failure_message(CLI::FailureMessage::simple);
  Common common;
  app.add_flag("--json", common.json, "one JSON object on stdout, for errors too");
  app.add_flag("-q,--quiet", common.quiet, "no messages on stderr but errors");
  std::map<std::string, Run> commands;
  commands["info"] = add_info(app, common);
  commands["check"] = add_check(app, common);
  commands["convert"] = add_convert(app, common);
  commands["operators"] = add_operators(app, common);
  commands["generate"] = add_generate(app, common);
  commands["demo"] = add_demo(app, common);
  commands["draw"] = add_draw(app, common);

  std::string word;  // the command: the first argument that is no option
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    common.json = common.json || argument == "--json";
    common.quiet = common.quiet || argument == "--quiet" || argument == "-q";
    if (word.empty() && !argument.starts_with('-')) word = argument;
  }
  if (!word.empty() && !commands.contains(word)) {
    std::vector<std::string> names;
    for (const auto& [name, command] : commands) names.push_back(name);
    return static_cast<int>(report(Failure(Exit::usage, "usage",
                                           "there is no command '" + word + "'" + suggestion(word, names) +
                                               "; commands are check, convert, demo, draw, generate, info, operators"),
                                   common));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    std::string message = error.what();
    return static_cast<int>(report(Failure(Exit::usage, "usage", message + "; try 'derham --help'"), common));
  }
  return static_cast<int>(run(commands.at(app.get_subcommands().front()->get_name()), common));
}

}  // namespace
}  // namespace derham::cli

int main(int argc, char** argv) {
  // A closed standard stream must not lend its number to a file: reading and writing it then fails as it should.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, derham::cli::end_cleanly);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);  // write errors like any other
  return derham::cli::main_of(argc, argv);
}
