// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "eval/bench_queries.h"
#include "eval/protocol.h"
#include "localize/localizer.h"

namespace ridgeline {

// The experiments of Loeper et al., section 4.3, on the queries of a dataset.
struct LoeperReplayOptions {
  std::vector<double> sides_m = {40.0, 20.0};       // of the square of X, Y
  std::vector<double> headings_deg = {10.0, 20.0};  // kappa within +- this
  std::vector<int> iterations = {50, 100, 200};     // rising
  std::uint64_t seed = 1;                           // of priors and samplers
  int threads = 0;

  // Throws InputError naming the argument.
  void Validate() const;
};

// A way to do the experiment.
struct LoeperMethod {
  std::string name;   // "printed", "corrected", "evidence"
  std::string words;  // for people, one line
  // Whether the box lies around the true place and heading, as printed; else around a prior drawn
  // in it.
  bool around_truth = false;
  LocalizerOptions options;  // search.method "sampler", level camera, one height above the terrain
};

// As printed; with what is wrong in it mended (exact visible edges in place of Canny and Hough on a
// z-buffer, the box around a prior); and with the default score and sampler at the same number of
// poses.
std::vector<LoeperMethod> LoeperMethods();

// A pose that a search looked at. Heading errors are signed as those of kappa (counterclockwise).
struct LoeperSample {
  int iteration = 0;  // from 1
  double energy = 1.0;
  double translation_m = 0.0;
  double horizontal_m = 0.0;
  double kappa_deg = 0.0;
  double rotation_deg = 0.0;  // angle of the whole rotation
};

// One picture searched in one box by one method.
struct LoeperRun {
  std::size_t query = 0;  // index into Dataset::queries
  std::size_t method = 0;
  double side_m = 0.0;
  double heading_deg = 0.0;
  std::vector<LoeperSample> samples;  // by iteration; without those off the terrain
  double seconds = 0.0;

  // The sample of least energy among the first `iterations`; nullptr: none.
  const LoeperSample* BestAfter(int iterations) const;
};

using LoeperProgress = std::function<void(std::size_t done, std::size_t total)>;

// The protocol "paper" with another box.
Protocol LoeperProtocol(double side_m, double heading_deg);

// Runs the methods on one box after the other. A search of the most iterations holds those of fewer:
// samplers do not know their budget. One picture at a time, on all threads; the same result on any
// number of them.
//
// @param localizers  One per method, on the same model.
std::vector<LoeperRun> ReplayLoeper(const Dataset& dataset,
                                    std::span<const std::size_t> queries,
                                    std::span<const LoeperMethod> methods,
                                    std::span<const std::unique_ptr<Localizer>> localizers,
                                    const LoeperReplayOptions& options,
                                    const LoeperProgress& progress);

}  // namespace ridgeline
