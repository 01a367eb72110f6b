// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "cli/context.h"

namespace ridgeline {

// Progress of long work on stderr: on a terminal one line with a bar, rate and remaining time, else
// a plain line every ten seconds and at the end. Silent with --quiet. Thread-safe.
//
//   Progress progress(context, "Localizing", queries.size(), "photos");
//   ... progress.Advance();
class Progress {
 public:
  Progress(const Context& context, std::string title, std::size_t total, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Advance(std::size_t count = 1);
  void Set(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  void Show(bool last);

  std::mutex mutex_;
  const bool silent_;
  const bool terminal_;
  const std::string title_;
  const std::string unit_;
  const std::size_t total_;
  const Clock::time_point start_;
  Clock::time_point shown_;
  std::size_t done_ = 0;
  std::size_t said_ = 0;  // of done_, on the last line
};

// "Rendering  12/40 pictures  3.1/s  9 s left": the text both forms share. Rate and remaining time
// are left out while nothing is done.
std::string ProgressText(const std::string& title,
                         std::size_t done,
                         std::size_t total,
                         const std::string& unit,
                         double seconds);

// "9 s", "2 min 05 s", "3 h 10 min".
std::string DurationText(double seconds);

// What a short piece of work is at, on a terminal: one line on stderr that goes away again. Silent
// elsewhere and with --quiet.
class Stages {
 public:
  explicit Stages(const Context& context) : shown_(context.terminal_err && !context.quiet) {}
  ~Stages() { End(); }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  void Begin(const std::string& stage);
  // Clears the line, for other text to come.
  void End();

 private:
  bool shown_;
};

}  // namespace ridgeline
