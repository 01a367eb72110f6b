// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/example_report.h"
#include "report/report_json.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HtmlReport, TakesNothingFromDataAsMarkup) {
  const std::string page = HtmlReport(testing::ExampleReport(3));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>S")));
  EXPECT_THAT(page, HasSubstr("<title>Bench of &quot;Müller &amp; &lt;b&gt;Söhne&lt;/b&gt;&quot;"));
}

TEST(HtmlReport, LoadsNothingFromTheNetwork) {
  const std::string page = HtmlReport(testing::ExampleReport(3));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* load : {"<link", "src=\"http", "@import", "url(http"}) {
    EXPECT_THAT(page, Not(HasSubstr(load)));
  }
}

TEST(HtmlReport, KeepsTheLicenceOfThePlottingLibrary) {
  if (!ReportHasPlots()) GTEST_SKIP() << "this build has no plotting library (npm was missing)";
  EXPECT_THAT(HtmlReport(testing::ExampleReport(1)), HasSubstr("Permission is hereby granted"));
}

TEST(ReportJson, ReadsBackWithTheStrangestNames) {
  const ReportData data = testing::ExampleReport(8);
  const auto summary = nlohmann::json::parse(SummaryJson(data));
  ASSERT_EQ(summary["runs"].size(), 8u);
  EXPECT_EQ(summary["runs"][0]["id"], data.runs[0].id);
  EXPECT_EQ(summary["runs"][3]["outcome"], "wrong");
  EXPECT_EQ(summary["runs"][7]["outcome"], "abstained");
  EXPECT_TRUE(summary["runs"][7]["translation"].is_null());
}

TEST(ReportJson, ARunWithoutConfidenceHasNull) {
  ReportData data = testing::ExampleReport(2);
  data.runs[0].confidence = NAN;
  data.plots[0].x_names = {"a", "b"};
  data.runs[0].plots = data.plots;
  const auto summary = nlohmann::json::parse(SummaryJson(data));
  EXPECT_TRUE(summary["runs"][0]["confidence"].is_null());
  EXPECT_EQ(summary["plots"][0]["xNames"].size(), 2u);
  const auto detail = nlohmann::json::parse(RunDetailJson(data.runs[0]));
  EXPECT_EQ(detail["plots"][0]["xNames"][1], "b");
}

TEST(ReportJson, EnergiesKeepTheirPowersOfTen) {
  ReportData data = testing::ExampleReport(2);
  data.runs[0].energy = 1.23456789e-7;
  data.runs[1].energy = 0.0;
  data.runs[0].map->energies[20] = 2.5e-6f;
  data.plots[0].series[0].y[0] = 123456.0;
  const auto summary = nlohmann::json::parse(SummaryJson(data));
  EXPECT_DOUBLE_EQ(summary["runs"][0]["energy"].get<double>(), 1.2346e-7);
  EXPECT_EQ(summary["runs"][1]["energy"].get<double>(), 0.0);
  EXPECT_EQ(summary["plots"][0]["series"][0]["y"][0].get<double>(), 123456.0);
  const auto detail = nlohmann::json::parse(RunDetailJson(data.runs[0]));
  EXPECT_NEAR(detail["map"]["energies"][20].get<double>(), 2.5e-6, 1e-12);
}

TEST(ReportJson, SaysWhatOfAPriorIsAssumed) {
  ReportData data = testing::ExampleReport(1);
  data.runs[0].prior->has_height = false;
  const auto detail = nlohmann::json::parse(RunDetailJson(data.runs[0]));
  EXPECT_FALSE(detail["prior"]["hasHeight"].get<bool>());
  EXPECT_TRUE(detail["prior"]["hasTilt"].get<bool>());
}

TEST(ReportJson, APictureThatStandsFirstIsNoRun) {
  ReportData data = testing::ExampleReport(2);
  EXPECT_EQ(nlohmann::json::parse(SummaryJson(data))["lead"], -1);
  data.lead = 1;
  EXPECT_EQ(nlohmann::json::parse(SummaryJson(data))["lead"], 1);
}

TEST(ReportJson, BytesThatAreNotUtf8DoNotBreakIt) {
  ReportData data;
  data.title = "bad \xff name";
  EXPECT_NO_THROW(nlohmann::json::parse(SummaryJson(data)));
}

TEST(ReportJson, MapsAreRelativeToThePriorWithNullForNoPose) {
  const ReportData data = testing::ExampleReport(1);
  const auto detail = nlohmann::json::parse(RunDetailJson(data.runs[0]));
  EXPECT_NEAR(detail["origin"][0].get<double>(), data.runs[0].prior->position.x(), 1e-3);
  EXPECT_NEAR(detail["map"]["east"].get<double>(),
              data.runs[0].map->first.x() - data.runs[0].prior->position.x(),
              2e-3);
  EXPECT_TRUE(detail["map"]["energies"][0].is_null());
  EXPECT_FALSE(detail["map"]["energies"][20].is_null());
}

TEST(HtmlReport, AThousandQueriesStayBelowFortyMegabytes) {
  EXPECT_LT(HtmlReport(testing::ExampleReport(1000)).size(), 40u << 20);
}

}  // namespace
}  // namespace ridgeline
