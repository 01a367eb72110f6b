// SPDX-License-Identifier: Apache-2.0
#include "base/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_input.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Json = nlohmann::json;

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
  std::string Path(std::string_view name) const {
    return prefix_.empty() ? std::string(name) : prefix_ + "." + std::string(name);
  }

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

}  // namespace

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
