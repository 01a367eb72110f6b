// SPDX-License-Identifier: Apache-2.0
#include "cli/track_stream.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "base/error.h"
#include "input/read_picture.h"
#include "localize/localizer.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPoll{100};

// Empty: it cannot be read (yet).
cv::Mat TryRead(const fs::path& path) {
  try {
    return BgrOf(ReadPicture(path));
  } catch (const InputError&) {
    return {};
  }
}

bool IsPicture(const fs::path& path) {
  static const std::set<std::string> kExtensions{".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return kExtensions.count(extension) > 0;
}

class GrowingFolder final : public TrackFrames {
 public:
  GrowingFolder(std::string folder, std::string odometry, CameraIntrinsics camera, double idle_s)
      : folder_(std::move(folder)),
        odometry_(std::move(odometry)),
        camera_(std::move(camera)),
        idle_(idle_s) {
    std::error_code error;
    if (!fs::is_directory(folder_, error)) {
      throw InputError(folder_, "", "no folder", "a folder that pictures are put into");
    }
  }

  bool Next(TrackFrameFacts& facts, cv::Mat& picture) override {
    const auto begin = std::chrono::steady_clock::now();
    const auto waited = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    while (true) {
      const fs::path next = Waiting();
      if (!next.empty()) {
        picture = TryRead(next);
        // A picture half written may become whole; what stays broken is a missing frame.
        if (!picture.empty() || waited() > idle_) {
          last_ = next.filename().string();
          facts = {};
          facts.id = next.stem().string();
          facts.camera = camera_;
          TakeMotion(facts);
          return true;
        }
      } else if (waited() > idle_) {
        return false;
      }
      std::this_thread::sleep_for(kPoll);
    }
  }

 private:
  // The first picture by name behind the last one.
  fs::path Waiting() const {
    fs::path first;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
      const std::string name = entry.path().filename().string();
      if (!IsPicture(entry.path()) || name <= last_ || name.starts_with('.')) continue;
      if (first.empty() || name < first.filename().string()) first = entry.path();
    }
    return first;
  }

  void TakeMotion(TrackFrameFacts& facts) {
    const std::string before = id_before_;
    id_before_ = facts.id;
    if (odometry_.empty()) return;
    std::error_code error;
    if (!fs::exists(odometry_, error)) {
      facts.motion_missing = "the odometry file is not there yet";
      return;
    }
    const Odometry odometry = ReadOdometry(odometry_);
    for (const Odometry::Row& row : odometry.rows) {
      if (row.id == facts.id) facts.time_s = row.time_s;
    }
    if (before.empty()) return;
    const FrameKey keys[] = {{before, std::nullopt}, {facts.id, facts.time_s}};
    const std::vector<FrameMotion> motions = MotionsOf(odometry, keys);
    facts.motion = motions[1].motion;
    facts.motion_missing = motions[1].missing;
  }

  std::string folder_, odometry_;
  CameraIntrinsics camera_;
  double idle_;
  std::string last_, id_before_;
};

class Lines final : public TrackFrames {
 public:
  Lines(std::istream& lines, CameraIntrinsics camera)
      : lines_(lines), camera_(std::move(camera)) {}

  bool Next(TrackFrameFacts& facts, cv::Mat& picture) override {
    std::string line;
    do {
      if (!std::getline(lines_, line)) return false;
      ++number_;
    } while (line.find_first_not_of(" \t\r") == std::string::npos);
    facts = {};
    facts.camera = camera_;
    std::string image = line;
    if (line.front() == '{') image = Take(line, facts);
    if (facts.id.empty()) facts.id = fs::path(image).stem().string();
    picture = TryRead(image);
    return true;
  }

 private:
  [[noreturn]] void Fail(const std::string& field, const std::string& expected) const {
    throw InputError("standard input", "line " + std::to_string(number_) + field, "", expected);
  }

  std::string Take(const std::string& line, TrackFrameFacts& facts) const {
    try {
      const nlohmann::json json = nlohmann::json::parse(line);
      const auto number = [&](const char* name, std::optional<double>& value) {
        if (json.contains(name)) value = json.at(name).get<double>();
      };
      if (json.contains("id")) facts.id = json.at("id").get<std::string>();
      number("time_s", facts.time_s);
      number("heading_deg", facts.heading_deg);
      number("pitch_deg", facts.pitch_deg);
      number("roll_deg", facts.roll_deg);
      number("speed_m_s", facts.speed_m_s);
      if (json.contains("motion")) facts.motion = MotionOf(json.at("motion"));
      return json.at("image").get<std::string>();
    } catch (const nlohmann::json::exception& e) {
      Fail("", std::string("a path, or a JSON object with \"image\" (") + e.what() + ")");
    }
  }

  Motion MotionOf(const nlohmann::json& json) const {
    const auto step = json.at("step_m").get<std::vector<double>>();
    const auto q = json.at("before_from_now_wxyz").get<std::vector<double>>();
    if (step.size() != 3) Fail(": motion.step_m", "three numbers");
    if (q.size() != 4 || std::abs(Eigen::Vector4d(q[0], q[1], q[2], q[3]).norm() - 1.0) > 0.01) {
      Fail(": motion.before_from_now_wxyz", "a unit quaternion");
    }
    Motion motion;
    motion.step_in_before = {step[0], step[1], step[2]};
    motion.now_from_before =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().conjugate();
    motion.sigma_m = json.value("sigma_m", std::max(0.02, 0.02 * motion.step_in_before.norm()));
    motion.sigma_deg = json.value("sigma_deg", 0.2);
    return motion;
  }

  std::istream& lines_;
  CameraIntrinsics camera_;
  int number_ = 0;
};

}  // namespace

std::unique_ptr<TrackFrames> FollowFolder(const std::string& folder,
                                          const std::string& odometry,
                                          const CameraIntrinsics& camera,
                                          double idle_s) {
  return std::make_unique<GrowingFolder>(folder, odometry, camera, idle_s);
}

std::unique_ptr<TrackFrames> FramesOfLines(std::istream& lines, const CameraIntrinsics& camera) {
  return std::make_unique<Lines>(lines, camera);
}

}  // namespace ridgeline
