// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "base/atomic_file.h"
#include "base/options.h"
#include "localize/localizer_options.h"
#include "support/source_folder.h"

namespace ridgeline {
namespace {

const std::filesystem::path kConfigs = std::filesystem::path(kSourceFolder) / "configs";

TEST(Configs, DefaultIsADumpOfTheDefaults) {
  LocalizerOptions options;
  EXPECT_EQ(ReadFile(kConfigs / "default.json"),
            OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }));
}

TEST(Configs, ThoseOfTheLocalizerAreReadAndValid) {
  for (const char* name :
       {"default.json", "drone.json", "egenioussbench.json", "paper.json", "skyline.json"}) {
    LocalizerOptions options;
    OptionsFromJson(ReadFile(kConfigs / name), name, [&](OptionVisitor& v) { options.Visit(v); });
    EXPECT_NO_THROW(options.Validate()) << name;
  }
}

}  // namespace
}  // namespace ridgeline
