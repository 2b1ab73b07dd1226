#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

namespace sigmax::python {

/// Numbers from Python: a contiguous array of doubles, converted only if it is anything else.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Throws ValueError, which names the argument and both shapes, unless the array has this one. −1 is any length.
template <class... Lengths>
void expect_shape(const Array& array, const char* name, Lengths... lengths) {
  const std::array<pybind11::ssize_t, sizeof...(lengths)> expected{static_cast<pybind11::ssize_t>(lengths)...};
  const std::span found(array.shape(), static_cast<std::size_t>(array.ndim()));
  if (std::ranges::equal(expected, found, [](auto length, auto is) { return length == -1 || length == is; })) return;
  const pybind11::str shown("{}: expected shape {}, found {}");
  const pybind11::object text = shown.format(name, pybind11::make_tuple(lengths...), array.attr("shape"));
  throw std::invalid_argument(text.attr("replace")("-1", "any").cast<std::string>());
}

/// The numbers of a one-dimensional array; ValueError otherwise.
inline std::span<const double> row_of(const Array& array) {
  expect_shape(array, "numbers", -1);
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The rows of a two-dimensional array; ValueError otherwise.
inline std::vector<std::vector<double>> rows_of(const Array& array) {
  expect_shape(array, "rows", -1, -1);
  std::vector<std::vector<double>> rows;
  for (pybind11::ssize_t i = 0, n = array.shape(1); i < array.shape(0); ++i)
    rows.emplace_back(array.data() + i * n, array.data() + (i + 1) * n);
  return rows;
}

inline constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

/// Anything that NumPy can make such an array of. Throws TypeError, or what NumPy throws, otherwise.
inline Array as_array(const pybind11::object& object) {
  return pybind11::module_::import("numpy").attr("ascontiguousarray")(object, "float64").cast<Array>();
}

/// Numbers of an array, with NaN where a masked array hides them.
inline Array unmasked(const pybind11::object& numbers) {
  if (!pybind11::hasattr(numbers, "mask")) return Array(numbers);
  return numbers.attr("astype")("float64").attr("filled")(unknown_number);
}

/// The same in a tenth of the time of Array's caster where the object is such an array: for what is called in each
/// step.
inline Array quick_array(const pybind11::object& object) {
  using Api = pybind11::detail::npy_api;
  constexpr int sound = Api::NPY_ARRAY_C_CONTIGUOUS_ | Api::NPY_ARRAY_ALIGNED_;
  if (Py_TYPE(object.ptr()) != Api::get().PyArray_Type_) return unmasked(object);
  const auto* const array = pybind11::detail::array_proxy(object.ptr());
  const auto* const type = pybind11::detail::array_descriptor_proxy(array->descr);
  const bool ready = (array->flags & sound) == sound && type->type_num == Api::NPY_DOUBLE_ && type->byteorder == '=';
  return ready ? pybind11::reinterpret_borrow<Array>(object) : Array(object);
}

/// A read-only array over numbers that `owner` keeps, and which keeps `owner`: nothing is copied.
template <class... Lengths>
pybind11::array view(const double* data, pybind11::handle owner, Lengths... lengths) {
  Array array({static_cast<pybind11::ssize_t>(lengths)...}, data, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return std::move(array);
}

/// A new array with a copy of numbers.
template <class Number, class... Lengths>
pybind11::array copied(const Number* data, Lengths... lengths) {
  return pybind11::array(pybind11::dtype::of<Number>(), {static_cast<pybind11::ssize_t>(lengths)...}, data);
}
template <class Number>
pybind11::array array_of(const std::vector<Number>& values) {
  return copied(values.data(), values.size());
}

/// A new array of NaN.
template <class... Lengths>
Array unknown(Lengths... lengths) {
  Array array({static_cast<pybind11::ssize_t>(lengths)...});
  std::fill_n(array.mutable_data(), array.size(), unknown_number);
  return array;
}

/// A types.SimpleNamespace of these fields.
template <class... Field>
pybind11::object record(Field&&... fields) {
  return pybind11::module_::import("types").attr("SimpleNamespace")(std::forward<Field>(fields)...);
}

}  // namespace sigmax::python
