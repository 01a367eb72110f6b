// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace ridgeline {
namespace {

constexpr std::size_t kBarWidth = 24;
constexpr auto kTerminalPeriod = std::chrono::milliseconds(100);
constexpr auto kPlainPeriod = std::chrono::seconds(10);

std::string Bar(std::size_t done, std::size_t total) {
  const std::size_t filled = total == 0 ? kBarWidth : kBarWidth * std::min(done, total) / total;
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] ";
}

}  // namespace

std::string DurationText(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  char text[64];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole % 3600 / 60);
  }
  return text;
}

std::string ProgressText(const std::string& title,
                         std::size_t done,
                         std::size_t total,
                         const std::string& unit,
                         double seconds) {
  std::string text = title + "  " + std::to_string(done) + "/" + std::to_string(total) + " " + unit;
  if (done == 0 || seconds <= 0.0) return text;
  const double rate = static_cast<double>(done) / seconds;
  char number[32];
  if (rate >= 1.0) {
    std::snprintf(number, sizeof number, "  %.3g/s", rate);
  } else {
    std::snprintf(number, sizeof number, "  %.3g s each", 1.0 / rate);
  }
  text += number;
  if (done < total) return text + "  " + DurationText(double(total - done) / rate) + " left";
  return text + "  " + DurationText(seconds);
}

Progress::Progress(const Context& context, std::string title, std::size_t total, std::string unit)
    : silent_(context.quiet),
      terminal_(context.terminal_err),
      title_(std::move(title)),
      unit_(std::move(unit)),
      total_(total),
      start_(Clock::now()),
      shown_(start_) {
  if (terminal_) Show(false);
}

Progress::~Progress() {
  const std::lock_guard lock(mutex_);
  Show(true);
}

void Progress::Advance(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  Show(false);
}

void Progress::Set(std::size_t done) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  Show(false);
}

void Progress::Show(bool last) {
  if (silent_) return;
  const Clock::time_point now = Clock::now();
  const bool first = now == start_ || shown_ == start_;
  const bool due =
      terminal_ ? first || now - shown_ >= kTerminalPeriod : now - shown_ >= kPlainPeriod;
  if (!last && !due) return;
  if (last && !terminal_ && said_ > 0 && said_ == done_) return;  // that line stands already
  said_ = done_;
  shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string text = ProgressText(title_, done_, total_, unit_, seconds);
  if (terminal_) {
    std::cerr << "\r\033[K" << Bar(done_, total_) << text << (last ? "\n" : "") << std::flush;
  } else {
    std::cerr << text << '\n';
  }
}

void Stages::Begin(const std::string& stage) {
  if (shown_) std::cerr << "\r\033[K" << stage << " ..." << std::flush;
}

void Stages::End() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

}  // namespace ridgeline
