// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace ridgeline::testing {

// Every file of a folder of results by its name, without what is timing: the column `seconds`,
// seconds and rates of summary.json, times of kept runs. Reports, which show times, are left out.
std::map<std::string, std::string> Timeless(const std::filesystem::path& folder);

// Every file of a folder as it is.
std::map<std::string, std::string> Bytes(const std::filesystem::path& folder);

// Names of the files in which two folders differ, or that only one has; empty: none.
std::string Differences(const std::map<std::string, std::string>& a,
                        const std::map<std::string, std::string>& b);

// Starts the program and kills it (SIGKILL) after some milliseconds; true: it had ended by itself.
bool StartAndKill(const std::string& arguments, int after_ms);

}  // namespace ridgeline::testing
