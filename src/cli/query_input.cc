// SPDX-License-Identifier: Apache-2.0
#include "cli/query_input.h"

namespace ridgeline {

void AddQueryOptions(CLI::App& command, QueryArguments& arguments) {
  command.add_option(
      "--dataset", arguments.dataset, "Take picture, camera, model and prior from a dataset");
  command.add_option("--query", arguments.query, "Id of the query in --dataset");
  command.add_option("--model", arguments.model, "City model: files or folders")->type_name("PATH");
  command.add_option("--dtm", arguments.dtm, "Terrain model (any GDAL raster)");
  command.add_option(
      "--crs", arguments.crs, "Projected system of prior and poses, e.g. EPSG:25832");
  command.add_option("--camera",
                     arguments.camera,
                     "Camera file (COLMAP model and parameters); else from the picture's EXIF");
}

}  // namespace ridgeline
