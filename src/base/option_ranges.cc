// SPDX-License-Identifier: Apache-2.0
// What follows from the ranges of options: checks, and their list.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/options.h"

namespace ridgeline {
namespace {

std::string Number(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

std::string Joined(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

class Checker final : public OptionVisitor {
 public:
  explicit Checker(std::string path) : path_(std::move(path)) {}
  void Field(std::string_view /*name*/, bool& /*value*/) override {}
  void Field(std::string_view name, int& value, const NumberRange& range) override {
    Rule(name, range.Holds(value), Number(value), range.Text());
  }
  void Field(std::string_view name, double& value, const NumberRange& range) override {
    Rule(name, range.Holds(value), Number(value), range.Text());
  }
  void Field(std::string_view name, std::string& value, const OneOf& words) override {
    Rule(name, words.Holds(value), "\"" + value + "\"", words.Text());
  }
  void Field(std::string_view name, std::vector<double>& value, const NumberRange& range) override {
    for (double& element : value) Field(name, element, range);
  }
  void Field(std::string_view /*name*/, std::vector<std::string>& /*value*/) override {}
  void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) override {
    Checker checker(Joined(path_, name));
    fields(checker);
  }
  void Rule(std::string_view name,
            bool holds,
            std::string_view found,
            std::string_view expected) override {
    if (holds) return;
    throw InputError("", Joined(path_, name), std::string(found), std::string(expected));
  }

 private:
  std::string path_;
};

// A row per field: path, value, what it may be.
class Lister final : public OptionVisitor {
 public:
  using Row = std::array<std::string, 3>;

  Lister(std::string path, std::vector<Row>& rows) : path_(std::move(path)), rows_(rows) {}
  void Field(std::string_view name, bool& value) override { Add(name, value, "true or false"); }
  void Field(std::string_view name, int& value, const NumberRange& range) override {
    Add(name, value, range.Text() + ", whole");
  }
  void Field(std::string_view name, double& value, const NumberRange& range) override {
    Add(name, value, range.Text());
  }
  void Field(std::string_view name, std::string& value, const OneOf& words) override {
    Add(name, value, words.Text());
  }
  void Field(std::string_view name, std::vector<double>& value, const NumberRange& range) override {
    Add(name, value, "each " + range.Text());
  }
  void Field(std::string_view name, std::vector<std::string>& value) override {
    Add(name, value, "texts");
  }
  void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) override {
    Lister lister(Joined(path_, name), rows_);
    fields(lister);
  }

 private:
  void Add(std::string_view name, const nlohmann::json& value, const std::string& range) {
    rows_.push_back({Joined(path_, name), value.dump(), range});
  }

  std::string path_;
  std::vector<Row>& rows_;
};

}  // namespace

bool NumberRange::Holds(double value) const {
  return std::isfinite(value) && (with_lower ? value >= lower : value > lower) &&
         (with_upper ? value <= upper : value < upper);
}

std::string NumberRange::Text() const {
  const std::string from = lower_name.empty() ? Number(lower) : std::string(lower_name);
  if (std::isinf(upper)) {
    return std::isinf(lower) ? "any number" : (with_lower ? ">= " : "> ") + from;
  }
  return (with_lower ? "[" : "(") + from + ", " + Number(upper) + (with_upper ? "]" : ")");
}

bool OneOf::Holds(const std::string& value) const {
  return words.empty() || std::find(words.begin(), words.end(), value) != words.end();
}

std::string OneOf::Text() const {
  if (words.empty()) return "a text";
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) {
    text += (i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

void CheckVisited(const VisitOptions& options, const std::string& path) {
  Checker checker(path);
  options(checker);
}

std::string OptionsWithRanges(const VisitOptions& options) {
  std::vector<Lister::Row> rows;
  Lister lister("", rows);
  options(lister);
  std::array<std::size_t, 2> widths = {};
  for (const Lister::Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Lister::Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
    }
    text += row.back() + "\n";
  }
  return text;
}

}  // namespace ridgeline
