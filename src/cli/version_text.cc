// SPDX-License-Identifier: Apache-2.0
// Apart from version.cc, since it is compiled again after every commit.
#include "cli/version_text.h"

#include "generated/ridgeline_revision.h"

namespace ridgeline {

std::string VersionNumber() { return RIDGELINE_VERSION RIDGELINE_REVISION; }

std::string VersionText() { return "ridgeline " + VersionNumber(); }

}  // namespace ridgeline
