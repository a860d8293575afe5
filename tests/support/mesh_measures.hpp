#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "support/face_sets.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

// Volumes and circumcentric dual volumes straight from their definitions, one row at a time, keyed by vertex sets.

namespace derham::test {

/// The positions of the vertices of row i, one a column: (m, n+1).
inline Eigen::MatrixXd row_positions(const MeshData& mesh, Offset i) {
  const auto row = mesh.simplices[i];
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  Eigen::MatrixXd positions(m, row.size());
  for (std::size_t v = 0; v < row.size(); ++v) {
    const double* p = mesh.has_corners() ? &mesh.corners[(static_cast<std::size_t>(i) * row.size() + v) * m]
                                         : &mesh.points[static_cast<std::size_t>(row[v]) * m];
    positions.col(static_cast<Eigen::Index>(v)) = Eigen::Map<const Eigen::VectorXd>(p, mesh.ambient_dimension);
  }
  return positions;
}

/// The volume of the simplex with these vertices; signed when it fills its space.
inline double volume(const Eigen::MatrixXd& positions) {
  const Eigen::Index n = positions.cols() - 1;
  const Eigen::MatrixXd edges = positions.rightCols(n).colwise() - positions.col(0);
  const double content =
      n == positions.rows() ? edges.determinant() : std::sqrt((edges.transpose() * edges).determinant());
  return content / static_cast<double>(factorial(static_cast<int>(n)));
}

inline std::vector<double> row_volumes(const MeshData& mesh) {
  std::vector<double> volumes;
  for (Offset i = 0; i < mesh.simplices.size(); ++i) volumes.push_back(volume(row_positions(mesh, i)));
  return volumes;
}

inline double total_volume(const MeshData& mesh) {
  double sum = 0;
  for (const double v : row_volumes(mesh)) sum += v;
  return sum;
}

inline double smallest_volume(const MeshData& mesh) { return std::ranges::min(row_volumes(mesh)); }

/// Primal and signed circumcentric dual volume of every simplex.
struct Measure {
  double primal = 0, dual = 0;
  double smallest_part = 0;  ///< the smallest contribution of a row to `dual`
};
inline std::map<Face, Measure> measures(const MeshData& mesh) {
  std::map<Face, Measure> result;
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const Eigen::MatrixXd all = row_positions(mesh, i);
    const auto size = static_cast<unsigned>(all.cols());
    const unsigned whole = (1u << size) - 1;
    std::vector<Eigen::VectorXd> centre(whole + 1), weights(whole + 1);
    std::vector<double> dual(whole + 1);
    std::vector<Eigen::MatrixXd> positions(whole + 1);
    for (unsigned set = whole; set > 0; --set) {
      Eigen::MatrixXd p(all.rows(), std::popcount(set));
      for (unsigned v = 0, c = 0; v < size; ++v)
        if (set >> v & 1) p.col(c++) = all.col(v);
      const Eigen::MatrixXd edges = p.rightCols(p.cols() - 1).colwise() - p.col(0);
      const Eigen::MatrixXd gram = edges.transpose() * edges;
      const Eigen::VectorXd half = gram.diagonal() / 2;
      const Eigen::VectorXd b = edges.cols() > 0 ? Eigen::VectorXd(gram.ldlt().solve(half)) : Eigen::VectorXd();
      centre[set] = p.col(0);
      if (edges.cols() > 0) centre[set] += edges * b;
      weights[set] = Eigen::VectorXd(p.cols());
      weights[set] << 1 - b.sum(), b;
      positions[set] = p;

      if (set == whole) dual[set] = 1;
      for (unsigned v = 0; v < size; ++v) {
        if (set >> v & 1) continue;
        const unsigned above = set | 1u << v;
        const int place = std::popcount(above & ((1u << v) - 1));
        const double height = std::copysign((centre[above] - centre[set]).norm(), weights[above][place]);
        dual[set] += height * dual[above] / static_cast<double>(size - static_cast<unsigned>(std::popcount(set)));
      }
    }
    for (unsigned set = 1; set <= whole; ++set) {
      Face face;
      for (unsigned v = 0; v < size; ++v)
        if (set >> v & 1) face.push_back(mesh.simplices[i][v]);
      sort_with_sign(face);
      Measure& measure = result.try_emplace(face, Measure{0, 0, dual[set]}).first->second;
      measure.primal = std::abs(volume(positions[set]));
      measure.dual += dual[set];
      measure.smallest_part = std::min(measure.smallest_part, dual[set]);
    }
  }
  return result;
}

}  // namespace derham::test
