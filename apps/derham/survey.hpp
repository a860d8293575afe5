#pragma once

#include "load.hpp"

#include "derham/boundary/manifold.hpp"

#include <optional>
#include <string>
#include <vector>

namespace derham::cli {

/// Everything that `info` says of a mesh. Undefined values are empty.
struct Survey {
  struct Star {
    double min;
    Offset zero, negative;
  };
  struct Part {
    std::string name;
    std::int64_t number;
    int dimension;
    Offset count;
  };
  struct Stage {
    std::string name;
    double seconds;
  };

  int dimension = -1;
  std::optional<int> ambient_dimension;
  std::vector<Index> simplices, boundary_simplices;  // by degree
  Offset euler_characteristic = 0;
  Index components = 0;
  bool pure = true, orientable = true, closed = true;
  Verdict manifold = Verdict::yes;
  std::optional<double> volume;
  std::optional<Offset> inverted, degenerate;
  std::optional<bool> delaunay, one_sided, well_centered;
  std::optional<std::vector<Star>> star;  // by degree
  std::string star_missing;               // why there is none
  std::vector<double> identity_error;     // by degree: |Σ|σ||⋆σ| / (C(n,k)|M|) - 1|
  bool boundary_of_boundary_zero = true;
  std::vector<Part> parts;
  Offset lower_simplices = 0, not_faces = 0;  // listed below the dimension; those of them that K does not have
  std::vector<Stage> stages;
};

/// Builds the complex of `loaded` and asks it everything. `verify` also runs the demonstration's checks (∂∂ = 0 and the
/// identities of the dual volumes).
template <int n>
[[nodiscard]] Survey survey(const LoadedMesh& loaded, Console& console, bool verify);
[[nodiscard]] Survey survey(const LoadedMesh& loaded, Console& console, bool verify = false);

[[nodiscard]] Json to_json(const Survey& survey);
[[nodiscard]] std::string to_text(const Survey& survey);

}  // namespace derham::cli
