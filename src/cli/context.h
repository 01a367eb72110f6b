// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace ridgeline {

// Exit codes of the program (DESIGN.md, Command line).
inline constexpr int kExitOk = 0;         // pose found, or work done
inline constexpr int kExitInternal = 1;   // a defect of ridgeline
inline constexpr int kExitBadInput = 2;   // bad input or usage
inline constexpr int kExitAbstained = 3;  // no pose that can be vouched for
inline constexpr int kExitInterrupted = 130;

// What every command is given: the global options and the way to the terminal.
struct Context {
  bool quiet = false;      // results and errors only
  bool json = false;       // results as one JSON document on stdout
  int threads = 0;         // 0: all
  bool color_out = false;  // stdout is a terminal that takes colours
  bool color_err = false;  // the same for stderr
  bool terminal_err = false;

  // Set by the chosen command while the arguments are parsed, called by main afterwards.
  std::function<int()> run;

  // A line of the result, on stdout.
  void Print(std::string_view line) const;
  // A line about the work, on stderr; silent with --quiet.
  void Note(std::string_view line) const;
  // "warning: ..." on stderr; silent with --quiet.
  void Warn(std::string_view line) const;
};

enum class Color { kBold, kDim, kRed, kGreen, kYellow };

// The text in a terminal's colour, or as it is.
std::string Colored(bool enabled, Color color, std::string_view text);

}  // namespace ridgeline
