// SPDX-License-Identifier: Apache-2.0
#include "cli/study_output.h"

#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/file_name.h"
#include "report/map_files.h"
#include "report/picture_file.h"
#include "report/study_pictures.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

fs::path MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--out", "", folder.string() + ": " + error.message(), "a folder");
  return folder;
}

// As pixels and as SVG; `stem` is a path without extension.
void WriteDrawing(const Drawing& drawing, const fs::path& stem) {
  WritePicture(drawing.Picture(), stem.string() + ".png");
  WriteFileAtomically(stem.string() + ".svg", drawing.Svg());
}

void WriteGeoTiff(const EnergyMap& map, int epsg, const fs::path& path) {
  WriteEnergyMap({map.first, map.spacing_m, map.columns, map.rows, map.energies}, epsg, path);
}

}  // namespace

void WriteStudy(const StudyResults& results, int epsg, const fs::path& folder) {
  const StudyNames& names = results.names;
  WriteFileAtomically(folder / "summary.csv", SummaryCsv(results.protocol, results.summaries));
  WriteFileAtomically(folder / "figures.csv", FiguresCsv(names, results.studies));
  WriteFileAtomically(folder / "headings.csv", HeadingsCsv(names, results.studies));
  WriteFileAtomically(folder / "profiles.csv", ProfilesCsv(names, results.studies));
  WriteFileAtomically(folder / "sampled.csv", SampledCsv(names, results.studies));

  const fs::path maps = MakeFolder(folder / "maps");
  const bool explored = results.options.explore;
  const fs::path exploration = explored ? MakeFolder(folder / "explored") : fs::path();
  for (const ScoreStudy& study : results.studies) {
    const ScoreChoice& score = names.scores[study.score];
    const std::string name = FileNameOf(names.dataset.queries[study.query].id + "_" + score.name);
    WriteFileAtomically(maps / (name + ".csv"), MapCsv(study.map));
    WriteGeoTiff(study.map, epsg, maps / (name + ".tif"));
    WriteDrawing(MapPicture(names, study), maps / name);
    if (!explored) continue;
    WriteFileAtomically(exploration / (name + ".csv"), ExploredCsv(*study.explored, score));
    WriteGeoTiff(study.explored->map, epsg, exploration / (name + ".tif"));
    WriteDrawing(ExploredPicture(names, study), exploration / name);
  }
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    WriteDrawing(ScatterPicture(names, results.studies, s, results.options.classes),
                 folder / FileNameOf("score_against_error_" + names.scores[s].name));
  }
  if (results.varied.empty()) return;
  WriteFileAtomically(folder / "sensitivity.csv", SensitivityCsv(names, results.varied));
  WriteFileAtomically(folder / "sensitivity_summary.csv",
                      SensitivitySummaryCsv(names, results.levels));
  for (std::size_t v = 0; v < names.variations.size(); ++v) {
    WriteDrawing(SensitivityPicture(names, results.levels, v),
                 folder / ("sensitivity_" + names.variations[v].name));
  }
}

}  // namespace ridgeline
