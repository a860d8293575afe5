#include "derham/core/text.hpp"
#include "derham/io/gmsh_reading.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace derham {
void read_gmsh_entities(GmshReading& reading, bool partitioned) {
  auto& input = reading.input;
  const auto int_and_sizes = [&](int sizes) { return std::int64_t{4} + std::int64_t{sizes} * input.size_width(); };
  input.free_layout(true);
  if (partitioned) {
    const auto partitions = input.size("the number of partitions");
    const Index ghosts = input.count("the number of ghost entities", 4, 8);
    for (Index i = 0; i < ghosts; ++i) {
      (void)input.integer("the number of a ghost entity");
      (void)input.integer("a partition");
    }
    reading.mesh.notes.push_back(text("the file is split into ", partitions, " partitions: read as one mesh"));
  }
  std::array<Index, 4> counts{};
  for (auto& count : counts) count = input.count("the number of entities", 10, int_and_sizes(1) + 24);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (Index i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const auto number = input.integer("the number of an entity");
      if (partitioned) {
        (void)input.integer("the dimension of a parent");
        (void)input.integer("the number of a parent");
        const Index partitions = input.count("the number of partitions", 2, 4);
        for (Index p = 0; p < partitions; ++p) (void)input.integer("a partition");
      }
      input.skip_reals(dimension == 0 ? 3 : 6, "a coordinate");
      const Index groups = input.count("the number of physical groups", 2, 4);
      for (Index g = 0; g < groups; ++g)
        reading.groups[{dimension, number}].push_back(input.integer("a physical group"));
      if (dimension == 0) continue;
      const Index bounding = input.count("the number of bounding entities", 2, 4);
      for (Index e = 0; e < bounding; ++e) (void)input.integer("a bounding entity");
    }
  input.free_layout(false);
}

}  // namespace derham
