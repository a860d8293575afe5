#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/complex/simplicial_map.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/pullback.hpp"

#include <nanobind/stl/pair.h>

#include <memory>
#include <utility>
#include <vector>

// Simplicial maps, and what they do to forms.
namespace derham::python {
namespace {

/// Where every k-simplex goes, and the sign that it takes: -1 and 0 if it is collapsed.
using Images = std::pair<std::vector<Index>, std::vector<Sign>>;

/// A simplicial map of dimensions known at run time.
class MapBase {
 public:
  virtual ~MapBase() = default;
  [[nodiscard]] virtual Images images(int k) const = 0;
  virtual void pullback(int k, std::span<const double> x, std::span<double> y) const = 0;
};

template <int n, int m>
class MapOf : public MapBase {
 public:
  MapOf(Body<n> source, Body<m> target, std::vector<Index> vertices)
      : source_(std::move(source)), target_(std::move(target)),
        map_(*source_.complex, *target_.complex, std::move(vertices)) {}

  [[nodiscard]] Images images(int k) const override {
    const Index size = source_.complex->size(k);
    Images result(std::vector<Index>(static_cast<std::size_t>(size)),
                  std::vector<Sign>(static_cast<std::size_t>(size)));
    parallel_blocks(size, 4096, [&](Offset begin, Offset end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const SignedIndex image = map_.image(k, static_cast<Index>(i));
        result.first[i] = image.index;
        result.second[i] = image.sign;
      }
    });
    return result;
  }

  void pullback(int k, std::span<const double> x, std::span<double> y) const override { apply_pullback(map_, k, x, y); }

 private:
  Body<n> source_;
  Body<m> target_;
  SimplicialMap<n, m> map_;
};

class AnyMap {
 public:
  AnyMap(const AnyComplex& source, const AnyComplex& target, const Indices& vertices)
      : map_(source.visit<1>([&]<int n>(const Body<n>& from) {
          return target.visit([&]<int m>(const Body<m>& to) -> std::shared_ptr<const MapBase> {
            return std::make_shared<const MapOf<n, m>>(from, to, copied(vertices));
          });
        })) {}

  [[nodiscard]] auto images(int k) const {
    Images found = without_gil([&] { return map_->images(k); });
    return std::pair(owned(std::move(found.first)), owned(std::move(found.second)));
  }

  void pullback(int k, const Values& x, const Output& y) const {
    without_gil([&] { map_->pullback(k, span_of(x), span_of(y)); });
  }

 private:
  std::shared_ptr<const MapBase> map_;
};

}  // namespace

void bind_form_maps(nb::module_& module) {
  using nb::arg;
  nb::class_<AnyMap>(module, "SimplicialMap")
      .def(nb::init<const AnyComplex&, const AnyComplex&, const Indices&>(), arg("source"), arg("target"),
           arg("vertices").noconvert(), nb::call_guard<Unlocked>())
      .def("images", &AnyMap::images, arg("k"))
      .def("pullback", &AnyMap::pullback, arg("k"), arg("x").noconvert(), arg("y").noconvert());
}

}  // namespace derham::python
