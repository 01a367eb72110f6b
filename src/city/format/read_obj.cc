// SPDX-License-Identifier: Apache-2.0
#include "city/format/read_obj.h"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "city/format/mesh_source.h"

namespace ridgeline {
namespace {

class ObjParser {
 public:
  explicit ObjParser(const std::string& file) : file_(file), mesh_(file) {}

  void Line(std::string_view line) {
    ++line_number_;
    if (line_number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.ends_with('\\')) {  // goes on in the next line
      begun_.append(line.substr(0, line.size() - 1)).append(" ");
      return;
    }
    if (begun_.empty()) {
      WholeLine(line);
      return;
    }
    const std::string whole = std::exchange(begun_, {}).append(line);
    WholeLine(whole);
  }

  void WholeLine(std::string_view line) {
    if (!line.empty() && line.front() == '#') {
      mesh_.Comment(line.substr(1));
      return;
    }
    const std::string_view keyword = NextWord(line);
    if (keyword == "v") {
      Vertex(line);
    } else if (keyword == "f") {
      FaceLine(line);
    } else if (keyword == "o") {
      has_objects_ = true;
      mesh_.BeginObject(line);
      mesh_.SetClassFromName(line);
    } else if (keyword == "g") {
      if (!has_objects_ && !line.empty()) mesh_.BeginObject(line);
      mesh_.SetClassFromName(line);
    } else if (keyword == "usemtl") {
      mesh_.SetClassFromName(line);
    }
  }

  SourceModel Finish() {
    if (!begun_.empty()) WholeLine(std::exchange(begun_, {}));
    if (mesh_.vertices().empty()) {
      throw InputError(file_, "", "no vertices", "an OBJ file with v and f lines");
    }
    SourceModel model = mesh_.Finish();
    model.format = "OBJ";
    return model;
  }

 private:
  [[noreturn]] void Fail(std::string_view found, const std::string& expected) const {
    throw InputError(file_,
                     "line " + std::to_string(line_number_),
                     "\"" + std::string(found.substr(0, 40)) + "\"",
                     expected);
  }

  static std::string_view NextWord(std::string_view& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
      text = {};
      return {};
    }
    const std::size_t end = std::min(text.find_first_of(" \t", first), text.size());
    const std::string_view word = text.substr(first, end - first);
    text.remove_prefix(end);
    return word;
  }

  void Vertex(std::string_view text) {
    Eigen::Vector3d v;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = NextWord(text);
      double& value = v[axis];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
        Fail(word, "a finite number");
      }
    }
    mesh_.vertices().push_back(v);
  }

  void FaceLine(std::string_view text) {
    corners_.clear();
    for (std::string_view word = NextWord(text); !word.empty(); word = NextWord(text)) {
      const std::string_view digits = word.substr(0, word.find('/'));
      long long index = 0;
      const auto [end, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), index);
      const auto count = static_cast<long long>(mesh_.vertices().size());
      const long long position = index < 0 ? count + index : index - 1;
      if (error != std::errc() || end != digits.data() + digits.size() || position < 0 ||
          position >= count) {
        Fail(word, "a vertex among the " + std::to_string(count) + " before it");
      }
      corners_.push_back(static_cast<std::uint32_t>(position));
    }
    mesh_.AddFace(corners_);
  }

  std::string file_;
  MeshSource mesh_;
  std::vector<std::uint32_t> corners_;
  std::string begun_;  // lines that end in a backslash
  std::size_t line_number_ = 0;
  bool has_objects_ = false;
};

}  // namespace

SourceModel ReadObj(InputFile& file) {
  ObjParser parser(file.name());
  std::string buffer(std::size_t{1} << 18, '\0');
  std::string tail;
  for (std::size_t count; (count = file.Read(buffer.data(), buffer.size())) > 0;) {
    std::string_view rest(buffer.data(), count);
    for (std::size_t end; (end = rest.find('\n')) != std::string_view::npos;) {
      tail.append(rest.substr(0, end));
      parser.Line(tail);
      tail.clear();
      rest.remove_prefix(end + 1);
    }
    tail.append(rest);
  }
  if (!tail.empty()) parser.Line(tail);
  return parser.Finish();
}

}  // namespace ridgeline
