// SPDX-License-Identifier: Apache-2.0
#include "skyline/skyline_file.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/text_file.h"
#include "camera/decode_file.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

constexpr int kBright = 128;
constexpr double kBreakShare = 0.02;  // of the height
constexpr double kShapeTolerance = 0.01;

// First row below the sky of a column, and whether the sky ends at all.
int EndOfSky(const cv::Mat& mask, int x) {
  const int longest_break = std::max(1, static_cast<int>(kBreakShare * mask.rows));
  int end = 0, dark = 0;
  for (int y = 0; y < mask.rows; ++y) {
    if (mask.at<std::uint8_t>(y, x) >= kBright) {
      end = y + 1;
      dark = 0;
    } else if (++dark > longest_break) {
      break;
    }
  }
  return end;
}

// How sure the mask is of the boundary: 1 for black and white, less for grey.
float ConfidenceAt(const cv::Mat& mask, int x, int end) {
  constexpr int kAround = 3;
  float sum = 0.0f;
  int count = 0;
  for (int y = std::max(0, end - kAround); y < std::min(mask.rows, end + kAround); ++y, ++count) {
    sum += std::abs(mask.at<std::uint8_t>(y, x) - 127.5f) / 127.5f;
  }
  return count == 0 ? 0.0f : sum / static_cast<float>(count);
}

Skyline FromMask(const fs::path& path, const CameraIntrinsics& camera) {
  cv::Mat mask = DecodeFile(path, cv::IMREAD_GRAYSCALE, "a sky mask");
  if (mask.empty()) {
    throw InputError(path.string(), "", "nothing that can be read", "a sky mask (PNG) or a CSV");
  }
  const double shape = static_cast<double>(mask.cols) / mask.rows;
  if (std::abs(shape * camera.height / camera.width - 1.0) > kShapeTolerance) {
    throw InputError(path.string(),
                     "",
                     std::to_string(mask.cols) + " x " + std::to_string(mask.rows) + " px",
                     "the shape of the picture, " + std::to_string(camera.width) + " x " +
                         std::to_string(camera.height) + " px");
  }
  cv::resize(mask, mask, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_LINEAR);
  mask = UndistortImage(mask, camera);
  Skyline skyline;
  skyline.image_width = camera.width;
  skyline.image_height = camera.height;
  for (int x = 0; x < mask.cols; ++x) {
    const int end = EndOfSky(mask, x);
    skyline.y_px.push_back(static_cast<float>(end));
    skyline.columns.push_back(end == 0             ? SkylineColumn::kAboveImage
                              : end == mask.rows   ? SkylineColumn::kBelowImage
                                                   : SkylineColumn::kSeen);
    skyline.confidence.push_back(ConfidenceAt(mask, x, end));
  }
  return skyline;
}

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else if (c != '\r' && c != ' ') {
      fields.back() += c;
    }
  }
  return fields;
}

// A CSV's rows, one by one.
class ColumnReader {
 public:
  ColumnReader(std::string file, const std::vector<std::string>& header) : file_(std::move(file)) {
    for (std::size_t k = 0; k < header.size(); ++k) {
      if (header[k] == "x_px") x_ = static_cast<int>(k);
      if (header[k] == "y_px") y_ = static_cast<int>(k);
      if (header[k] == "state") state_ = static_cast<int>(k);
      if (header[k] == "confidence") confidence_ = static_cast<int>(k);
    }
    count_ = header.size();
    if (x_ < 0 || y_ < 0) {
      throw InputError(file_, "header", "no columns x_px and y_px", "x_px,y_px[,state,confidence]");
    }
  }

  double Read(const std::vector<std::string>& fields, int line, Skyline& skyline) const {
    const std::string place = "line " + std::to_string(line);
    if (fields.size() != count_) {
      throw InputError(file_, place, std::to_string(fields.size()) + " fields",
                       std::to_string(count_) + " as in the header");
    }
    const double x = Number(fields[static_cast<std::size_t>(x_)], place + ": x_px");
    const double y = Number(fields[static_cast<std::size_t>(y_)], place + ": y_px");
    skyline.y_px.push_back(
        static_cast<float>(std::clamp(y, 0.0, static_cast<double>(skyline.image_height))));
    const SkylineColumn state =
        state_ < 0 ? SkylineColumn::kSeen : State(fields[static_cast<std::size_t>(state_)], place);
    skyline.columns.push_back(state);
    const double confidence =
        confidence_ < 0 ? 1.0
                        : Number(fields[static_cast<std::size_t>(confidence_)],
                                 place + ": confidence");
    if (confidence < 0.0 || confidence > 1.0) {
      throw InputError(file_, place + ": confidence", std::to_string(confidence), "[0, 1]");
    }
    skyline.confidence.push_back(
        state == SkylineColumn::kUnknown ? 0.0f : static_cast<float>(confidence));
    return x;
  }

 private:
  double Number(const std::string& text, const std::string& place) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) {
      throw InputError(file_, place, '"' + text + '"', "a number");
    }
    return value;
  }
  SkylineColumn State(const std::string& text, const std::string& place) const {
    if (text == "seen") return SkylineColumn::kSeen;
    if (text == "above") return SkylineColumn::kAboveImage;
    if (text == "below") return SkylineColumn::kBelowImage;
    if (text == "unknown") return SkylineColumn::kUnknown;
    throw InputError(
        file_, place + ": state", '"' + text + '"', "seen, above, below or unknown");
  }

  std::string file_;
  int x_ = -1, y_ = -1, state_ = -1, confidence_ = -1;
  std::size_t count_ = 0;
};

Skyline FromCsv(const fs::path& path, const CameraIntrinsics& camera) {
  std::istringstream text(ReadText(path));
  std::string line;
  std::getline(text, line);
  const ColumnReader reader(path.string(), Fields(line));
  Skyline skyline;
  skyline.image_width = camera.width;
  skyline.image_height = camera.height;
  std::vector<double> x;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.size() == 1 && fields.front().empty()) continue;
    x.push_back(reader.Read(fields, number, skyline));
  }
  if (x.size() < 2) throw InputError(path.string(), "", "fewer than two columns", "a skyline");
  skyline.column_step_px = static_cast<double>(camera.width) / static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(x[i] - skyline.XOf(i)) <= 0.5 * skyline.column_step_px + 1e-3) continue;
    throw InputError(path.string(),
                     "line " + std::to_string(i + 2) + ": x_px",
                     std::to_string(x[i]),
                     std::to_string(skyline.XOf(i)) + ": rows at equal steps over the " +
                         std::to_string(camera.width) + " px of the picture");
  }
  return skyline;
}

}  // namespace

Skyline ReadSkylineFile(const fs::path& path, const CameraIntrinsics& camera) {
  return path.extension() == ".csv" ? FromCsv(path, camera) : FromMask(path, camera);
}

std::optional<fs::path> SkylineFileOf(const fs::path& folder, const std::string& id) {
  std::error_code error;
  for (const char* ending : {".png", ".jpg", ".csv", "_skyline.csv"}) {
    const fs::path file = folder / (id + ending);
    if (fs::is_regular_file(file, error)) return file;
  }
  return std::nullopt;
}

}  // namespace ridgeline
