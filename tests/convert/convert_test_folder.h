// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline::testing {

// A folder of one test, removed at its end.
class ConvertTest : public ::testing::Test {
 protected:
  ConvertTest() { std::filesystem::create_directories(folder_); }
  ~ConvertTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  std::string Text(const std::string& name) const { return ReadFile(folder_ / name); }

  // What is said of bad input, without the folder; "" if it is taken.
  template <typename Action>
  std::string Message(Action action) const {
    try {
      action();
    } catch (const InputError& e) {
      std::string text = e.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) {
        text.erase(at, prefix.size());
      }
      return text;
    }
    return "";
  }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  ("ridgeline_convert_" + std::to_string(::getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace ridgeline::testing
