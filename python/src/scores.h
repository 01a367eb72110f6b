// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "localizer.h"
#include "score/picture_evidence.h"

namespace ridgeline::python {

// A picture prepared to be compared, with the localizer whose options say how.
struct OwnedPicture {
  std::shared_ptr<const OwnedLocalizer> owner;
  PictureEvidence evidence;
};

// What Python holds.
struct SharedPicture {
  std::shared_ptr<const OwnedPicture> owned;
};

}  // namespace ridgeline::python
