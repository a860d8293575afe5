#include "rooms.hpp"
#include "unlocked.hpp"

#include "derham/io/pvd_file.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace derham::python {
namespace {

void write_series(const std::string& path, const std::vector<std::pair<double, std::string>>& files) {
  PvdFile series;
  for (const auto& [time, file] : files) series.add(time, file);
  series.write(path);
}

}  // namespace

void bind_io_series(nb::module_& module) {
  module.def("write_series", &write_series, nb::arg("path"), nb::arg("files"), nb::call_guard<Unlocked>());
}

}  // namespace derham::python
