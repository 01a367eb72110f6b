// SPDX-License-Identifier: Apache-2.0
#include "city/vrt_sources.h"

#include <cpl_minixml.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct NodeDeleter {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

// As GDAL tells them.
bool IsVrt(const fs::path& file) {
  std::array<char, 1024> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  const std::string_view text(head.data(), static_cast<std::size_t>(stream.gcount()));
  return text.find("<VRTDataset") != std::string_view::npos;
}

void Check(const std::string& vrt, const fs::path& file, int depth);

void CheckSource(const std::string& vrt, const fs::path& file, const CPLXMLNode* node, int depth) {
  fs::path source = CPLGetXMLValue(node, nullptr, "");
  const bool relative = std::string_view(CPLGetXMLValue(node, "relativeToVRT", "0")) != "0";
  if (relative) source = file.parent_path() / source;
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (fs::is_regular_file(status)) {
    Check(vrt, source, depth + 1);
  } else if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(
        vrt, "SourceFilename", "the pipe or device " + source.string(), "rasters in regular files");
  }
}

void Walk(const std::string& vrt, const fs::path& file, const CPLXMLNode* node, int depth) {
  for (; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    if (std::string_view(node->pszValue) == "SourceFilename") {
      CheckSource(vrt, file, node, depth);
    } else {
      Walk(vrt, file, node->psChild, depth);
    }
  }
}

void Check(const std::string& vrt, const fs::path& file, int depth) {
  if (depth > limits::kLinkDepth || !IsVrt(file)) return;
  const std::unique_ptr<CPLXMLNode, NodeDeleter> root(CPLParseXMLFile(file.c_str()));
  Walk(vrt, file, root.get(), depth);
}

}  // namespace

void CheckVrtSources(const std::string& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) Check(file, file, 0);
}

}  // namespace ridgeline
