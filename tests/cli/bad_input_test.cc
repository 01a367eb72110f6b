// SPDX-License-Identifier: Apache-2.0
// Bad input as a user meets it: one clear message, exit code 2, nothing half done.
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

// Copies a raster with the options of gdal_translate or gdalwarp.
void TranslateRaster(const fs::path& from, const fs::path& to, std::vector<const char*> words) {
  GDALAllRegister();
  words.push_back(nullptr);
  GDALDatasetH source = GDALOpen(from.c_str(), GA_ReadOnly);
  GDALTranslateOptions* options =
      GDALTranslateOptionsNew(const_cast<char**>(words.data()), nullptr);
  GDALClose(GDALTranslate(to.c_str(), source, options, nullptr));
  GDALTranslateOptionsFree(options);
  GDALClose(source);
}

// One picture of the town with its files, to be spoilt one by one.
class BadInput : public ::testing::Test {
 protected:
  BadInput() {
    const Json dataset = Json::parse(ReadFile(Town() / "dataset.json"));
    query_ = dataset["queries"][0];
    image_ = Town() / query_["image"].get<std::string>();
    model_ = Town() / "city.gml";
    dtm_ = Town() / "dtm.tif";
    camera_ = Write("camera.json", query_["camera"].dump());
    prior_ = Write("prior.json", query_["prior"].dump());
  }

  fs::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  fs::path WritePrior(Json position) const {
    Json prior = query_["prior"];
    prior["position"] = std::move(position);
    return Write("prior.json", prior.dump());
  }

  // The message of a run that must fail as bad input does, without the scratch folder.
  std::string Message(const std::string& more = "") {
    const fs::path out = folder_ / "new" / "result";
    return MessageOf("localize " + Quoted(image_) + " --model " + Quoted(model_) + " --dtm " +
                     Quoted(dtm_) + " --camera " + Quoted(camera_) + " --prior " + Quoted(prior_) +
                     " " + more +
                     (more.find("--out") == std::string::npos ? " --out " + Quoted(out) : ""));
  }
  std::string MessageOf(const std::string& arguments) {
    const Outcome outcome = Ridgeline(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_FALSE(fs::exists(folder_ / "new")) << "partial output";
    std::string text = outcome.text;
    for (const std::string& prefix : {folder_.string() + "/", Town().string() + "/"}) {
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) {
        text.erase(at, prefix.size());
      }
    }
    // Warnings may come before; the error is one line, and the last.
    const std::size_t at = text.rfind("error: ");
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), '\n'), 1)
        << text;
    return text.substr(at, text.size() - at - 1);
  }

  const fs::path folder_ = Scratch(std::string("bad ") +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Json query_;
  fs::path image_;
  fs::path model_;
  fs::path dtm_;
  fs::path camera_;
  fs::path prior_;
};

TEST_F(BadInput, ModelMissing) {
  model_ = folder_ / "nowhere.gml";
  EXPECT_EQ(Message(), "error: nowhere.gml: got no such file, expected a model file");
}

