#pragma once

#include <string>
#include <utility>
#include <vector>

namespace derham {

/// A ParaView collection (.pvd): the files of a time series with their times.
///
///   PvdFile series;
///   for (…) series.add(time, "heat_7.vtu");
///   series.write("heat.pvd");
class PvdFile {
 public:
  /// `file` is given relative to the place of the .pvd file. Throws InputError if the time is not finite or the name is
  /// empty.
  PvdFile& add(double time, std::string file);

  /// Writes the file, complete or not at all; "-" is standard output. Throws FileError if it cannot be written.
  void write(const std::string& path) const;

 private:
  std::vector<std::pair<double, std::string>> entries_;
};

}  // namespace derham
