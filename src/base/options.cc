// SPDX-License-Identifier: Apache-2.0
#include "base/options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/json_input.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Json = nlohmann::json;

std::string Number(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

std::string Joined(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

class JsonWriter final : public OptionVisitor {
 public:
  explicit JsonWriter(OrderedJson& out) : out_(out) { out_ = OrderedJson::object(); }
  void Field(std::string_view name, bool& value) override { Put(name, value); }
  void Field(std::string_view name, int& value, const NumberRange&) override { Put(name, value); }
  void Field(std::string_view name, double& value, const NumberRange&) override {
    Put(name, value);
  }
  void Field(std::string_view name, std::string& value, const OneOf&) override { Put(name, value); }
  void Field(std::string_view name, std::vector<double>& value, const NumberRange&) override {
    Put(name, value);
  }
  void Field(std::string_view name, std::vector<std::string>& value) override { Put(name, value); }
  void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) override {
    JsonWriter writer(out_[std::string(name)]);
    fields(writer);
  }

 private:
  template <typename T>
  void Put(std::string_view name, const T& value) {
    out_[std::string(name)] = value;
  }

  OrderedJson& out_;
};

class JsonReader final : public OptionVisitor {
 public:
  JsonReader(const Json& in, std::string file, std::string prefix)
      : in_(in), file_(std::move(file)), prefix_(std::move(prefix)) {}

  void Field(std::string_view name, bool& value) override {
    Get(name, value, "true or false", [](const Json& j) { return j.is_boolean(); });
  }
  void Field(std::string_view name, int& value, const NumberRange&) override {
    Get(name, value, "a whole number", [](const Json& j) {
      constexpr double kMost = std::numeric_limits<int>::max();
      return j.is_number_integer() && std::abs(j.get<double>()) <= kMost;
    });
  }
  void Field(std::string_view name, double& value, const NumberRange&) override {
    Get(name, value, "a number", [](const Json& j) { return j.is_number(); });
    // Beyond it no option means anything, and squares overflow.
    constexpr double kMost = 1e9;
    if (std::abs(value) <= kMost) return;
    throw InputError(file_, Path(name), JsonText(Json(value)), "a number of at most 1e9");
  }
  void Field(std::string_view name, std::string& value, const OneOf&) override {
    Get(name, value, "a text", [](const Json& j) { return j.is_string(); });
  }
  void Field(std::string_view name, std::vector<double>& value, const NumberRange&) override {
    Get(name, value, "a list of numbers", [](const Json& j) {
      return j.is_array() &&
             std::all_of(j.begin(), j.end(), [](const Json& e) { return e.is_number(); });
    });
  }
  void Field(std::string_view name, std::vector<std::string>& value) override {
    Get(name, value, "a list of texts", [](const Json& j) {
      return j.is_array() &&
             std::all_of(j.begin(), j.end(), [](const Json& e) { return e.is_string(); });
    });
  }
  void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) override {
    known_.emplace_back(name);
    const auto it = in_.find(std::string(name));
    if (it == in_.end()) return;
    if (!it->is_object()) {
      throw InputError(
          file_, Path(name), JsonText(*it), "an object { " + FirstKey(fields) + "... }");
    }
    JsonReader reader(*it, file_, Path(name));
    fields(reader);
    reader.RejectUnknown();
  }

  void RejectUnknown() const {
    for (const auto& [key, value] : in_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const std::string nearest = NearestName(key, known_);
      throw InputError(file_,
                       Path(key),
                       "an unknown key",
                       nearest.empty() ? "no key here" : "e.g. \"" + Path(nearest) + "\"");
    }
  }

 private:
  std::string Path(std::string_view name) const { return Joined(prefix_, name); }

  // What a group begins with, as an example.
  static std::string FirstKey(const std::function<void(OptionVisitor&)>& fields) {
    const Json none = Json::object();
    JsonReader reader(none, "", "");
    fields(reader);
    return reader.known_.empty() ? "" : "\"" + reader.known_.front() + "\": ..., ";
  }

  template <typename T, typename Test>
  void Get(std::string_view name, T& value, const char* expected, const Test& test) {
    known_.emplace_back(name);
    const auto it = in_.find(std::string(name));
    if (it == in_.end()) return;
    if (!test(*it)) throw InputError(file_, Path(name), JsonText(*it), expected);
    value = it->template get<T>();
  }

  const Json& in_;
  std::string file_;
  std::string prefix_;
  std::vector<std::string> known_;
};

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
  void Add(std::string_view name, const Json& value, const std::string& range) {
    rows_.push_back({Joined(path_, name), value.dump(), range});
  }

  std::string path_;
  std::vector<Row>& rows_;
};

}  // namespace

bool NumberRange::Holds(double value) const {
  return (with_lower ? value >= lower : value > lower) &&
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

std::string OptionsToJson(const VisitOptions& options) {
  OrderedJson json;
  JsonWriter writer(json);
  options(writer);
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

namespace {

void ReadOptions(const Json& json, const std::string& file, const VisitOptions& options) {
  if (!json.is_object()) throw InputError(file, "", json.type_name(), "a JSON object { ... }");
  JsonReader reader(json, file, "");
  options(reader);
  reader.RejectUnknown();
}

}  // namespace

void OptionsFromJson(const std::string& text,
                     const std::string& file,
                     const VisitOptions& options) {
  ReadOptions(ParseJson(text, file), file, options);
}

void SetOption(const std::string& assignment, const VisitOptions& options) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set", "", "\"" + assignment + "\"", "path.to.key=value");
  }
  const std::string text = assignment.substr(equals + 1);
  Json value = Json::accept(text) ? ParseJson(text, "--set") : Json(text);
  std::string path = assignment.substr(0, equals);
  if (static_cast<std::size_t>(std::count(path.begin(), path.end(), '.')) > limits::kJsonDepth) {
    throw InputError("--set", "limit", "a path of so many dots", "path.to.key=value");
  }
  for (std::size_t dot = path.rfind('.'); dot != std::string::npos; dot = path.rfind('.')) {
    value = Json{{path.substr(dot + 1), value}};
    path.resize(dot);
  }
  ReadOptions(Json{{path, value}}, "--set", options);
}

}  // namespace ridgeline
