// SPDX-License-Identifier: Apache-2.0
#include "input/query_request.h"

#include <filesystem>
#include <optional>

#include "base/error.h"
#include "city/crs.h"

namespace ridgeline {

void SetCrs(const std::string& text, Dataset& dataset) {
  if (text.empty()) return;
  const std::optional<Crs> crs = ParseCrs(text);
  if (!crs) throw InputError("--crs", "", "\"" + text + "\"", "a system such as EPSG:25832");
  const std::optional<Crs> own = ParseCrs(dataset.crs);
  if (own && own->horizontal_epsg != crs->horizontal_epsg) {
    throw InputError("--crs",
                     "",
                     "\"" + text + "\"",
                     dataset.crs + ", in which " + dataset.file.string() + " gives its positions");
  }
  dataset.crs = text;
}

Dataset ReadQuery(const QueryArguments& arguments) {
  Dataset dataset;
  Query query;
  if (!arguments.dataset.empty()) {
    dataset = ReadDataset(arguments.dataset);
    query = dataset.queries[FindQuery(dataset, arguments.query, "--query")];
  } else {
    if (!arguments.query.empty()) {
      throw InputError("--query", "", "an id without a dataset", "--dataset FILE");
    }
    query.id = std::filesystem::path(arguments.image).stem().string();
    dataset.file = arguments.image;
    dataset.name = query.id;
  }
  if (!arguments.image.empty()) query.image = arguments.image;
  if (!arguments.camera.empty()) query.camera = ReadCamera(arguments.camera);
  if (!arguments.model.empty()) {
    dataset.model.assign(arguments.model.begin(), arguments.model.end());
  }
  if (dataset.model.empty()) {
    throw InputError("--model", "", "nothing", "a city model, or --dataset with --query");
  }
  if (!arguments.dtm.empty()) dataset.dtm = arguments.dtm;
  SetCrs(arguments.crs, dataset);
  dataset.queries = {query};
  return dataset;
}

}  // namespace ridgeline
