// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/overlay.h"

namespace ridgeline {

// What the HTML report shows. Plain data: localize, bench, study and skyline fill in what they
// have; what is absent is not shown.

struct ReportPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // east, north, height in the CRS [m]
  double heading_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  bool has_heading = true;  // false: nothing is known of it
  bool has_height = true;   // false: assumed
  bool has_tilt = true;     // false: pitch and roll are assumed
};

struct ReportMode {
  ReportPose pose;
  double energy = 1.0;
};

// Energy over positions; row-major from south to north, NaN where not admissible.
struct ReportEnergyMap {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // east, north of value (0, 0) [m]
  double spacing_m = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<float> energies;
};

// Hillshade under the map.
struct ReportHillshade {
  cv::Mat shade;                                    // 8-bit grey, first row in the north
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();  // outer corners, CRS [m]
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
};

// A plot of points or lines, e.g. of a score study.
struct ReportSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::string> labels;  // per point; may be empty
  bool line = false;
};
struct ReportPlot {
  std::string title;
  std::string note;  // one sentence below the title: how to read it
  std::string x_label;
  std::string y_label;
  bool x_log = false;
  bool y_log = false;
  std::vector<std::string> x_names;  // of x = 0, 1, 2, ...; empty: numbers
  std::vector<ReportSeries> series;
};

enum class ReportOutcome { kRight, kWrong, kAbstained, kUnknown };  // kUnknown: without truth

// One query localized once.
struct ReportRun {
  std::string id;
  std::string set;  // may be empty
  int seed = 0;
  int photo = -1;      // index into ReportData::photos; -1: none
  std::string status;  // "ok", "ambiguous", ...
  std::string reason;  // of an abstention, in words
  std::string headline;  // what was found, in a sentence; empty: nothing to say
  std::optional<Eigen::Vector2d> latitude_longitude;  // of the result, WGS 84 [deg]
  ReportOutcome outcome = ReportOutcome::kUnknown;
  double energy = 1.0;
  double confidence = 0.0;              // NaN: none, as in a score study
  std::optional<double> translation_m;  // errors against the truth
  std::optional<double> rotation_deg;
  std::optional<ReportPose> prior;
  std::optional<ReportPose> result;
  std::optional<ReportPose> truth;
  std::vector<ReportMode> modes;
  std::optional<Eigen::Matrix2d> position_covariance;  // of the result, east and north [m^2]
  std::optional<ReportEnergyMap> map;
  std::optional<ReportHillshade> hillshade;
  std::vector<std::vector<Eigen::Vector2d>> footprints;  // near the map, CRS [m]
  std::vector<Eigen::Vector2d> search_box;               // outline, CRS [m]
  std::vector<OverlayLayer> prior_layers;                // lines over the photo [px of the photo]
  std::vector<OverlayLayer> result_layers;
  std::vector<ReportPlot> plots;    // of this run alone
  std::vector<double> best_energy;  // after each evaluation, or at even steps; may be empty
  double hfov_deg = 0.0;            // horizontal field of view; 0: not known
  double evaluations = 0.0;
  double seconds = 0.0;
  std::vector<std::pair<std::string, std::string>> facts;  // more rows for the table of the run
};

struct ReportPhoto {
  std::string name;  // for people, e.g. the file's name
  cv::Mat picture;   // undistorted, 8-bit; may be smaller than the photo
  int width = 0;     // of the photo, in which layers are given [px]; 0: those of the picture
  int height = 0;
};

struct ReportTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct ReportData {
  std::string title;    // e.g. "Bench of munich-arcisstrasse"
  std::string command;  // how to make it again
  std::string version;
  std::string crs;  // of all positions; may be empty
  // What the runs of outcome kRight are: "17 of 24 ...".
  std::string right_text = "within 2 m and 2°";
  bool is_study = false;   // of maps, not of localizations: figures and plots are its own
  // Of a comparison: the systems whose poses stand in the places of prior and result.
  std::optional<std::array<std::string, 2>> pair_names;
  bool has_recall = true;  // false: no right answer was in the search box, so none is counted
  std::vector<std::pair<std::string, std::string>> facts;  // big figures: name, value
  std::vector<ReportPhoto> photos;
  int lead = -1;  // index of the photo that stands before all else; -1: none
  std::vector<ReportRun> runs;
  std::vector<ReportPlot> plots;
  std::vector<ReportTable> tables;
  std::vector<std::string> warnings;
  std::string options_json;  // the resolved configuration; may be empty
};

}  // namespace ridgeline
