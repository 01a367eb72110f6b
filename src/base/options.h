// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline {

// Walks the fields of an options struct. Each options struct is the only home of its defaults and
// has `void Visit(OptionVisitor& v)`, which names every field once:
//
//   void Visit(OptionVisitor& v) {
//     v.Field("min_length_px", min_length_px);
//     v.Group("canny", [&](OptionVisitor& g) { canny.Visit(g); });
//   }
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  virtual void Field(std::string_view name, bool& value) = 0;
  virtual void Field(std::string_view name, int& value) = 0;
  virtual void Field(std::string_view name, double& value) = 0;
  virtual void Field(std::string_view name, std::string& value) = 0;
  virtual void Field(std::string_view name, std::vector<double>& value) = 0;
  virtual void Field(std::string_view name, std::vector<std::string>& value) = 0;
  virtual void Group(std::string_view name, const std::function<void(OptionVisitor&)>& fields) = 0;
};

using VisitOptions = std::function<void(OptionVisitor&)>;

// All fields as pretty-printed JSON.
std::string OptionsToJson(const VisitOptions& options);

// Reads JSON text over the present values; absent keys keep them. Throws InputError(file, path of
// the key, ...) for text that is not JSON, for unknown keys (with the nearest known one) and for
// values of a wrong type.
void OptionsFromJson(const std::string& json, const std::string& file, const VisitOptions& options);

// Applies one "path.to.key=value" (the value is JSON; a bare word is a string). Throws InputError as
// above, with the file "--set".
void SetOption(const std::string& assignment, const VisitOptions& options);

}  // namespace ridgeline
