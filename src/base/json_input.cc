// SPDX-License-Identifier: Apache-2.0
#include "base/json_input.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

using Json = nlohmann::json;

// The beginning of a text from outside, fit for a message on any terminal.
std::string Short(std::string_view text) {
  constexpr std::size_t kShown = 20;
  std::string shown(text.substr(0, kShown));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

// Builds the document; nlohmann's own builder takes the last of two equal keys and any depth.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& file, const std::string& place)
      : text_(text), file_(file), place_(place) {}

  Json Take() { return std::move(root_); }

  bool null() override { return Add(nullptr); }
  bool boolean(bool value) override { return Add(value); }
  bool number_integer(number_integer_t value) override { return Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return Add(value); }
  bool number_float(number_float_t value, const string_t& /*digits*/) override {
    return Add(value);
  }
  bool string(string_t& value) override { return Add(std::move(value)); }
  bool binary(binary_t& value) override { return Add(std::move(value)); }

  bool start_object(std::size_t /*size*/) override { return Open(Json::object()); }
  bool start_array(std::size_t /*size*/) override { return Open(Json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& name) override {
    const auto [slot, is_new] = open_.back()->emplace(name, nullptr);
    if (!is_new) {
      throw InputError(file_, place_, "the key \"" + Short(name) + "\" twice", "each key once");
    }
    slot_ = &*slot;
    return true;
  }

  bool parse_error(std::size_t position,
                   const std::string& /*last_token*/,
                   const Json::exception& error) override {
    const std::string where = "byte " + std::to_string(position);
    const std::string at = place_.empty() ? where : place_ + ", " + where;
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) {
      throw InputError(file_, at, "a number that is too large", "numbers below 1e308");
    }
    const std::size_t found = position > 0 ? position - 1 : 0;
    std::string_view near = text_.substr(std::min(found, text_.size()));
    near = near.substr(0, near.find('\n'));
    throw InputError(file_,
                     at,
                     position > text_.size() || near.empty()
                         ? "a file that ends early"
                         : "\"" + Short(near) + "\", which is not JSON",
                     "valid JSON (there is no NaN in it)");
  }

 private:
  template <typename Value>
  bool Add(Value&& value) {
    Place(Json(std::forward<Value>(value)));
    return true;
  }

  // Puts a value where it belongs: after a key, into a list, or at the top.
  Json* Place(Json value) {
    if (slot_ != nullptr) {
      *slot_ = std::move(value);
      return std::exchange(slot_, nullptr);
    }
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    open_.back()->push_back(std::move(value));
    return &open_.back()->back();
  }

  bool Open(Json value) {
    if (open_.size() >= limits::kJsonDepth) {
      throw InputError(file_,
                       place_.empty() ? "limit" : place_ + ": limit",
                       "JSON nested deeper than " + std::to_string(limits::kJsonDepth),
                       "at most so many lists and objects within each other");
    }
    open_.push_back(Place(std::move(value)));
    return true;
  }

  bool Close() {
    open_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  const std::string& place_;
  Json root_;
  std::vector<Json*> open_;  // lists and objects around the present place
  Json* slot_ = nullptr;     // of the key that was read last
};

}  // namespace

Json ParseJson(std::string_view text, const std::string& file, const std::string& place) {
  const bool utf16 = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
                     (text.size() > 1 && (text[0] == '\0' || text[1] == '\0'));
  if (utf16) throw InputError(file, place, "text in UTF-16 or UTF-32", "JSON in UTF-8");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw InputError(file, place, "nothing", "JSON");
  }
  Builder builder(text, file, place);
  Json::sax_parse(text, &builder);
  return builder.Take();
}

std::string JsonText(const Json& value) {
  constexpr std::size_t kShown = 60;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kShown) text.replace(kShown, std::string::npos, "...");
  return text;
}

}  // namespace ridgeline
