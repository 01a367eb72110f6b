// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ridgeline {

// A path beside `path`, with the same extension, to be written (a file or a folder) and then given to
// CommitFile. Unique to this process. Throws InputError if the folder does not exist or cannot be
// written.
std::filesystem::path TemporaryBeside(const std::filesystem::path& path);

// Moves a finished temporary file to its place in one step. Throws InputError on failure.
void CommitFile(const std::filesystem::path& temporary, const std::filesystem::path& path);

// Removes all temporaries that were not committed yet: after an interrupt or a failure. Thread-safe.
void RemoveTemporaries() noexcept;

// Writes a whole file or none: temporary file, flush, rename. Throws InputError on failure.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

// The same for files that belong together, as path and content: none is put in its place before all
// are written. Throws InputError on failure.
void WriteFilesAtomically(
    const std::vector<std::pair<std::filesystem::path, std::string>>& files);

// Whole content of a file. Throws InputError if it cannot be read.
std::string ReadFile(const std::filesystem::path& path);

}  // namespace ridgeline
