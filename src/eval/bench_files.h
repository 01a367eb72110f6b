// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "eval/metrics.h"
#include "eval/protocol.h"

namespace ridgeline {

// The files of docs/dataset.md, "What bench writes"; each appears whole or not at all.

// One row per run.
std::string ResultsCsv(std::span<const RunRecord> runs);

// Summary over all runs, and by set where there are several. Recalls are null without truth and
// where the protocol leaves no right answer in the box.
std::string SummaryJson(const std::string& dataset,
                        const std::string& config,
                        const Protocol& protocol,
                        std::span<const RunRecord> runs);

// COLMAP's images.txt lines of the answered runs, relative to `origin` (rounded world coordinates).
std::string PosesText(std::span<const RunRecord> runs, const Eigen::Vector3d& origin);

// Poses of another system: CSV with the columns query,e,n,h,qw,qx,qy,qz. Throws InputError with the
// line.
std::map<std::string, Pose> ReadPosesCsv(const std::filesystem::path& path);

}  // namespace ridgeline
