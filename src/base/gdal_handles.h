// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>

#include <memory>

namespace ridgeline {

struct GdalDatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using GdalDatasetPtr = std::unique_ptr<GDALDataset, GdalDatasetCloser>;

// Keeps GDAL from writing to stderr on this thread while it lives: its messages come back as errors
// of ours, which say which file and what to do.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

}  // namespace ridgeline
