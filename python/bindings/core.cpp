#include "rooms.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/types.hpp"
#include "derham/core/version.hpp"

#include <exception>

namespace derham::python {
namespace {

namespace nb = nanobind;

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

}  // namespace

void bind_core(nb::module_& module) {
  nb::register_exception_translator(translate);
  module.attr("version") = version;
  module.attr("index_bits") = 8 * sizeof(Index);
  module.def("thread_count", &thread_count);
  module.def("set_thread_count", &set_thread_count, nb::arg("count"));
}

}  // namespace derham::python
