// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "city/format/mesh_source.h"
#include "city/format/read_obj.h"

namespace ridgeline {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct ScalarName {
  std::string_view name;
  Scalar scalar;
};
constexpr std::array kScalarNames = {
    ScalarName{"char", Scalar::kInt8},
    ScalarName{"int8", Scalar::kInt8},
    ScalarName{"uchar", Scalar::kUint8},
    ScalarName{"uint8", Scalar::kUint8},
    ScalarName{"short", Scalar::kInt16},
    ScalarName{"int16", Scalar::kInt16},
    ScalarName{"ushort", Scalar::kUint16},
    ScalarName{"uint16", Scalar::kUint16},
    ScalarName{"int", Scalar::kInt32},
    ScalarName{"int32", Scalar::kInt32},
    ScalarName{"uint", Scalar::kUint32},
    ScalarName{"uint32", Scalar::kUint32},
    ScalarName{"float", Scalar::kFloat},
    ScalarName{"float32", Scalar::kFloat},
    ScalarName{"double", Scalar::kDouble},
    ScalarName{"float64", Scalar::kDouble},
};

struct Property {
  std::string name;
  Scalar scalar = Scalar::kFloat;
  bool is_list = false;
  Scalar count_scalar = Scalar::kUint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class PlyParser {
 public:
  PlyParser(const std::string& file, std::string text)
      : file_(file), text_(std::move(text)), mesh_(file) {}

  SourceModel Run() {
    ReadHeader();
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;  // of any number, in no bytes
      for (std::size_t i = 0; i < element.count; ++i) ReadElement(element, i);
    }
    SourceModel model = mesh_.Finish();
    model.format = "PLY";
    return model;
  }

 private:
  [[noreturn]] void Fail(const std::string& place,
                         const std::string& found,
                         const std::string& expected) const {
    throw InputError(file_, place, found, expected);
  }

  std::string NextLine() {
    const std::size_t end = text_.find('\n', position_);
    if (end == std::string::npos) Fail("header", "a file that ends early", "end_header");
    std::string line = text_.substr(position_, end - position_);
    position_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  Scalar ScalarOf(const std::string& name) const {
    for (const ScalarName& entry : kScalarNames) {
      if (entry.name == name) return entry.scalar;
    }
    Fail("header", "the type \"" + name + "\"", "a PLY scalar type such as float or uchar");
  }

  void ReadHeader() {
    if (NextLine() != "ply") Fail("line 1", "something else than \"ply\"", "a PLY file");
    for (std::string line = NextLine(); line != "end_header"; line = NextLine()) {
      std::istringstream words(line);
      std::string keyword;
      words >> keyword;
      if (keyword == "format") {
        words >> format_;
      } else if (keyword == "comment") {
        mesh_.Comment(std::string_view(line).substr(7));
      } else if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count)) Fail("header", line, "element NAME COUNT");
        elements_.push_back(std::move(element));
      } else if (keyword == "property") {
        ReadProperty(words, line);
      }
    }
    if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian") {
      Fail("format", "\"" + format_ + "\"", "ascii, binary_little_endian or binary_big_endian");
    }
    const auto place_of = [this](std::string_view name) {
      return std::find_if(elements_.begin(), elements_.end(), [name](const Element& element) {
        return element.name == name;
      });
    };
    if (place_of("face") == elements_.end()) {
      Fail("header", "no element \"face\"", "faces (strips of triangles are not read)");
    }
    if (place_of("face") < place_of("vertex")) {
      Fail("header", "faces before vertices", "the element \"vertex\" first");
    }
  }

  void ReadProperty(std::istringstream& words, const std::string& line) {
    if (elements_.empty()) Fail("header", line, "an element before its properties");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count_type;
      property.is_list = true;
      words >> count_type >> type;
      property.count_scalar = ScalarOf(count_type);
    }
    property.scalar = ScalarOf(type);
    words >> property.name;
    elements_.back().properties.push_back(std::move(property));
  }

  void ReadElement(const Element& element, std::size_t index) {
    place_ = element.name + "[" + std::to_string(index) + "]";
    Eigen::Vector3d vertex = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    for (const Property& property : element.properties) {
      const std::size_t count = property.is_list ? ReadCount(property.count_scalar) : 1;
      list_.clear();
      for (std::size_t i = 0; i < count; ++i) list_.push_back(Read(property.scalar));
      if (!property.is_list && property.name == "x") vertex.x() = list_[0];
      if (!property.is_list && property.name == "y") vertex.y() = list_[0];
      if (!property.is_list && property.name == "z") vertex.z() = list_[0];
      const bool is_corners =
          property.is_list && element.name == "face" && property.name.starts_with("vertex_ind");
      if (is_corners) AddFace();
    }
    if (element.name != "vertex") return;
    if (!vertex.allFinite()) Fail(place_, "no finite x, y, z", "three finite numbers");
    mesh_.vertices().push_back(vertex);
  }

  void AddFace() {
    corners_.clear();
    for (const double value : list_) {
      if (!(value >= 0.0 && value < static_cast<double>(mesh_.vertices().size()))) {
        Fail(place_,
             "a vertex index out of range",
             "one of " + std::to_string(mesh_.vertices().size()) + " vertices");
      }
      corners_.push_back(static_cast<std::uint32_t>(value));
    }
    mesh_.AddFace(corners_);
  }

  std::size_t ReadCount(Scalar scalar) {
    const double value = Read(scalar);
    const auto rest = static_cast<double>(text_.size() - position_ + 1);
    if (!(value >= 0.0 && value <= rest)) Fail(place_, "a list longer than the file", "a list");
    return static_cast<std::size_t>(value);
  }

  double Read(Scalar scalar) {
    if (format_ == "ascii") return ReadWord();
    switch (scalar) {
      case Scalar::kInt8:
        return ReadBinary<std::int8_t>();
      case Scalar::kUint8:
        return ReadBinary<std::uint8_t>();
      case Scalar::kInt16:
        return ReadBinary<std::int16_t>();
      case Scalar::kUint16:
        return ReadBinary<std::uint16_t>();
      case Scalar::kInt32:
        return ReadBinary<std::int32_t>();
      case Scalar::kUint32:
        return ReadBinary<std::uint32_t>();
      case Scalar::kFloat:
        return ReadBinary<float>();
      case Scalar::kDouble:
        return ReadBinary<double>();
    }
    return 0.0;
  }

  double ReadWord() {
    const std::size_t first = text_.find_first_not_of(" \t\r\n", position_);
    if (first == std::string::npos) Fail(place_, "a file that ends early", "a number");
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n", first), text_.size());
    position_ = end;
    double value = 0.0;
    const auto [last, error] = std::from_chars(text_.data() + first, text_.data() + end, value);
    if (error != std::errc() || last != text_.data() + end) {
      Fail(place_,
           "\"" + text_.substr(first, std::min<std::size_t>(end - first, 40)) + "\"",
           "a number");
    }
    return value;
  }

  template <typename T>
  double ReadBinary() {
    if (text_.size() - position_ < sizeof(T)) Fail(place_, "a file that ends early", "more data");
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), text_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    const bool is_big = format_ == "binary_big_endian";
    if (is_big != (std::endian::native == std::endian::big))
      std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  std::string file_;
  std::string text_;
  MeshSource mesh_;
  std::size_t position_ = 0;
  std::string format_;
  std::string place_;
  std::vector<Element> elements_;
  std::vector<double> list_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

SourceModel ReadPly(InputFile& file) { return PlyParser(file.name(), file.ReadAll()).Run(); }

}  // namespace ridgeline