TEST_F(BadInput, ModelTruncated) {
  const std::string whole = ReadFile(model_);
  model_ = Write("half.gml", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(Message(),
              AllOf(HasSubstr("half.gml: line "), HasSubstr("got a file that ends early")));
}

TEST_F(BadInput, ModelNotXml) {
  model_ = Write("text.gml", "hello world");
  EXPECT_EQ(Message(),
            "error: text.gml: line 1: got text that is not XML (syntax error), expected a CityGML "
            "document");
}

TEST_F(BadInput, DtmInAnotherSystem) {
  TranslateRaster(dtm_, folder_ / "dtm.tif", {"-a_srs", "EPSG:31468"});
  dtm_ = folder_ / "dtm.tif";
  EXPECT_EQ(
      Message(),
      "error: dtm.tif: CRS: got EPSG:31468, expected EPSG:25832 (the model's; gdalwarp -t_srs "
      "moves it)");
}

// The model's file names no system; the user does.
TEST_F(BadInput, DtmInAnotherSystemThanTheModelIsSaidToBeIn) {
  std::string text = ReadFile(model_);
  for (std::size_t at; (at = text.find("srsName")) != std::string::npos;)
    text.replace(at, 7, "srsNone");
  model_ = Write("nameless.gml", text);
  TranslateRaster(dtm_, folder_ / "dtm.tif", {"-a_srs", "EPSG:31468"});
  dtm_ = folder_ / "dtm.tif";
  EXPECT_EQ(
      Message("--crs EPSG:25832"),
      "error: dtm.tif: CRS: got EPSG:31468, expected EPSG:25832 (the model's; gdalwarp -t_srs "
      "moves it)");
}

TEST_F(BadInput, DtmElsewhere) {
  TranslateRaster(dtm_, folder_ / "dtm.tif", {"-a_ullr", "500000", "5400100", "500100", "5400000"});
  dtm_ = folder_ / "dtm.tif";
  EXPECT_THAT(Message(),
              AllOf(HasSubstr("error: dtm.tif: extent: got 500000..500100 E, "),
                    HasSubstr("expected terrain at ")));
}

TEST_F(BadInput, DtmThatDoesNotCoverThePrior) {
  TranslateRaster(dtm_, folder_ / "dtm.tif", {"-srcwin", "0", "0", "12", "12"});
  dtm_ = folder_ / "dtm.tif";
  EXPECT_THAT(Message(),
              AllOf(HasSubstr("error: dtm.tif: position: got no terrain at the prior"),
                    HasSubstr("expected a terrain model that covers the prior")));
}

TEST_F(BadInput, DtmMissing) {
  dtm_ = folder_ / "nowhere.tif";
  EXPECT_EQ(Message(),
            "error: nowhere.tif: got no such file, expected a terrain model such as a GeoTIFF or a "
            "VRT");
}

TEST_F(BadInput, ImageMissing) {
  image_ = folder_ / "nowhere.jpg";
  EXPECT_EQ(Message(), "error: nowhere.jpg: got no such file, expected a picture");
}

TEST_F(BadInput, ImageThatDoesNotDecode) {
  image_ = Write("text.jpg", "no picture");
  EXPECT_THAT(Message(),
              StartsWith("error: text.jpg: got a file that does not decode, expected a picture in "
                         "JPEG, PNG, TIFF or WebP"));
  image_ = Write("empty.jpg", "");
  EXPECT_THAT(Message(),
              StartsWith("error: empty.jpg: got a file that does not decode, expected a picture in "
                         "JPEG, PNG, TIFF or WebP"));
}

TEST_F(BadInput, ImageThatEndsEarly) {
  const std::string whole = ReadFile(image_);
  image_ = Write("half.jpg", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(
      Message(),
      "error: half.jpg: got a JPEG file that ends early, expected a whole one (was the copy cut "
      "off?)");
}

TEST_F(BadInput, ImageOfAnotherSizeThanTheCamera) {
  Json camera = query_["camera"];
  camera["width"] = 321;
  camera_ = Write("camera.json", camera.dump());
  EXPECT_EQ(Message(),
            "error: " + query_["image"].get<std::string>() +
                ": size: got 320 x 240 px, expected the camera's 321 x 240 px");
  camera["width"] = 240;
  camera["height"] = 320;
  camera_ = Write("camera.json", camera.dump());
  EXPECT_THAT(Message(),
              HasSubstr("(pictures are taken as they are stored, not as EXIF turns them)"));
}

TEST_F(BadInput, PriorOutsideOfTheModel) {
  prior_ = WritePrior({500000.0, 5400000.0, 400.0});
  EXPECT_THAT(Message(),
              AllOf(HasSubstr("error: city.gml: extent: got 65"),
                    HasSubstr("expected buildings near the places asked for, 499990..500010 E, "
                              "5399990..5400010 N")));
}

TEST_F(BadInput, PriorInsideABuilding) {
  // The middle of the model's first ground surface, with a search that does not leave it.
  const std::string text = ReadFile(model_);
  const std::size_t ground = text.find("GroundSurface");
  const std::size_t list = text.find("posList", ground);
  const std::size_t begin = text.find('>', list) + 1;
  std::istringstream numbers(text.substr(begin, text.find('<', begin) - begin));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d point;
  std::vector<Eigen::Vector3d> ring;
  while (numbers >> point.x() >> point.y() >> point.z()) ring.push_back(point);
  ASSERT_GE(ring.size(), 4u);
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) sum += ring[i];
  const Eigen::Vector3d middle = sum / static_cast<double>(ring.size() - 1);
  prior_ = WritePrior({middle.x(), middle.y(), middle.z() + 1.7});
  EXPECT_THAT(Message("--set search.east_m=0.5 --set search.north_m=0.5"),
              AllOf(HasSubstr("error: prior: position: got a place in a building or under ground"),
                    HasSubstr("expected a place where a camera can be")));
}

TEST_F(BadInput, PriorThatIsNoNumber) {
  prior_ = Write("nan.json", R"({"position": [NaN, 5412033.0]})");
  EXPECT_EQ(Message(),
            "error: nan.json: byte 15: got \"NaN, 5412033.0]}\", which is not JSON, expected valid "
            "JSON (there is no NaN in it)");
  prior_ = Write("infinite.json", R"({"position": [1e999, 5412033.0]})");
  EXPECT_EQ(Message(),
            "error: infinite.json: byte 19: got a number that is too large, expected numbers below 1e308");
  prior_ = Write("null.json", R"({"position": [null, 5412033.0]})");
  EXPECT_EQ(Message(), "error: null.json: position[0]: got null, expected a number");
  prior_ = Write("cut.json", R"({"position": [654240.0, )");
  EXPECT_THAT(Message(), HasSubstr("error: cut.json: byte 25: got a file that ends early"));
}

TEST_F(BadInput, UnknownConfigurationKey) {
  const fs::path config = Write("config.json", R"({"search": {"esat_m": 20}})");
  EXPECT_EQ(
      Message("--config " + Quoted(config)),
      "error: config.json: search.esat_m: got an unknown key, expected e.g. \"search.east_m\"");
  EXPECT_EQ(Message("--set search.esat_m=20"),
            "error: --set: search.esat_m: got an unknown key, expected e.g. \"search.east_m\"");
}

TEST_F(BadInput, EmptyDataset) {
  const fs::path dataset =
      Write("dataset.json", R"({"name": "none", "model": ["city.gml"], "queries": []})");
  EXPECT_EQ(MessageOf("bench " + Quoted(dataset) + " --out " + Quoted(folder_ / "new")),
            "error: dataset.json: queries: got an empty list, expected at least one query");
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  Write("file", "");
  EXPECT_EQ(Message("--out " + Quoted(folder_ / "file")),
            "error: --out: got file: Not a directory, expected a folder that can be written");
  EXPECT_THAT(Message("--out " + Quoted(folder_ / "file" / "result")),
              AllOf(HasSubstr("error: --out: got file/result: "),
                    HasSubstr("expected a folder that can be written")));
  EXPECT_THAT(Message("--out /proc/ridgeline"), HasSubstr("error: --out: got /proc/ridgeline: "));
  EXPECT_EQ(Message("--report " + Quoted(folder_ / "file" / "report.html")),
            "error: --report: got file/report.html, expected a file in a folder that exists or can be "
            "made");
  EXPECT_THAT(MessageOf("bench " + Quoted(Town() / "dataset.json") + " --out /proc/ridgeline"),
              HasSubstr("error: --out: got /proc/ridgeline: "));
}

}  // namespace
}  // namespace ridgeline::testing
