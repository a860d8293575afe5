#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/options.hpp"
#include "derham/io/read_hints.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace derham {

/// Takes the faces of a surface file: simplices as they are, polygons of more than 3 vertices as the options say.
class Polygons {
 public:
  Polygons(Cursor& file, const ReadOptions& options) : file_(file), splits_(options.triangulate) {}

  /// Adds a face of at least one vertex. The cursor stands on the face, for the message that refuses it.
  void add(std::span<const Index> face, ListedSimplices& rows) {
    if (face.size() <= 3) {
      rows.add(face);
      return;
    }
    if (!splits_) refuse(face.size());
    if (static_cast<std::size_t>(std::numeric_limits<Index>::max() - 1 - rows.size(2)) < face.size())
      throw LimitError(
          text(file_.name(), ": more triangles than this build's index type can number; build with DERHAM_INDEX64"));
    for (std::size_t i = 2; i < face.size(); ++i) rows.add(std::array{face[0], face[i - 1], face[i]});
    ++split_;
    triangles_ += face.size() - 2;
  }

  [[noreturn]] void refuse(std::size_t width) const {
    file_.fail(text("a face with ", width,
                    " vertices; expected triangles: split the polygons of this file first, or have them ",
                    split_on_reading));
  }

  /// Says in the notes what was split.
  void note_on(MeshData& mesh) const {
    if (split_ > 0)
      mesh.notes.push_back(text("split ", split_, split_ == 1 ? " polygon" : " polygons", " into ", triangles_,
                                " triangles, fans about first vertices"));
  }

 private:
  Cursor& file_;
  bool splits_;
  std::size_t split_ = 0, triangles_ = 0;
};

}  // namespace derham
