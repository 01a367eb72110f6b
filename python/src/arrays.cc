// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "input/read_picture.h"

namespace ridgeline::python {
namespace {

std::string Text(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i > 0 ? ", " : "") + (shape[i] < 0 ? std::string("n") : std::to_string(shape[i]));
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::vector<py::ssize_t> ShapeOf(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

bool Fits(const py::array& array, const std::vector<py::ssize_t>& shape) {
  if (array.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] >= 0 && array.shape(static_cast<py::ssize_t>(i)) != shape[i]) return false;
  }
  return true;
}

void RequireContiguous(const py::array& array, const std::string& name) {
  if ((array.flags() & py::array::c_style) != 0) return;
  throw InputError("",
                   name,
                   "an array that is not contiguous",
                   "a C-contiguous one: numpy.ascontiguousarray() makes it");
}

// "[3, 1]" of a flat index.
std::string PlaceIn(const py::array& array, py::ssize_t index) {
  std::string text;
  for (py::ssize_t d = array.ndim() - 1; d >= 0; --d) {
    text = std::to_string(index % array.shape(d)) + (text.empty() ? "" : ", ") + text;
    index /= array.shape(d);
  }
  return "[" + text + "]";
}

template <typename T>
void RequireFinite(const py::array& array, const std::string& name) {
  const T* values = static_cast<const T*>(array.data());
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw InputError("",
                     array.ndim() == 0 ? name : name + PlaceIn(array, i),
                     std::isnan(values[i]) ? "nan" : "an infinite number",
                     "a finite number");
  }
}

bool IsNumbers(py::handle value) {
  return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) ||
         py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value);
}

// Numbers that Python code wrote down become an array; arrays stay as they are.
py::array AsArray(py::handle value, const std::string& name, const std::string& expected) {
  if (py::isinstance<py::array>(value)) return py::reinterpret_borrow<py::array>(value);
  if (IsNumbers(value)) {
    py::array numbers = py::array::ensure(value);
    const char kind = numbers ? numbers.dtype().kind() : 'O';
    if (kind == 'f' || kind == 'i') return py::array_t<double>::ensure(numbers);
  }
  PyErr_Clear();
  throw InputError("", name, Described(value), expected);
}

template <typename T>
std::vector<LineSegment> RowsOf(const py::array& array, const std::string& name) {
  RequireFinite<T>(array, name);
  const T* row = static_cast<const T*>(array.data());
  const py::ssize_t columns = array.shape(1);
  std::vector<LineSegment> segments;
  for (py::ssize_t i = 0; i < array.shape(0); ++i, row += columns) {
    LineSegment segment{{static_cast<float>(row[0]), static_cast<float>(row[1])},
                        {static_cast<float>(row[2]), static_cast<float>(row[3])},
                        columns == 5 ? static_cast<float>(row[4]) : 1.0f};
    if (!(segment.Length() > 0.0f && segment.strength > 0.0f)) {
      throw InputError("",
                       name + "[" + std::to_string(i) + "]",
                       segment.Length() > 0.0f ? "a strength of 0 or less" : "a segment of length 0",
                       "x0, y0, x1, y1 of two places, and a strength > 0");
    }
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace

std::string Described(py::handle value) {
  if (!py::isinstance<py::array>(value)) return py::str(py::type::handle_of(value).attr("__name__"));
  const auto array = py::reinterpret_borrow<py::array>(value);
  return Text(ShapeOf(array)) + " " + std::string(py::str(array.dtype()));
}

py::array_t<double> DoublesOf(py::handle value,
                              const std::string& name,
                              std::initializer_list<py::ssize_t> shape) {
  const std::vector<py::ssize_t> wanted(shape);
  const std::string expected = Text(wanted) + " float64";
  const py::array array = AsArray(value, name, expected);
  if (!py::isinstance<py::array_t<double>>(array) || !Fits(array, wanted)) {
    throw InputError("", name, Described(array), expected);
  }
  RequireContiguous(array, name);
  RequireFinite<double>(array, name);
  return py::reinterpret_borrow<py::array_t<double>>(array);
}

cv::Mat PictureOf(py::handle value, const std::string& name) {
  if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__")) {
    return ReadPicture(std::string(py::str(py::module_::import("os").attr("fspath")(value))));
  }
  constexpr const char* kExpected =
      "a path, or (height, width), (height, width, 3) or (height, width, 4) uint8 or uint16";
  if (!py::isinstance<py::array>(value)) throw InputError("", name, Described(value), kExpected);
  const auto array = py::reinterpret_borrow<py::array>(value);
  const bool is_8_bit = py::isinstance<py::array_t<std::uint8_t>>(array);
  const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  const bool fits = (array.ndim() == 2 || array.ndim() == 3) &&
                    (array.ndim() == 2 || channels == 3 || channels == 4) &&
                    (is_8_bit || py::isinstance<py::array_t<std::uint16_t>>(array)) &&
                    array.size() > 0;
  if (!fits) throw InputError("", name, Described(value), kExpected);
  RequireContiguous(array, name);
  return cv::Mat(static_cast<int>(array.shape(0)),
                 static_cast<int>(array.shape(1)),
                 CV_MAKETYPE(is_8_bit ? CV_8U : CV_16U, static_cast<int>(channels)),
                 const_cast<void*>(array.data()));
}

std::vector<LineSegment> SegmentsOf(py::handle value, const std::string& name) {
  constexpr const char* kExpected = "(n, 4) or (n, 5) float32 or float64: x0, y0, x1, y1[, strength]";
  const py::array array = AsArray(value, name, kExpected);
  const bool is_float = py::isinstance<py::array_t<float>>(array);
  if (!(is_float || py::isinstance<py::array_t<double>>(array)) || array.ndim() != 2 ||
      (array.shape(1) != 4 && array.shape(1) != 5)) {
    throw InputError("", name, Described(array), kExpected);
  }
  RequireContiguous(array, name);
  return is_float ? RowsOf<float>(array, name) : RowsOf<double>(array, name);
}

py::array ArrayOf(const cv::Mat& mat) {
  const auto owned = std::make_shared<cv::Mat>(mat);
  std::vector<py::ssize_t> shape{mat.rows, mat.cols};
  std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(mat.step[0]),
                                   static_cast<py::ssize_t>(mat.elemSize())};
  if (mat.channels() > 1) {
    shape.push_back(mat.channels());
    strides.push_back(static_cast<py::ssize_t>(mat.elemSize1()));
  }
  const char* type = mat.depth() == CV_8U ? "u1" : mat.depth() == CV_16U ? "u2" : "f4";
  return py::array(py::dtype(type), shape, strides, mat.data, CapsuleOf(owned));
}

py::array ArrayOf(std::vector<LineSegment> segments) {
  static_assert(sizeof(LineSegment) == 5 * sizeof(float));
  const auto owned = std::make_shared<std::vector<LineSegment>>(std::move(segments));
  return py::array_t<float>({static_cast<py::ssize_t>(owned->size()), py::ssize_t{5}},
                            reinterpret_cast<const float*>(owned->data()),
                            CapsuleOf(owned));
}

}  // namespace ridgeline::python
