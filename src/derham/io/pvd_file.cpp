#include "derham/io/pvd_file.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/text_writer.hpp"
#include "derham/io/xml_text.hpp"

#include <cmath>

namespace derham {

PvdFile& PvdFile::add(double time, std::string file) {
  if (!std::isfinite(time)) throw InputError(text("a time of ", time, " in a pvd file; expected a finite number"));
  if (file.empty()) throw InputError("a file in a pvd file needs a name");
  entries_.emplace_back(time, std::move(file));
  return *this;
}

void PvdFile::write(const std::string& path) const {
  AtomicFile file(path);
  TextWriter writer(file);
  writer.put("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n");
  for (const auto& [time, name] : entries_)
    writer.put("    <DataSet timestep=\"").put(time).put("\" part=\"0\" file=\"").put(xml_escaped(name)).put("\"/>\n");
  writer.put("  </Collection>\n</VTKFile>\n");
  writer.flush();
  file.commit();
}

}  // namespace derham
