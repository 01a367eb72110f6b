// SPDX-License-Identifier: Apache-2.0
// The door for JSON from outside: what passes is safe, what does not is named with its place.
#include "base/json_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::string Repeated(const std::string& text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

// "" if the text passes.
std::string Message(const std::string& text, const std::string& place = "") {
  try {
    ParseJson(text, "a.json", place);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(JsonInput, BuildsWhatTheLibraryBuilds) {
  const std::string text =
      R"({"a": [1, -2, 3.5, true, null, "x"], "b": {"c": {}, "d": []}, "e": 18446744073709551615})";
  EXPECT_EQ(ParseJson(text, "a.json"), Json::parse(text));
  EXPECT_EQ(ParseJson(" 5 ", "a.json"), Json(5));
}

TEST(JsonInput, AMarkOfByteOrderIsPassedOver) {
  EXPECT_EQ(ParseJson("\xef\xbb\xbf{\"a\": 1}\r\n", "a.json")["a"], 1);
}

TEST(JsonInput, DepthIsBoundedWhetherTheTextIsWholeOrNot) {
  constexpr std::size_t kDeep = 1'000'000;
  const std::string limit =
      "a.json: limit: got JSON nested deeper than 100, expected at most so many lists and objects "
      "within each other";
  EXPECT_EQ(Message(Repeated("[", kDeep)), limit);
  EXPECT_EQ(Message(Repeated("[", kDeep) + Repeated("]", kDeep)), limit);
  EXPECT_EQ(Message(Repeated("{\"a\":", kDeep) + "1" + Repeated("}", kDeep)), limit);
  EXPECT_EQ(Message(Repeated("[", limits::kJsonDepth) + Repeated("]", limits::kJsonDepth)), "");
  EXPECT_THAT(Message(Repeated("[", limits::kJsonDepth + 1), "line 7"), HasSubstr("line 7: limit"));
}

TEST(JsonInput, AKeyTwiceIsNamed) {
  EXPECT_EQ(Message(R"({"a": 1, "b": {"k": 1, "k": 2}})"),
            "a.json: got the key \"k\" twice, expected each key once");
  EXPECT_EQ(Message(R"([{"k": 1}, {"k": 2}])"), "");
  EXPECT_THAT(Message("{\"\\u0061\": 1, \"a\": 2}"), HasSubstr("\"a\" twice"));
}

TEST(JsonInput, NumbersBeyondADoubleAreNamed) {
  EXPECT_EQ(Message("{\"a\": 1e400}"),
            "a.json: byte 11: got a number that is too large, expected numbers below 1e308");
  EXPECT_THAT(Message("{\"a\": NaN}"), HasSubstr("\"NaN}\", which is not JSON"));
}

TEST(JsonInput, TextsThatAreNotJson) {
  EXPECT_EQ(Message(""), "a.json: got nothing, expected JSON");
  EXPECT_EQ(Message("{\"a\": 1", "line 3"),
            "a.json: line 3, byte 8: got a file that ends early, expected valid JSON (there is no "
            "NaN in it)");
  EXPECT_EQ(Message(std::string("{\0\"\0", 4)),
            "a.json: got text in UTF-16 or UTF-32, expected JSON in UTF-8");
  EXPECT_EQ(Message("\xff\xfe{"), "a.json: got text in UTF-16 or UTF-32, expected JSON in UTF-8");
  EXPECT_THAT(Message("{\"a\": \"\xff\"}"), HasSubstr("which is not JSON"));
  EXPECT_THAT(Message("{} {}"), HasSubstr("which is not JSON"));
}

TEST(JsonInput, TextOfAValueIsShortAndAlwaysPrintable) {
  EXPECT_EQ(JsonText(Json{{"a", 1}}), "{\"a\":1}");
  EXPECT_EQ(JsonText(Json(std::string(100, 'x'))).size(), 63u);
  EXPECT_EQ(JsonText(Json("\xff")), "\"\\ufffd\"");
}

}  // namespace
}  // namespace ridgeline
