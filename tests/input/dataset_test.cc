// SPDX-License-Identifier: Apache-2.0
#include "input/dataset.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

constexpr const char* kGood = R"({
  "name": "town", "crs": "EPSG:25832", "model": ["town.gml"], "dtm": "dtm.tif",
  "queries": [{"id": "000", "image": "images/000.jpg", "set": "street",
    "camera": {"model": "PINHOLE", "width": 640, "height": 480, "params": [500, 500, 320, 240]},
    "prior": {"position": [690896.1, 5335940.9], "heading_deg": -10},
    "truth": {"position": [690896.6, 5335941.1, 517.0], "cam_from_world_wxyz": [0.5, -0.5, 0.5, -0.5]}}]
})";

std::filesystem::path Write(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("ridgeline_dataset_" + std::to_string(::getpid()) + ".json");
  WriteFileAtomically(path, text);
  return path;
}

std::string Replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string MessageOf(const std::string& text) {
  try {
    ReadDataset(Write(text));
  } catch (const InputError& e) {
    return std::string(e.what()).substr(std::string(e.what()).find(".json: ") + 7);
  }
  return "no error";
}

TEST(Dataset, ReadsAllParts) {
  const Dataset dataset = ReadDataset(Write(kGood));
  EXPECT_EQ(dataset.name, "town");
  ASSERT_EQ(dataset.queries.size(), 1u);
  const Query& query = dataset.queries[0];
  EXPECT_EQ(query.image.parent_path().parent_path(), dataset.file.parent_path());
  EXPECT_EQ(query.prior->heading_deg, 350.0);
  EXPECT_FALSE(query.prior->height_in_world.has_value());
  EXPECT_FALSE(query.prior->pitch_deg.has_value());
  EXPECT_EQ(query.truth->center_in_world.z(), 517.0);
}

TEST(Dataset, AFolderStandsForItsDatasetJson) {
  const std::filesystem::path file = Write(kGood);
  const std::filesystem::path folder = file.parent_path() / "folder";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(file,
                             folder / "dataset.json",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(ReadDataset(folder).file, folder / "dataset.json");
}

TEST(Dataset, NumbersInOtherUnitsAreRecognized) {
  EXPECT_EQ(MessageOf(Replaced("[500, 500, 320, 240]", "[24, 24, 320, 240]")),
            "queries[0].camera.params[0]: got 24, 173 deg across 640 x 480 px, expected a focal "
            "length in pixels, a field of view of 5 to 150 deg; millimetres? As a 35 mm equivalent "
            "it is 443.8 px");
  EXPECT_EQ(MessageOf(Replaced("[500, 500, 320, 240]", "[0.85, 0.85, 320, 240]")),
            "queries[0].camera.params[0]: got 0.85, 180 deg across 640 x 480 px, expected a focal "
            "length in pixels, a field of view of 5 to 150 deg; as a part of the longer side it is "
            "544.0 px");
  EXPECT_EQ(MessageOf(Replaced("\"heading_deg\": -10", "\"heading_rad\": 0.5")),
            "queries[0].prior.heading_rad: got radians, expected \"heading_deg\", in degrees");
}

TEST(Dataset, ExchangedFilesAreRecognized) {
  const auto message = [](const auto& read, const std::string& text) {
    try {
      read(Write(text));
    } catch (const InputError& e) {
      return std::string(e.what()).substr(std::string(e.what()).find(".json: ") + 7);
    }
    return std::string("no error");
  };
  EXPECT_EQ(message(ReadPrior,
                    R"({"model": "PINHOLE", "width": 6, "height": 4, "params": [5, 5, 3, 2]})"),
            "got a camera, expected a prior: position, heading_deg, ... (were the two files "
            "exchanged?)");
  EXPECT_EQ(message(ReadCamera, R"({"position": [1, 2], "heading_deg": 30})"),
            "got a prior, expected a camera: model, width, height, params (were the two files "
            "exchanged?)");
}

TEST(Dataset, BadInputIsNamedByItsPlace) {
  EXPECT_EQ(MessageOf(Replaced("\"heading_deg\": -10", "\"heading_deg\": 412.5")),
            "queries[0].prior.heading_deg: got 412.5, expected a number in [-360, 360]");
  EXPECT_EQ(MessageOf(Replaced("\"heading_deg\"", "\"heding_deg\"")),
            "queries[0].prior.heding_deg: got an unknown key, expected e.g. \"heading_deg\"");
  EXPECT_EQ(MessageOf(Replaced("[690896.1, 5335940.9]", "[690896.1]")),
            "queries[0].prior.position: got 1 numbers, expected [east, north] or [east, north, "
            "height]");
  EXPECT_EQ(MessageOf(Replaced("\"width\": 640", "\"width\": 640.5")),
            "queries[0].camera.width: got 640.5, expected a whole number");
  EXPECT_EQ(MessageOf(Replaced("\"image\"", "\"lines\"")),
            "queries[0].image: got nothing, expected this key");
  EXPECT_EQ(MessageOf(Replaced("[0.5, -0.5, 0.5, -0.5]", "[0.5, -0.5, 0.5, 0.9]")).substr(0, 44),
            "queries[0].truth.cam_from_world_wxyz: got no");
  EXPECT_EQ(MessageOf(R"({"name": "x", "model": ["a.gml"], "queries": []})"),
            "queries: got an empty list, expected at least one query");
  EXPECT_EQ(MessageOf("{").substr(0, 4), "byte");
}

TEST(Dataset, IdsMustDiffer) {
  std::string text = kGood;
  const std::size_t first = text.find("[{\"id\"") + 1;
  const std::string query = text.substr(first, text.rfind("]") - first);
  text.insert(first, query + ",");
  EXPECT_EQ(MessageOf(text), "queries[1]: got the id \"000\" again, expected ids that differ");
}

TEST(Dataset, MistypedIdNamesTheNearest) {
  const Dataset dataset = ReadDataset(Write(kGood));
  EXPECT_EQ(FindQuery(dataset, "000", "--query"), 0u);
  try {
    FindQuery(dataset, "00", "--query");
    ADD_FAILURE();
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.rfind("--query: got \"00\", expected a query of ", 0), 0u) << text;
    EXPECT_NE(text.find("e.g. \"000\""), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace ridgeline
