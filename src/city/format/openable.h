// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// Throws InputError unless GDAL may open a name: a regular file (or a folder, with `folders`) on this
// machine, or one in an archive on it (/vsizip/, /vsitar/, /vsigzip/). GDAL itself would also talk
// to servers and data bases, and wait for pipes.
void RequireOpenable(const std::string& file, const std::string& expected, bool folders);

}  // namespace ridgeline
