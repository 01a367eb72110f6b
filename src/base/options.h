// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ridgeline {

// The numbers that an option may be; NaN and infinity are in no range.
struct NumberRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool with_lower = true;
  bool with_upper = true;
  // Name of another option that the lower limit is, for the text; empty: the number itself.
  std::string_view lower_name = {};

  bool Holds(double value) const;
  // "> 0", ">= canny_low", "[0, 1)" or, of all numbers, "any number".
  std::string Text() const;
};

constexpr NumberRange AnyNumber() { return {}; }
constexpr NumberRange AtLeast(double lower, std::string_view name = {}) {
  return {.lower = lower, .lower_name = name};
}
constexpr NumberRange MoreThan(double lower, std::string_view name = {}) {
  return {.lower = lower, .with_lower = false, .lower_name = name};
}
constexpr NumberRange Positive() { return MoreThan(0.0); }
constexpr NumberRange NotNegative() { return AtLeast(0.0); }
constexpr NumberRange Closed(double lower, double upper) { return {lower, upper, true, true}; }
constexpr NumberRange Open(double lower, double upper) { return {lower, upper, false, false}; }
constexpr NumberRange LeftOpen(double lower, double upper) { return {lower, upper, false, true}; }
constexpr NumberRange RightOpen(double lower, double upper) { return {lower, upper, true, false}; }

// The words that an option may be; none: any text.
struct OneOf {
  std::vector<std::string> words;

  bool Holds(const std::string& value) const;
  // "map, grid or sampler".
  std::string Text() const;
};

// Walks the fields of an options struct. Each options struct is the only home of its defaults and
// has `void Visit(OptionVisitor& v)`, which names every field once, with the values it may have:
//
//   void Visit(OptionVisitor& v) {
//     v.Field("min_length_px", min_length_px, Positive());
//     v.Field("method", method, {{"map", "sampler"}});
//     v.Group("canny", [&](OptionVisitor& g) { canny.Visit(g); });
//     v.Rule("weights", weights.size() == 5, "another number of them", "5 numbers");
//   }
//
// Reading, writing, checking and the list of `ridgeline options --ranges` follow from it.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  virtual void Field(std::string_view name, bool& value) = 0;
  virtual void Field(std::string_view name, int& value, const NumberRange& range) = 0;
  virtual void Field(std::string_view name, double& value, const NumberRange& range) = 0;
  virtual void Field(std::string_view name, std::string& value, const OneOf& words = {}) = 0;
  // The range is of each number.
  virtual void Field(std::string_view name,
                     std::vector<double>& value,
                     const NumberRange& range) = 0;
  virtual void Field(std::string_view name, std::vector<std::string>& value) = 0;
  virtual void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) = 0;
  // What no range of a single field can say: a field is wrong unless the rule holds.
  virtual void Rule(std::string_view /*name*/,
                    bool /*holds*/,
                    std::string_view /*found*/,
                    std::string_view /*expected*/) {}
};

using VisitOptions = std::function<void(OptionVisitor&)>;

// All fields as pretty-printed JSON.
std::string OptionsToJson(const VisitOptions& options);

// A line per field: path, value, and what it may be, in columns.
std::string OptionsWithRanges(const VisitOptions& options);

// Reads JSON text over the present values; absent keys keep them. Throws InputError(file, path of
// the key, ...) for text that is not JSON, for unknown keys (with the nearest known one) and for
// values of a wrong type. Ranges are not looked at, since they may depend on further fields.
void OptionsFromJson(const std::string& json, const std::string& file, const VisitOptions& options);

// Applies one "path.to.key=value" (the value is JSON; a bare word is a string). Throws InputError as
// above, with the file "--set".
void SetOption(const std::string& assignment, const VisitOptions& options);

// Throws InputError naming the first field that is out of its range or breaks a rule, below `path`,
// e.g. "search.map.tilts".
void CheckVisited(const VisitOptions& options, const std::string& path);
template <typename Options>
void CheckOptions(Options options, const std::string& path = "") {
  CheckVisited([&options](OptionVisitor& v) { options.Visit(v); }, path);
}

}  // namespace ridgeline
