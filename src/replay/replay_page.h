// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ridgeline {

// A page of headings, words, tables and pictures that opens offline, with its tables as CSV and its
// pictures as PNG beside it. Built in memory; WriteTo() writes all of it.
class ReplayPage {
 public:
  // @param title  Of the page.
  // @param facts  Below it, "name: value" (data, command, version).
  ReplayPage(std::string title, const std::vector<std::pair<std::string, std::string>>& facts);

  void Heading(const std::string& text);
  void Text(const std::string& text);

  // @param file  Name of its CSV, e.g. "table1.csv".
  // @param marked  Rows that are the paper's own, drawn apart.
  void Table(const std::string& file,
             const std::string& caption,
             const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows,
             const std::vector<std::size_t>& marked = {});

  // @param file  Name of its PNG, e.g. "fig5.png".
  void Picture(const std::string& file, const std::string& caption, const cv::Mat& picture);

  // A file beside the page that the page does not show, with a link.
  void File(const std::string& file, const std::string& caption, const std::string& content);

  // index.html and the rest into an existing folder. Throws InputError if it cannot be written.
  void WriteTo(const std::filesystem::path& folder) const;

 private:
  std::string title_;
  std::string body_;
  std::vector<std::pair<std::string, std::string>> files_;  // name, content
};

// Rows as CSV text.
std::string CsvText(const std::vector<std::string>& header,
                    const std::vector<std::vector<std::string>>& rows);

// A number with digits after the point; "–" for what is not finite.
std::string TableNumber(double value, int digits);

// Pictures side by side, all scaled to one height.
cv::Mat SideBySide(const std::vector<cv::Mat>& pictures, int height_px);

}  // namespace ridgeline
