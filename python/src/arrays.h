// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <initializer_list>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lines/line_segment.h"

namespace ridgeline::python {

namespace py = pybind11;

// The numbers of a float64 array of a shape (-1: any length). A list or tuple of numbers is taken
// for an array. Throws InputError naming `name` for another type, shape or layout and for numbers
// that are not finite: nothing is converted or copied behind the caller's back, since float32 has
// steps of half a metre at a northing of 5 300 000.
py::array_t<double> DoublesOf(py::handle value,
                              const std::string& name,
                              std::initializer_list<py::ssize_t> shape);

// A picture: a path, read as the program reads it; or a C-contiguous uint8 or uint16 array of shape
// (height, width), (height, width, 3) in the order blue, green, red, or (height, width, 4) with
// alpha, whose pixels are shared and must outlive the result. Throws InputError.
cv::Mat PictureOf(py::handle value, const std::string& name = "image");

// Segments: (n, 4) or (n, 5) float32 or float64, rows x0, y0, x1, y1[, strength] in pixels. Throws
// InputError.
std::vector<LineSegment> SegmentsOf(py::handle value, const std::string& name = "lines");

// "(3, 4) float64", "list".
std::string Described(py::handle value);

// An array over memory that `owner` keeps alive; not writeable.
template <typename T>
py::array View(const T* data,
               std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides,
               py::handle owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// Python's owner of a C++ value.
template <typename Value>
py::capsule CapsuleOf(std::shared_ptr<Value> value) {
  return py::capsule(new std::shared_ptr<Value>(std::move(value)),
                     [](void* p) { delete static_cast<std::shared_ptr<Value>*>(p); });
}

// A new array of the values, without a copy.
template <typename T>
py::array_t<T> ArrayOf(std::vector<T> values, std::vector<py::ssize_t> shape) {
  const auto owned = std::make_shared<std::vector<T>>(std::move(values));
  return py::array_t<T>(std::move(shape), owned->data(), CapsuleOf(owned));
}

// The pixels without a copy: (rows, columns) or (rows, columns, channels), 8, 16 or 32 bit.
py::array ArrayOf(const cv::Mat& mat);

// (n, 5) float32: x0, y0, x1, y1, strength.
py::array ArrayOf(std::vector<LineSegment> segments);

}  // namespace ridgeline::python
