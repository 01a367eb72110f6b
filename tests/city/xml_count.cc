// SPDX-License-Identifier: Apache-2.0
#include "city/xml_count.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>

namespace ridgeline::testing {
namespace {

struct Totals {
  std::size_t polygons = 0;
  double area = 0.0;
  std::array<double, 4> area_of_class{};
};

// Area of a closed ring of x y z numbers.
double RingArea(const std::vector<double>& n) {
  double a = 0.0, b = 0.0, c = 0.0;
  for (std::size_t i = 0; i + 5 < n.size(); i += 3) {
    const double x0 = n[i] - n[0], y0 = n[i + 1] - n[1], z0 = n[i + 2] - n[2];
    const double x1 = n[i + 3] - n[0], y1 = n[i + 4] - n[1], z1 = n[i + 5] - n[2];
    a += y0 * z1 - z0 * y1;
    b += z0 * x1 - x0 * z1;
    c += x0 * y1 - y0 * x1;
  }
  return 0.5 * std::sqrt(a * a + b * b + c * c);
}

class Scanner {
 public:
  explicit Scanner(std::string text) : text_(std::move(text)) {}

  XmlCount Run() {
    std::size_t at = 0;
    while ((at = text_.find('<', at)) != std::string::npos) {
      if (text_.compare(at, 4, "<!--") == 0) {
        at = text_.find("-->", at);
        continue;
      }
      const std::size_t end = text_.find('>', at);
      const std::string_view tag(text_.data() + at + 1, end - at - 1);
      at = end + 1;
      if (tag[0] == '?' || tag[0] == '!') continue;
      if (tag[0] == '/') {
        Close(at);
      } else {
        Open(tag, at);
        if (tag.back() == '/') Close(at);
      }
    }
    return count_;
  }

 private:
  static std::string Local(std::string_view tag) {
    tag = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    const std::size_t colon = tag.find(':');
    return std::string(colon == std::string_view::npos ? tag : tag.substr(colon + 1));
  }

  bool Within(std::string_view name) const {
    for (const std::string& open : stack_) {
      if (open == name) return true;
    }
    return false;
  }

  bool InBuilding() const { return Within("Building") || Within("BuildingPart"); }

  bool IsInside() const {
    return Within("interiorRoom") || Within("Room") || Within("BuildingFurniture");
  }

  int Lod() const {
    for (std::size_t i = stack_.size(); i-- > 0;) {
      if (stack_[i].size() > 4 && stack_[i].compare(0, 3, "lod") == 0) return stack_[i][3] - '0';
    }
    return -1;
  }

  int Class() const {
    constexpr std::array kNames = {"WallSurface", "RoofSurface", "GroundSurface", "ClosureSurface"};
    for (int c = 0; c < 4; ++c) {
      if (Within(kNames[static_cast<std::size_t>(c)])) return c;
    }
    return -1;
  }

  void Open(std::string_view tag, std::size_t content) {
    stack_.push_back(Local(tag));
    content_begin_ = content;
    const std::string& name = stack_.back();
    if (name == "Building" || name == "BuildingPart") ++count_.buildings;
    if (name == "Polygon") polygon_area_ = 0.0;
    if (name == "LinearRing") ring_.clear();
  }

  void Close(std::size_t after) {
    const std::string name = stack_.back();
    if (name == "posList" || name == "pos") {
      const char* p = text_.data() + content_begin_;
      const char* const end = text_.data() + text_.rfind('<', after - 1);
      for (char* next = nullptr; p < end; p = next) {
        const double value = std::strtod(p, &next);
        if (next == p) break;
        if (next <= end) ring_.push_back(value);
      }
    } else if (name == "LinearRing") {
      const double area = RingArea(ring_);
      polygon_area_ += Within("interior") ? -area : area;
    } else if (name == "Polygon" && InBuilding() && !IsInside() && Lod() >= 0) {
      Totals& totals = of_lod_[static_cast<std::size_t>(Lod())];
      ++totals.polygons;
      // Outline and hole have changed places in one file.
      polygon_area_ = std::abs(polygon_area_);
      totals.area += polygon_area_;
      if (Class() >= 0) totals.area_of_class[static_cast<std::size_t>(Class())] += polygon_area_;
    }
    stack_.pop_back();
    if ((name == "Building" || name == "BuildingPart") && !InBuilding()) TakeBestLod();
  }

  void TakeBestLod() {
    for (const std::size_t lod : {2u, 3u, 4u, 1u}) {
      const Totals& totals = of_lod_[lod];
      if (totals.polygons == 0) continue;
      count_.polygons += totals.polygons;
      count_.area += totals.area;
      for (std::size_t c = 0; c < 4; ++c) count_.area_of_class[c] += totals.area_of_class[c];
      break;
    }
    of_lod_ = {};
  }

  std::string text_;
  std::vector<std::string> stack_;
  std::size_t content_begin_ = 0;
  std::vector<double> ring_;
  double polygon_area_ = 0.0;
  std::array<Totals, 5> of_lod_{};
  XmlCount count_;
};

}  // namespace

XmlCount CountXml(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return Scanner(std::string(std::istreambuf_iterator<char>(stream), {})).Run();
}

}  // namespace ridgeline::testing
