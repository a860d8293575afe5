#include "rooms.hpp"

#include "derham/core/cancel.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/types.hpp"
#include "derham/core/version.hpp"

#include <exception>

namespace derham::python {
namespace {

namespace nb = nanobind;

unsigned long main_thread = 0;

/// The class of derham.errors that stands for an error of the library.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const nb::object type = nb::module_::import_("derham.errors").attr(name);
  const nb::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise("InputError", error.what(), error.row());
  } catch (const TopologyError& error) {
    raise("TopologyError", error.what());
  } catch (const GeometryError& error) {
    raise("GeometryError", error.what());
  } catch (const LimitError& error) {
    raise("LimitError", error.what());
  } catch (const FileError& error) {
    raise("FileError", error.what(), error.path().c_str(), error.line(), error.kind());
  } catch (const Error& error) {
    raise("Error", error.what());
  }
}

/// Runs the handlers of signals that came, as that of Ctrl-C, which raises KeyboardInterrupt. Python does so in its main thread only.
void check_signals() {
  if (PyThread_get_thread_ident() != main_thread) return;
  const nb::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

}  // namespace

void bind_core(nb::module_& module) {
  nb::register_exception_translator(translate);
  // In a process made by fork, the thread that called it is the main one.
  const auto note_main_thread = [] { main_thread = PyThread_get_thread_ident(); };
  main_thread = nb::cast<unsigned long>(nb::module_::import_("threading").attr("main_thread")().attr("ident"));
  nb::module_::import_("os").attr("register_at_fork")(nb::arg("after_in_child") = nb::cpp_function(note_main_thread));
  set_cancel_check(check_signals);
  module.attr("version") = version;
  module.attr("index_bits") = 8 * sizeof(Index);
  module.def("thread_count", &thread_count);
  module.def("set_thread_count", &set_thread_count, nb::arg("count"));
}

}  // namespace derham::python
