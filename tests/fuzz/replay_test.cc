// SPDX-License-Identifier: Apache-2.0
// The corpora of the fuzz targets, once each and damaged in reproducible ways, without libFuzzer: a
// reader may refuse bytes with an InputError and must do nothing else. RIDGELINE_FUZZ_ROUNDS makes
// the damaged copies of a file more (scripts/fuzz.sh uses libFuzzer where clang is at hand).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "base/random.h"
#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "support/source_folder.h"

namespace ridgeline::fuzz {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

std::vector<fs::path> CorpusOf(const FuzzTarget& target) {
  std::vector<fs::path> files;
  const fs::path folder =
      fs::path(kSourceFolder) / "tests" / "fuzz" / "corpus" / target.name;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

int Rounds() {
  constexpr int kInSeconds = 60;
  const char* const text = std::getenv("RIDGELINE_FUZZ_ROUNDS");
  return text != nullptr ? std::atoi(text) : kInSeconds;
}

class Replay : public ::testing::TestWithParam<std::string_view> {
 protected:
  // The bytes of a finding are kept for whoever looks at it, also where the program ends.
  void Run(const FuzzTarget& target, const Bytes& bytes, const std::string& origin) {
    const fs::path kept =
        fs::path(::testing::TempDir()) / ("ridgeline_finding_" + std::string(target.name));
    std::ofstream(kept, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    try {
      target.run(bytes);
    } catch (const std::exception& e) {
      FAIL() << origin << ": " << e.what() << " (" << kept << ")";
    }
    fs::remove(kept);
  }
};

TEST_P(Replay, RefusesOrReads) {
  const FuzzTarget* const target = FindFuzzTarget(GetParam());
  ASSERT_NE(target, nullptr);
  const std::vector<fs::path> files = CorpusOf(*target);
  ASSERT_FALSE(files.empty());
  std::vector<Bytes> corpus;
  for (const fs::path& file : files) {
    const std::string text = ReadFile(file);
    corpus.emplace_back(text.begin(), text.end());
    Run(*target, corpus.back(), file.filename().string());
    if (HasFatalFailure()) return;
  }
  std::mt19937_64 random(HashText(target->name));
  for (std::size_t i = 0; i < corpus.size(); ++i) {
    for (int round = 0; round < Rounds(); ++round) {
      const Bytes& other = corpus[random() % corpus.size()];
      const std::string origin =
          files[i].filename().string() + ", damaged for the " + std::to_string(round) + ". time";
      Run(*target, Mutated(corpus[i], other, random), origin);
      if (HasFatalFailure()) return;
    }
  }
}

std::vector<std::string_view> Names() {
  std::vector<std::string_view> names;
  for (const FuzzTarget& target : FuzzTargets()) names.push_back(target.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, ::testing::ValuesIn(Names()), [](const auto& param_info) {
  return std::string(param_info.param);
});

}  // namespace
}  // namespace ridgeline::fuzz
