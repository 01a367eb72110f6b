// SPDX-License-Identifier: Apache-2.0
#include "city/format/openable.h"

#include <cpl_vsi.h>

#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/regular_file.h"

namespace ridgeline {
namespace {

// One level of an archive on this machine; chains of virtual files could lead anywhere.
bool IsInArchive(const std::string& file) {
  const bool archive =
      file.starts_with("/vsizip/") || file.starts_with("/vsitar/") || file.starts_with("/vsigzip/");
  return archive && file.find("/vsi", 1) == std::string::npos;
}

// Names that GDAL would take for a server, a database, a subset or a document of its own.
bool IsOfGdal(const std::string& file) {
  std::error_code error;
  return file.starts_with("/vsi") || file.starts_with("<") ||
         (!std::filesystem::exists(file, error) && file.find(':') != std::string::npos);
}

}  // namespace

void RequireOpenable(const std::string& file, const std::string& expected, bool folders) {
  if (IsInArchive(file)) {
    VSIStatBufL stat;
    if (VSIStatExL(file.c_str(), &stat, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) != 0 ||
        !(VSI_ISREG(stat.st_mode) || (folders && VSI_ISDIR(stat.st_mode)))) {
      throw InputError(file, "", "no such file in the archive", expected);
    }
    return;
  }
  std::error_code error;
  if (folders && std::filesystem::is_directory(file, error)) return;
  if (IsOfGdal(file)) {
    throw InputError(
        file, "", "a name that is no file on this machine", expected + ", or an http(s) address");
  }
  RequireRegularFile(file, expected);
}

}  // namespace ridgeline
