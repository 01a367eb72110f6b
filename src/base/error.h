// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline {

// Input from outside that cannot be used. what() reads "file: field: got X, expected Y", with the
// parts that are known. Thrown where the input enters; main() turns it into exit code 2.
class InputError : public std::runtime_error {
 public:
  // @param file  File or argument, e.g. "prior.json" or "--seed"; may be empty.
  // @param field  Place in it, e.g. "queries[3].camera.width"; may be empty.
  // @param found  What was there; may be empty.
  // @param expected  What would have been right, or what to do.
  InputError(std::string file, std::string field, std::string found, std::string expected);

  const std::string& file() const { return file_; }
  const std::string& field() const { return field_; }

 private:
  std::string file_;
  std::string field_;
};

// The candidate nearest to `name` by edit distance; empty if there are none. For "did you mean".
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace ridgeline
