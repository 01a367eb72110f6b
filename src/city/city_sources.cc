// SPDX-License-Identifier: Apache-2.0
#include "city/city_sources.h"

#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "city/format/formats.h"
#include "city/format/model_files.h"
#include "city/store/city_store.h"

namespace ridgeline {
namespace fs = std::filesystem;

CitySources ReadCitySources(const std::vector<fs::path>& paths, const CityOptions& options) {
  options.Validate();
  ModelFiles listed = ListModelFiles(paths, options.region);
  if (listed.files.empty()) throw InputError("--model", "", "no file", "one or more model files");
  std::vector<SourceModel> sources(listed.files.size());
  ParallelFor(sources.size(), options.threads, [&](std::size_t i) {
    const fs::path& file = listed.files[i];
    sources[i] = IsCityStore(file) ? ReadCityStore(file, options.region) : ReadModelFile(file);
  });
  return {ProjectSources(std::move(sources), options), std::move(listed.warnings)};
}

}  // namespace ridgeline
