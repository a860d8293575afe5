#pragma once

#include "unlocked.hpp"

#include "derham/core/large_pages.hpp"
#include "derham/core/types.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

// numpy arrays of this library's memory, and this library's spans of numpy's.
namespace derham::python {

namespace nb = nanobind;

/// Arguments: the Python face has seen to their type and order, and an array that does not fit is a TypeError.
template <class T, class... Shape>
using Input = nb::ndarray<const T, Shape..., nb::c_contig, nb::device::cpu>;
using Indices = Input<Index, nb::ndim<1>>;
using Values = Input<double>;
using Output = nb::ndarray<double, nb::c_contig, nb::device::cpu>;

/// Results.
template <class T>
using Array = nb::ndarray<nb::numpy, T>;

template <class T, class... Options>
[[nodiscard]] std::span<T> span_of(const nb::ndarray<T, Options...>& array) {
  return {array.data(), array.size()};
}

/// How many columns a row-major array holds: its second length, or 1.
template <class T, class... Options>
[[nodiscard]] Index columns_of(const nb::ndarray<T, Options...>& array) {
  return array.ndim() < 2 ? Index{1} : static_cast<Index>(array.shape(1));
}

/// A copy of an argument that the library takes by value.
template <class T, class... Options>
[[nodiscard]] std::vector<std::remove_const_t<T>> copied(const nb::ndarray<T, Options...>& array) {
  std::vector<std::remove_const_t<T>> values;
  values.reserve(array.size());
  prefer_large_pages(values.data(), array.size() * sizeof(T));  // before they are touched
  values.assign(array.data(), array.data() + array.size());
  return values;
}

/// A numpy array that owns `values`, moved into it: anything with data() and size().
template <class Container>
[[nodiscard]] auto owned(Container values, std::initializer_list<std::size_t> shape) {
  using T = std::remove_reference_t<decltype(*values.data())>;
  auto* const kept = new Container(std::move(values));
  const nb::capsule owner(kept, [](void* memory) noexcept { delete static_cast<Container*>(memory); });
  return Array<T>(kept->data(), shape, owner);
}
template <class Container>
[[nodiscard]] auto owned(Container values) {
  const std::size_t size = values.size();
  return owned(std::move(values), {size});
}

/// Every list of several as an array.
template <class Lists>
[[nodiscard]] auto owned_each(Lists lists) {
  std::vector<decltype(owned(std::move(*lists.begin())))> arrays;
  for (auto& list : lists) arrays.push_back(owned(std::move(list)));
  return arrays;
}

/// The values of a form, in memory of their own.
template <class Form>
[[nodiscard]] std::vector<double> values_of(const Form& form) {
  return {form.values().begin(), form.values().end()};
}

/// A numpy view of memory that `keeper` keeps alive, read-only if T is const.
template <class T>
[[nodiscard]] Array<T> view(std::span<T> values, std::initializer_list<std::size_t> shape,
                            std::shared_ptr<const void> keeper) {
  auto* const kept = new std::shared_ptr<const void>(std::move(keeper));
  const nb::capsule owner(kept,
                          [](void* memory) noexcept { delete static_cast<std::shared_ptr<const void>*>(memory); });
  return Array<T>(values.data(), shape, owner);
}
template <class T>
[[nodiscard]] Array<T> view(std::span<T> values, std::shared_ptr<const void> keeper) {
  return view(values, {values.size()}, std::move(keeper));
}

}  // namespace derham::python
