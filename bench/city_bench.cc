// SPDX-License-Identifier: Apache-2.0
// Speed of loading a model. RIDGELINE_BENCH_CITY names the file; without it a town of boxes is
// written to the temporary folder.
#include <benchmark/benchmark.h>
#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "city/city_text.h"
#include "city/format/formats.h"
#include "city/read_city.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

class SilentLogger final : public citygml::CityGMLLogger {
 public:
  void log(LOGLEVEL, const std::string&, const char*, int) const override {}
};

const fs::path& ModelFile() {
  static const fs::path file = [] {
    const char* const named = std::getenv("RIDGELINE_BENCH_CITY");
    if (named != nullptr) return fs::path(named);
    std::string members;
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d low =
          testing::kCorner + Eigen::Vector3d(10.0 * (i % 64), 15.0 * (i / 64), 0.0);
      members +=
          testing::GmlBox("b" + std::to_string(i), low, low + Eigen::Vector3d(10, 10, 6 + i % 5));
    }
    const fs::path path = fs::temp_directory_path() / "ridgeline_bench_town.gml";
    std::ofstream(path) << testing::GmlDocument(members);
    return path;
  }();
  return file;
}

void SetBytes(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(fs::file_size(ModelFile())));
}

// Parsing alone, links followed.
void BM_ReadModelFile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ReadModelFile(ModelFile()));
  SetBytes(state);
}
BENCHMARK(BM_ReadSource)->Unit(benchmark::kMillisecond);

// From the file to the mesh with its feature edges.
void BM_ReadCity(benchmark::State& state) {
  CityOptions options;
  options.threads = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ReadCity({ModelFile()}, options));
  SetBytes(state);
}
BENCHMARK(BM_ReadCity)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Libcitygml(benchmark::State& state) {
  const auto logger = std::make_shared<SilentLogger>();
  for (auto _ : state) {
    benchmark::DoNotOptimize(citygml::load(ModelFile().string(), citygml::ParserParams(), logger));
  }
  SetBytes(state);
}
BENCHMARK(BM_Libcitygml)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ridgeline
