// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.h"

#include <string_view>

#include "base/atomic_file.h"
#include "report/picture_file.h"
#include "report/report_json.h"
#include "report/web_files.h"

namespace ridgeline {
namespace {

// Longest side of the photos, so that all of them stay below some 40 MB.
int PhotoSide(std::size_t photos) {
  if (photos <= 60) return 1400;
  if (photos <= 250) return 900;
  return 560;
}

void AddJson(const std::string& id, const std::string& json, std::string& page) {
  page += "<script type=\"application/json\" id=\"" + id + "\">" + json + "</script>\n";
}

// The end tag must not occur in an embedded script.
void AddScript(std::string_view script, std::string& page) {
  page += "<script>\n";
  std::size_t from = 0;
  for (std::size_t at = script.find("</script"); at != std::string_view::npos;
       at = script.find("</script", from)) {
    page += script.substr(from, at - from);
    page += "<\\/script";
    from = at + std::string_view("</script").size();
  }
  page += script.substr(from);
  page += "\n</script>\n";
}

}  // namespace

bool ReportHasPlots() { return !web::kPlotly.empty(); }

std::string HtmlReport(const ReportData& data) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data: "
      "blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<title>" +
      EscapeMarkup(data.title) + "</title>\n<style>\n";
  page += web::kReportCss;
  page += "</style>\n</head>\n";
  page += web::kReportBody;
  AddJson("summary", SummaryJson(data), page);
  const int side = PhotoSide(data.photos.size());
  for (std::size_t i = 0; i < data.photos.size(); ++i) {
    AddJson("photo-" + std::to_string(i), PhotoJson(data.photos[i], side), page);
  }
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    AddJson("run-" + std::to_string(i), RunDetailJson(data.runs[i]), page);
  }
  if (ReportHasPlots()) {
    page += "<!-- Plotly.js, its licence:\n";
    page += web::kPlotlyLicense;
    page += "-->\n";
    AddScript(web::kPlotly, page);
  }
  AddScript(web::kReportPlotsJs, page);
  AddScript(web::kReportDetailJs, page);
  AddScript(web::kReportJs, page);
  page += "</body>\n</html>\n";
  return page;
}

void WriteHtmlReport(const ReportData& data, const std::filesystem::path& path) {
  WriteFileAtomically(path, HtmlReport(data));
}

}  // namespace ridgeline
