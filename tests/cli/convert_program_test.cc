// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST(ConvertProgram, TownComesBackFromColmap) {
  const fs::path folder = Scratch("convert");
  const fs::path dataset = Town() / "dataset.json";
  const Outcome there =
      Ridgeline("convert " + Quoted(dataset) + " --out " + Quoted(folder / "colmap"));
  EXPECT_EQ(there.exit_code, 0) << there.text;
  const fs::path back = Town() / "back.json";
  const Outcome again =
      Ridgeline("convert " + Quoted(folder / "colmap") + " --model " + Quoted(Town() / "city.gml") +
                " --images " + Quoted(Town()) + " --out " + Quoted(back));
  EXPECT_EQ(again.exit_code, 0) << again.text;
  const Json a = Json::parse(ReadFile(dataset));
  const Json b = Json::parse(ReadFile(back));
  fs::remove(back);
  EXPECT_EQ(a["crs"], b["crs"]);
  EXPECT_EQ(a["model"], b["model"]);
  for (const char* key : {"id", "image", "camera", "truth"}) {
    EXPECT_EQ(a["queries"][0][key], b["queries"][0][key]) << key;
  }
}

TEST(ConvertProgram, WritesAViewForGlobes) {
  const fs::path folder = Scratch("convert kml");
  const Outcome outcome = Ridgeline("convert --json " + Quoted(Town() / "dataset.json") +
                                    " --out " + Quoted(folder / "town.kml"));
  EXPECT_EQ(Json::parse(outcome.text, nullptr, false)["pictures"], 1);
  EXPECT_THAT(ReadFile(folder / "town.kml"), HasSubstr("<Camera>"));
}

TEST(ConvertProgram, BadInputIsNamedAndNothingIsWritten) {
  const fs::path folder = Scratch("convert bad");
  WriteFileAtomically(folder / "poses.txt", "a.jpg 1 0 0 0 1 2 3\nb.jpg 1 0 0\n");
  const Outcome outcome = Ridgeline("convert " + Quoted(folder / "poses.txt") +
                                    " --model city.gml --out " + Quoted(folder / "d.json"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("poses.txt: line 2: got 4 columns, expected name qw"));
  EXPECT_FALSE(fs::exists(folder / "d.json"));
  WriteFileAtomically(folder / "poses.txt", "a.jpg 1 0 0 0 1 2 3\n");
  EXPECT_THAT(
      Ridgeline("convert " + Quoted(folder / "poses.txt") + " --out " + Quoted(folder / "d.json"))
          .text,
      HasSubstr("--model: got nothing, expected the city model"));
}

}  // namespace
}  // namespace ridgeline::testing
