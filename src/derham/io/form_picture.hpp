#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/forms/form.hpp"
#include "derham/io/vtu_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace derham {

/// A complex in space with forms on it, drawn as a .vtu file that ParaView and VTK open.
///
///   FormPicture<3>(K, 3, points).add("height", h).add("current", w).write("current.vtu");
///
/// A 0-form is point data. A k-form, k >= 1, is cell data of the cells that are k-simplices, NaN on all others; a dual form
/// is drawn on the simplices that count its cells. Cells are the simplices of all degrees, K_0 first; every cell has `degree`
/// (threshold by it to see one degree), `index` (its position in K_k) and `sign` (that of its representative).
/// K, the points and nothing else must live until `write`.
template <int n>
class FormPicture {
  static_assert(1 <= n && n <= 3, "VTK draws simplices of dimension 1 to 3");

 public:
  /// `points` has shape (|V|, m) row-major, m <= 3. Throws InputError from `write` if it has not.
  FormPicture(const SimplicialComplex<n>& K, int m, std::span<const double> points) : K_(&K), m_(m), points_(points) {}
  FormPicture(SimplicialComplex<n>&&, int, std::span<const double>) = delete;

  /// Adds a form under a name. Throws InputError if the form belongs to another complex.
  template <int k, Side side>
  FormPicture& add(std::string name, const Form<n, k, side>& form) {
    if (&form.complex() != K_) throw InputError("the form '" + name + "' belongs to another complex");
    constexpr int degree = Form<n, k, side>::simplex_degree;
    forms_.push_back({std::move(name), degree, {form.values().begin(), form.values().end()}});
    return *this;
  }

  /// Writes the file, complete or not at all. Throws InputError on wrong shapes, FileError if it cannot be written.
  void write(const std::string& path) const {
    SimplexList cells;
    std::vector<std::int32_t> degree;
    std::vector<std::int64_t> index;
    std::vector<std::int8_t> sign;
    std::array<std::size_t, n + 1> first{};
    for (int k = 0; k <= n; ++k) {
      first[static_cast<std::size_t>(k)] = degree.size();
      for (Index i = 0; i < K_->size(k); ++i) {
        cells.push_back(K_->simplex(k, i));
        degree.push_back(k);
        index.push_back(i);
        sign.push_back(K_->sign(k, i));
      }
    }
    VtuFile file(m_, points_, std::move(cells));
    file.cell_data("degree", std::span<const std::int32_t>(degree));
    file.cell_data("index", std::span<const std::int64_t>(index));
    file.cell_data("sign", std::span<const std::int8_t>(sign));
    std::vector<std::vector<double>> on_cells;  // VtuFile copies nothing
    on_cells.reserve(forms_.size());
    for (const Named& form : forms_) {
      if (form.degree == 0) {
        file.point_data(form.name, std::span<const double>(form.values));
        continue;
      }
      auto& values = on_cells.emplace_back(degree.size(), std::numeric_limits<double>::quiet_NaN());
      std::copy(form.values.begin(), form.values.end(),
                values.begin() + static_cast<std::ptrdiff_t>(first[static_cast<std::size_t>(form.degree)]));
      file.cell_data(form.name, std::span<const double>(values));
    }
    file.write(path);
  }

 private:
  struct Named {
    std::string name;
    int degree = 0;
    std::vector<double> values;
  };
  const SimplicialComplex<n>* K_;
  int m_;
  std::span<const double> points_;
  std::vector<Named> forms_;
};

}  // namespace derham
