// SPDX-License-Identifier: Apache-2.0
#include "eval/results_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "base/error.h"
#include "base/text_file.h"
#include "eval/csv_text.h"

namespace ridgeline {
namespace {

constexpr std::array kColumns = {"query",      "seed",       "status",     "energy",
                                 "confidence", "e",          "n",          "h",
                                 "qw",         "qx",         "qy",         "qz",
                                 "t_err_m",    "r_err_deg",  "t_err_horizontal_m",
                                 "evaluations", "seconds"};

// One row with its names.
class Row {
 public:
  Row(const std::filesystem::path& path,
      int line,
      const std::map<std::string, std::size_t>& columns,
      std::vector<std::string> fields)
      : path_(path), line_(line), columns_(columns), fields_(std::move(fields)) {}

  const std::string& Text(const char* column) const {
    static const std::string none;
    const std::size_t at = columns_.at(column);
    return at < fields_.size() ? fields_[at] : none;
  }
  bool Has(const char* column) const { return !Text(column).empty(); }
  // NaN for a blank.
  double Number(const char* column) const {
    const std::string& text = Text(column);
    if (text.empty()) return NAN;
    double value = NAN;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
    throw InputError(path_.string(),
                     "line " + std::to_string(line_),
                     "\"" + text + "\"",
                     std::string("a number for ") + column);
  }

 private:
  const std::filesystem::path& path_;
  int line_;
  const std::map<std::string, std::size_t>& columns_;
  std::vector<std::string> fields_;
};

RunRecord RecordOf(const Row& row) {
  RunRecord record;
  record.query = row.Text("query");
  record.seed = row.Has("seed") ? static_cast<int>(row.Number("seed")) : 1;
  record.status = row.Text("status");
  record.energy = row.Number("energy");
  record.confidence = row.Number("confidence");
  if (row.Has("e")) {
    record.pose = Pose{Eigen::Quaterniond(
                           row.Number("qw"), row.Number("qx"), row.Number("qy"), row.Number("qz"))
                           .normalized(),
                       {row.Number("e"), row.Number("n"), row.Number("h")}};
  }
  if (row.Has("t_err_m")) {
    record.error = PoseError{
        row.Number("t_err_m"), row.Number("t_err_horizontal_m"), row.Number("r_err_deg")};
    record.has_truth = true;
  }
  record.is_searched = row.Has("seconds");
  record.seconds = row.Number("seconds");
  record.evaluations =
      row.Has("evaluations") ? static_cast<std::uint64_t>(row.Number("evaluations")) : 0;
  return record;
}

}  // namespace

std::vector<RunRecord> ReadResultsCsv(const std::filesystem::path& path) {
  std::istringstream stream(ReadText(path));
  std::map<std::string, std::size_t> columns;
  std::vector<std::string> header;
  ReadCsvRow(stream, header);
  for (std::size_t i = 0; i < header.size(); ++i) columns[header[i]] = i;
  for (const char* column : kColumns) {
    if (columns.contains(column)) continue;
    throw InputError(path.string(),
                     "line 1",
                     std::string("no column \"") + column + "\"",
                     "a results.csv of ridgeline bench");
  }
  std::vector<RunRecord> records;
  std::vector<std::string> fields;
  for (int line = 2; ReadCsvRow(stream, fields); ++line) {
    if (fields.size() == 1 && fields[0].empty()) continue;
    records.push_back(RecordOf(Row(path, line, columns, fields)));
  }
  if (records.empty()) throw InputError(path.string(), "", "no run", "one row per run");
  return records;
}

}  // namespace ridgeline
