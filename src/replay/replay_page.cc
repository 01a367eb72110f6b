// SPDX-License-Identifier: Apache-2.0
#include "replay/replay_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "eval/csv_text.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

constexpr int kWidestPx = 1800;
constexpr char kStyle[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:1240px;margin:2rem auto;padding:0 1rem;"
    "color:#1b1f24;background:#fff}h1{font-size:1.6rem}h2{font-size:1.25rem;margin-top:2.2rem;"
    "border-top:1px solid #d0d7de;padding-top:1rem}table{border-collapse:collapse;font-size:.88rem;"
    "margin:.6rem 0}td,th{padding:.25rem .5rem;border-bottom:1px solid #d0d7de;text-align:right}"
    "td:first-child,th:first-child{text-align:left}td{white-space:nowrap}"
    "tr.paper td{background:#fff3d6}"
    "figure{margin:1rem 0}img{max-width:100%;height:auto;border:1px solid #d0d7de}"
    "figcaption,.facts{color:#57606a;font-size:.88rem}.scroll{overflow-x:auto}"
    "code{background:#f3f4f6;padding:.1rem .3rem}";

std::string Png(const cv::Mat& picture) {
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

ReplayPage::ReplayPage(std::string title,
                       const std::vector<std::pair<std::string, std::string>>& facts)
    : title_(std::move(title)) {
  body_ = "<h1>" + EscapeMarkup(title_) + "</h1>\n<p class=\"facts\">";
  for (const auto& [name, value] : facts) {
    body_ += EscapeMarkup(name) + ": <code>" + EscapeMarkup(value) + "</code><br>\n";
  }
  body_ += "</p>\n";
}

void ReplayPage::Heading(const std::string& text) {
  body_ += "<h2>" + EscapeMarkup(text) + "</h2>\n";
}

void ReplayPage::Text(const std::string& text) { body_ += "<p>" + EscapeMarkup(text) + "</p>\n"; }

void ReplayPage::Table(const std::string& file,
                       const std::string& caption,
                       const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& marked) {
  body_ += "<div class=\"scroll\"><table>\n<tr>";
  for (const std::string& cell : header) body_ += "<th>" + EscapeMarkup(cell) + "</th>";
  body_ += "</tr>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool is_marked = std::find(marked.begin(), marked.end(), r) != marked.end();
    body_ += is_marked ? "<tr class=\"paper\">" : "<tr>";
    for (const std::string& cell : rows[r]) body_ += "<td>" + EscapeMarkup(cell) + "</td>";
    body_ += "</tr>\n";
  }
  body_ += "</table></div>\n<p class=\"facts\">" + EscapeMarkup(caption) + " <a href=\"" +
           EscapeMarkup(file) + "\">" + EscapeMarkup(file) + "</a></p>\n";
  files_.emplace_back(file, CsvText(header, rows));
}

void ReplayPage::Picture(const std::string& file,
                         const std::string& caption,
                         const cv::Mat& picture) {
  body_ += "<figure><img alt=\"" + EscapeMarkup(caption) + "\" src=\"" +
           JpegDataUrl(picture, kWidestPx, 92) + "\"><figcaption>" + EscapeMarkup(caption) +
           "</figcaption></figure>\n";
  files_.emplace_back(file, Png(picture));
}

void ReplayPage::File(const std::string& file,
                      const std::string& caption,
                      const std::string& content) {
  body_ += "<p class=\"facts\">" + EscapeMarkup(caption) + " <a href=\"" + EscapeMarkup(file) +
           "\">" + EscapeMarkup(file) + "</a></p>\n";
  files_.emplace_back(file, content);
}

void ReplayPage::WriteTo(const std::filesystem::path& folder) const {
  for (const auto& [name, content] : files_) WriteFileAtomically(folder / name, content);
  WriteFileAtomically(
      folder / "index.html",
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\">\n<title>" +
          EscapeMarkup(title_) + "</title><style>" + kStyle + "</style></head>\n<body>\n" + body_ +
          "</body></html>\n");
}

std::string CsvText(const std::vector<std::string>& header,
                    const std::vector<std::vector<std::string>>& rows) {
  std::string csv;
  const auto add = [&](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      csv += (i == 0 ? "" : ",") + CsvField(fields[i]);
    }
    csv += '\n';
  };
  add(header);
  for (const std::vector<std::string>& row : rows) add(row);
  return csv;
}

std::string TableNumber(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

cv::Mat SideBySide(const std::vector<cv::Mat>& pictures, int height_px) {
  constexpr int kGapPx = 8;
  int width = -kGapPx;
  std::vector<cv::Mat> scaled;
  for (const cv::Mat& picture : pictures) {
    cv::Mat one;
    const double scale = static_cast<double>(height_px) / picture.rows;
    cv::resize(picture,
               one,
               cv::Size(std::max(1, static_cast<int>(std::lround(picture.cols * scale))), height_px),
               0.0,
               0.0,
               scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    if (one.channels() == 1) cv::cvtColor(one, one, cv::COLOR_GRAY2BGR);
    width += one.cols + kGapPx;
    scaled.push_back(one);
  }
  cv::Mat row(height_px, std::max(1, width), CV_8UC3, cv::Scalar(255, 255, 255));
  int x = 0;
  for (const cv::Mat& one : scaled) {
    one.copyTo(row(cv::Rect(x, 0, one.cols, one.rows)));
    x += one.cols + kGapPx;
  }
  return row;
}

}  // namespace ridgeline
