// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "input/dataset.h"

namespace ridgeline {

// A picture in a model, named on the command line: a query of a dataset, or its parts one by one,
// which go before the dataset's.
struct QueryArguments {
  std::string dataset;
  std::string query;
  std::vector<std::string> model;
  std::string dtm;
  std::string crs;
  std::string image;
  std::string camera;
};

// Makes --crs the system of a dataset's positions; "" leaves it. Throws InputError for what is no
// system and for one other than the dataset's own.
void SetCrs(const std::string& crs, Dataset& dataset);

// A dataset of that one query. Throws InputError for --query without --dataset, and without a
// model.
Dataset ReadQuery(const QueryArguments& arguments);

}  // namespace ridgeline
