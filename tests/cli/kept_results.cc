// SPDX-License-Identifier: Apache-2.0
#include "cli/kept_results.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "base/atomic_file.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void DropTimes(Json& json) {
  for (const char* key : {"seconds", "seconds_per_query", "pose_evaluations_per_second", "times"}) {
    if (json.is_object()) json.erase(key);
  }
  if (!json.is_structured()) return;
  for (Json& value : json) DropTimes(value);
}

// Without a column of seconds.
std::string DropSeconds(const std::string& csv) {
  std::istringstream lines(csv);
  std::string kept;
  std::size_t column = std::string::npos;
  for (std::string line; std::getline(lines, line);) {
    bool is_quoted = false;
    for (char& c : line) {
      if (c == '"') is_quoted = !is_quoted;
      if (c == ',' && is_quoted) c = ';';
    }
    std::vector<std::string> fields;
    std::istringstream stream(line + ",");
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    for (std::size_t i = 0; kept.empty() && i < fields.size(); ++i) {
      if (fields[i].starts_with("seconds")) column = i;
    }
    if (column < fields.size()) fields.erase(fields.begin() + static_cast<long>(column));
    for (const std::string& field : fields) kept += field + ",";
    kept += "\n";
  }
  return kept;
}

}  // namespace

std::map<std::string, std::string> Bytes(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).string()] = ReadFile(entry.path());
  }
  return files;
}

std::map<std::string, std::string> Timeless(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (auto& [name, content] : Bytes(folder)) {
    const std::string extension = fs::path(name).extension();
    if (extension == ".html") continue;
    if (extension == ".json") {
      Json json = Json::parse(content);
      DropTimes(json);
      content = json.dump();
    }
    if (extension == ".csv") content = DropSeconds(content);
    files[name] = content;
  }
  return files;
}

std::string Differences(const std::map<std::string, std::string>& a,
                        const std::map<std::string, std::string>& b) {
  std::string names;
  for (const auto& [name, content] : a) {
    const auto it = b.find(name);
    if (it == b.end()) {
      names += "only in the first: " + name + "\n";
    } else if (it->second != content) {
      names += "differs: " + name + "\n";
    }
  }
  for (const auto& [name, content] : b) {
    if (!a.contains(name)) names += "only in the second: " + name + "\n";
  }
  return names;
}

bool StartAndKill(const std::string& arguments, int after_ms) {
  const std::string command =
      "exec " + std::string(RIDGELINE_PROGRAM) + " " + arguments + " >/dev/null 2>&1";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status);
}

}  // namespace ridgeline::testing
