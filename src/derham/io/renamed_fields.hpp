#pragma once

#include "derham/core/text.hpp"
#include "derham/geometry/mesh_data.hpp"
#include "derham/io/cursor.hpp"

#include <string>
#include <vector>

namespace derham {

/// That a name is not held, as a phrase that goes on "format NAME …".
[[nodiscard]] inline std::string lost_name(const std::string& name, const std::string& becomes) {
  return text("does not hold the name of the field ", quoted_token(name), ": it becomes ", quoted_token(becomes));
}

/// One such phrase for every field for whose name `written_name` has another.
template <class WrittenName>
std::vector<std::string> renamed_fields(const MeshData& mesh, WrittenName written_name) {
  std::vector<std::string> lost;
  for (const auto& field : mesh.fields)
    if (const std::string written = written_name(field.name); written != field.name)
      lost.push_back(lost_name(field.name, written));
  return lost;
}

}  // namespace derham
