// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/context.h"
#include "eval/metrics.h"
#include "eval/protocol.h"

namespace ridgeline {

// What the tables of a bench are about.
struct BenchTitle {
  std::string dataset;
  std::string config;
  Protocol protocol;
};

// A summary as text for people.
std::string TableOf(const Summary& summary, const Protocol& protocol);

// Writes results.csv, evidence.csv, poses.txt and summary.json into a folder ("": none), and prints
// the summary.
void WriteBenchTables(const BenchTitle& title,
                      const std::vector<RunRecord>& records,
                      const Eigen::Vector3d& origin,
                      const std::filesystem::path& out,
                      const Context& context);

}  // namespace ridgeline
