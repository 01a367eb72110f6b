// SPDX-License-Identifier: Apache-2.0
// `ridgeline skyline` on a sequence with gaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

using Row = std::map<std::string, std::string>;

std::vector<Row> ReadCsv(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string field;
    std::vector<std::string> values;
    while (std::getline(fields, field, ',')) values.push_back(field);
    if (names.empty()) {
      names = values;
      continue;
    }
    values.resize(names.size());
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = values[i];
    rows.push_back(row);
  }
  return rows;
}

TEST(SkylineSequence, GapsHaveAReasonAndNoPose) {
  const fs::path folder = Scratch("skyline gaps");
  const fs::path walk = folder / "walk";
  ASSERT_EQ(Ridgeline("synth --quiet --out " + Quoted(walk) +
                      " --walk 6 --size 160x120 --set town.blocks_east=1 --set town.blocks_north=1")
                .exit_code,
            0);
  fs::remove(walk / "images/frame_0001.jpg");
  fs::resize_file(walk / "images/frame_0002.jpg", 20);
  {
    std::ifstream all(walk / "sensors.csv");
    std::ofstream some(folder / "sensors.csv");
    std::string line;
    while (std::getline(all, line)) {
      if (line.rfind("frame_0003,", 0) == 0) continue;
      // A row without a compass.
      if (line.rfind("frame_0004,", 0) == 0) line = "frame_0004,0.8,48.8419,11.1012,,,,,,,,,,,,";
      some << line << '\n';
    }
  }
  const Outcome outcome =
      Ridgeline("skyline --quiet --dataset " + Quoted(walk / "dataset.json") + " --sensors " +
                Quoted(folder / "sensors.csv") + " --out " + Quoted(folder / "out"));
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.text;
  const std::vector<Row> rows = ReadCsv(folder / "out/frames.csv");
  ASSERT_EQ(rows.size(), 6u);
  const char* expected[] = {
      "", "missing_picture", "missing_picture", "missing_sensors", "missing_sensors", ""};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row row = rows[i];
    if (*expected[i] != '\0') {
      EXPECT_EQ(row["status"], expected[i]) << i;
    }
    EXPECT_EQ(row["status"] == "ok", !row["heading_deg"].empty()) << i;
    EXPECT_EQ(row["status"] == "ok", row["reason"].empty()) << i;
  }
  EXPECT_THAT(Row(rows[4])["reason"], HasSubstr("no compass heading"));
}

}  // namespace
}  // namespace ridgeline::testing
