// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/focal_length.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "input/assumption.h"

namespace ridgeline {

struct Query {
  std::string id;
  std::string set;  // label to group results by; may be empty
  std::filesystem::path image;
  std::optional<std::filesystem::path> lines;  // segments of another detector
  std::optional<CameraIntrinsics> camera;      // absent: the picture's own EXIF
  std::optional<PosePrior> prior;              // absent: the picture's own EXIF / XMP
  std::optional<Pose> truth;                   // in the world frame
  // EXIF orientation by which the picture is turned before use; a picture with a camera of its own
  // is taken as it is stored.
  int orientation = 1;
  // What else the focal length of a camera made from the picture's words may be, the camera's own
  // first (camera/focal_length.h); empty for a camera that was given.
  std::vector<FocalHypothesis> focal_lengths;
  // What was made of the parts of camera and prior that are absent; empty as read.
  std::vector<Assumption> assumptions;
};

// A set of queries against one model (docs/dataset.md).
struct Dataset {
  std::filesystem::path file;
  std::string name;
  std::string crs;  // of all positions, and of the model where it carries none; may be empty
  std::vector<std::filesystem::path> model;
  std::optional<std::filesystem::path> dtm;
  std::vector<Query> queries;
};

// Reads and checks a dataset.json, or that of a folder; paths become absolute or relative to its folder. Throws
// InputError naming file and field (e.g. "queries[3].prior.heading_deg") for anything missing,
// unknown, of a wrong type or out of range, for two queries with one id, and for a dataset without
// queries.
Dataset ReadDataset(const std::filesystem::path& path);

// Index of the query of an id. Throws InputError naming `option` and the nearest id.
std::size_t FindQuery(const Dataset& dataset, const std::string& id, const std::string& option);

// A prior from JSON text like a dataset's "prior". Throws as above.
PosePrior ReadPrior(const std::filesystem::path& path);

// A camera from JSON text like a dataset's "camera". Throws as above.
CameraIntrinsics ReadCamera(const std::filesystem::path& path);

}  // namespace ridgeline
