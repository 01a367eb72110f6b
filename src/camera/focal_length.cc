// SPDX-License-Identifier: Apache-2.0
#include "camera/focal_length.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include "camera/facts_parts.h"
#include "camera/sensor_width.h"

namespace ridgeline {
namespace {

using Size = PictureFacts::Size;

constexpr double kFilmDiagonalMm = 43.266615305567875;  // of 36 x 24 mm
// The main cameras of phones since 2015 have 24 to 28 mm.
constexpr double kAssumed35mm = 26.0;
constexpr double kAssumedSigma = 15.0;
// Readings that differ by less say the same.
constexpr double kAgreement = 0.15;
// Widths of the sensors that cameras with a plane resolution have [mm].
constexpr double kNarrowestSensorMm = 4.0;
constexpr double kWidestSensorMm = 60.0;
// A compact camera's, 1/2.7" to 1/1.7".
constexpr double kCompactSensorMm = 6.2;

enum class Source { kCalibration, kEquivalent, kSensor, kPlane, kAssumption };

// One hypothesis with the trust in its source.
struct Reading {
  Source source;
  double trust;
  FocalHypothesis focal;
};

double Diagonal(const Size& size) { return std::hypot(size.width_px, size.height_px); }
double Longer(const Size& size) { return std::max(size.width_px, size.height_px); }
double Shorter(const Size& size) { return std::min(size.width_px, size.height_px); }

std::string Lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Relative standard deviations that come together [%].
double Joined(double a, double b) { return std::hypot(a, b); }

// Sizes that a picture had before it was turned, resized or cut: factors from a focal length at
// that size to the one at hand, the likelier first.
class Resizing {
 public:
  Resizing(const Size& before, const Size& now) : before_(before) {
    constexpr double kSameShape = 0.02;
    const double longer = Longer(now) / Longer(before);
    const double shorter = Shorter(now) / Shorter(before);
    const double factor = std::max(longer, shorter);
    factors_.push_back(factor);
    cut_ = std::abs(longer / shorter - 1.0) > kSameShape;
    if (cut_ && factor < 1.0 - kSameShape) factors_.push_back(1.0);  // cut out and not resized
  }
  const std::vector<double>& factors() const { return factors_; }
  bool cut() const { return cut_; }
  std::string Words() const {
    if (!cut_ && std::abs(factors_.front() - 1.0) < 1e-3) return "";
    return FormatText(" at %.0f x %.0f px, the picture since %s",
                      before_.width_px,
                      before_.height_px,
                      cut_ ? "cut to another shape" : "resized");
  }

 private:
  Size before_;
  std::vector<double> factors_;
  bool cut_ = false;
};

// Gathers the readings of a picture's facts.
class Readings {
 public:
  Readings(const PictureFacts& facts, const Size& size) : facts_(facts), size_(size) {
    focal_mm_ = facts.focal_mm;
    zoom_ = facts.zoom.value_or(1.0);
    sensor_mm_ = SensorWidthMm(facts.camera);
    AddCalibration();
    AddEquivalent();
    AddSensor();
    AddPlane();
  }

  std::vector<Reading> Take() { return std::move(readings_); }
  std::vector<std::string> TakeNotes() { return std::move(notes_); }

 private:
  // The recorded size, where it is told; of a width alone with the shape of the picture.
  Size Recorded() const {
    if (!facts_.recorded) return size_;
    const Size told = *facts_.recorded;
    if (told.height_px > 0.0) return told;
    return {told.width_px, told.width_px * size_.height_px / size_.width_px};
  }

  void Add(Source source, double trust, double focal_px, double sigma, std::string reason) {
    if (!IsPlausibleFocal(focal_px, size_.width_px, size_.height_px)) {
      notes_.push_back("focal length: " + reason +
                       FormatText(" gives %.4g px, a field of view of %.4g deg, which no camera "
                                  "here has; not used",
                                  focal_px,
                                  DiagonalViewDeg(focal_px, size_.width_px, size_.height_px)));
      return;
    }
    readings_.push_back({source, trust, {focal_px, sigma, std::move(reason)}});
  }

  // The same with a digital zoom that may be in it already.
  void AddZoomed(Source source,
                 double trust,
                 double focal_px,
                 double sigma,
                 const std::string& reason,
                 std::optional<bool> contained) {
    constexpr double kZoomSigma = 2.0;  // of a ratio that is rounded, and a crop to whole blocks
    if (zoom_ == 1.0) return Add(source, trust, focal_px, sigma, reason);
    const std::string with = reason + FormatText(", times the digital zoom %.3g", zoom_);
    const std::string without =
        reason + FormatText(", which contains the digital zoom %.3g", zoom_);
    if (!contained || !*contained) {
      Add(source, trust, focal_px * zoom_, Joined(sigma, kZoomSigma), with);
    }
    if (!contained || *contained) {
      Add(source, contained ? trust : 0.6 * trust, focal_px, sigma, without);
    }
    if (!contained) {
      notes_.push_back(
          FormatText("focal length: it is not known whether it contains the digital "
                     "zoom %.3g; both are possible",
                     zoom_));
    }
  }

  void AddCalibration() {
    if (!facts_.calibration) return;
    const double focal = facts_.calibration->focal;
    const Size own = facts_.calibration->size.value_or(Recorded());
    const bool told = facts_.calibration->size || facts_.recorded;
    if (!IsPlausibleFocal(focal, own.width_px, own.height_px)) {
      notes_.push_back(FormatText(
          "focal length: %.6g, calibrated by the maker, is no number of pixels; taken as mm",
          focal));
      if (!focal_mm_) focal_mm_ = focal;
      return;
    }
    const Resizing resizing(own, size_);
    const std::string reason =
        FormatText("%.1f px, calibrated by the maker%s", focal, resizing.Words().c_str());
    double trust = told ? 3.0 : 1.5;
    for (const double factor : resizing.factors()) {
      AddZoomed(Source::kCalibration, trust, focal * factor, 1.0, reason, std::nullopt);
      trust *= 0.5;
    }
  }

  // Whether the maker's 35 mm equivalents contain the digital zoom.
  std::optional<bool> EquivalentContainsZoom() const {
    const std::string make = Lower(facts_.make);
    if (make.starts_with("apple")) return true;
    if (make.starts_with("google") || make.starts_with("samsung")) return false;
    const std::string model = Lower(facts_.camera);
    if (model.starts_with("iphone") || model.starts_with("ipad")) return true;
    if (model.starts_with("pixel ") || model.starts_with("sm-")) return false;
    if (!sensor_mm_ || !focal_mm_ || zoom_ < 1.2) return std::nullopt;
    const double own = 36.0 / *sensor_mm_;  // the lens's without zoom
    const double told = *facts_.focal_35mm / *focal_mm_;
    return std::abs(std::log(told / own)) > std::abs(std::log(told / (own * zoom_)));
  }

  void AddEquivalent() {
    if (!facts_.focal_35mm) return;
    const double equivalent = *facts_.focal_35mm;
    // Rounding to whole millimetres, and lenses that differ from their names.
    const double sigma = Joined(2.0, 100.0 * 0.29 / equivalent);
    const std::string reason = FormatText("35 mm equivalent %.4g mm", equivalent);
    if (focal_mm_ && equivalent < 0.6 * *focal_mm_) {
      notes_.push_back(
          "focal length: " + reason +
          FormatText(" is less than the focal length itself, %.4g mm; not used", *focal_mm_));
      return;
    }
    const std::optional<bool> contained = EquivalentContainsZoom();
    const Size recorded = Recorded();
    const Resizing resizing(recorded, size_);
    double trust = 2.5;
    for (const double factor : resizing.factors()) {
      AddZoomed(Source::kEquivalent,
                trust,
                equivalent * Diagonal(recorded) / kFilmDiagonalMm * factor,
                sigma,
                reason + resizing.Words(),
                contained);
      trust *= 0.5;
    }
    // A picture of an unusual shape is cut out of a sensor of 4 : 3 by many cameras, whose
    // equivalent goes on to mean the whole sensor.
    const double aspect = Longer(recorded) / Shorter(recorded);
    if (aspect > 1.25 && aspect < 1.6) return;
    const double sensor = aspect >= 1.6 ? 1.25 * Longer(recorded) : 5.0 / 3.0 * Shorter(recorded);
    AddZoomed(Source::kEquivalent,
              1.0,
              equivalent * sensor / kFilmDiagonalMm * resizing.factors().front(),
              sigma,
              reason + " of a whole sensor of 4 : 3, out of which the picture is cut",
              contained.value_or(false));
  }

  void AddSensor() {
    if (!focal_mm_ || !sensor_mm_) return;
    const Size recorded = Recorded();
    const Resizing resizing(recorded, size_);
    AddZoomed(Source::kSensor,
              2.0,
              *focal_mm_ / *sensor_mm_ * Longer(recorded) * resizing.factors().front(),
              2.0,
              FormatText("focal length %.4g mm, sensor %.4g mm wide (%s)",
                         *focal_mm_,
                         *sensor_mm_,
                         facts_.camera.c_str()),
              false);
  }

  // Makers differ in whether the resolution is that of the zoomed picture (Canon's older ones are);
  // the width of the sensor that it means tells, where only one of the two can be.
  std::optional<bool> PlaneContainsZoom(double implied_mm) const {
    if (zoom_ == 1.0) return false;
    if (sensor_mm_) {
      return std::abs(std::log(implied_mm / *sensor_mm_)) >
             std::abs(std::log(implied_mm * zoom_ / *sensor_mm_));
    }
    if (implied_mm < kNarrowestSensorMm) return true;
    return std::nullopt;
  }

  void AddPlane() {
    if (!focal_mm_ || !facts_.plane_px_per_mm) return;
    const Size recorded = Recorded();
    const double implied_mm = Longer(recorded) / *facts_.plane_px_per_mm;
    const std::optional<bool> contained = PlaneContainsZoom(implied_mm);
    const double sensor_mm = contained.value_or(false) ? implied_mm * zoom_ : implied_mm;
    const bool plausible = sensor_mm >= kNarrowestSensorMm && sensor_mm <= kWidestSensorMm;
    const Resizing resizing(recorded, size_);
    const std::string reason = FormatText(
        "focal length %.4g mm at %.4g px/mm of the sensor's plane (a sensor %.3g mm "
        "wide)%s",
        *focal_mm_,
        *facts_.plane_px_per_mm,
        sensor_mm,
        resizing.Words().c_str());
    double trust = plausible ? 1.2 : 0.1;
    for (const double factor : resizing.factors()) {
      AddZoomed(Source::kPlane,
                trust,
                *focal_mm_ * *facts_.plane_px_per_mm * factor,
                2.0,
                reason,
                contained);
      trust *= 0.5;
    }
    if (plausible || sensor_mm_ || facts_.focal_35mm) return;
    notes_.push_back(
        FormatText("focal length: no camera has a sensor %.3g mm wide; the picture was "
                   "resized, or the resolution's unit is wrong",
                   sensor_mm));
    constexpr double kShortestMm = 4.5;
    constexpr double kLongestMm = 30.0;
    if (*focal_mm_ < kShortestMm || *focal_mm_ > kLongestMm) return;
    AddZoomed(Source::kAssumption,
              0.3,
              *focal_mm_ / kCompactSensorMm * Longer(size_),
              kAssumedSigma,
              FormatText("not told by the picture; %.4g mm on a compact camera's sensor %.3g mm "
                         "wide assumed",
                         *focal_mm_,
                         kCompactSensorMm),
              false);
  }

  const PictureFacts& facts_;
  Size size_;
  std::optional<double> focal_mm_;
  std::optional<double> sensor_mm_;
  double zoom_ = 1.0;
  std::vector<Reading> readings_;
  std::vector<std::string> notes_;
};

bool Agree(const Reading& a, const Reading& b) {
  return std::abs(std::log(a.focal.focal_px / b.focal.focal_px)) <= std::log(1.0 + kAgreement);
}

// Its own trust and that of the other sources that agree, each counted once.
double SupportOf(const Reading& reading, const std::vector<Reading>& all) {
  double support = reading.trust;
  if (reading.source == Source::kAssumption) return support;
  for (const Source source :
       {Source::kCalibration, Source::kEquivalent, Source::kSensor, Source::kPlane}) {
    if (source == reading.source) continue;
    double most = 0.0;
    for (const Reading& other : all) {
      if (other.source == source && Agree(reading, other)) most = std::max(most, other.trust);
    }
    support += most;
  }
  return support;
}

void Rank(std::vector<Reading>& readings) {
  std::vector<std::pair<double, Reading>> ranked;
  for (const Reading& reading : readings) {
    ranked.emplace_back(SupportOf(reading, readings), reading);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    constexpr double kSame = 1e-9;
    if (std::abs(a.first - b.first) > kSame) return a.first > b.first;
    return a.second.trust > b.second.trust;
  });
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = std::move(ranked[i].second);
}

// Readings of sources other than the first one's, against it.
void Compare(const std::vector<Reading>& readings, std::vector<std::string>& notes) {
  const Reading& first = readings.front();
  std::vector<Source> seen = {first.source};
  for (const Reading& other : readings) {
    if (std::find(seen.begin(), seen.end(), other.source) != seen.end()) continue;
    seen.push_back(other.source);
    const double percent = 100.0 * (other.focal.focal_px / first.focal.focal_px - 1.0);
    notes.push_back(FormatText("focal length: %s would give %.0f px (%+.0f %%)",
                               other.focal.reason.c_str(),
                               other.focal.focal_px,
                               percent) +
                    (Agree(first, other) ? "" : "; the other is the more plausible"));
  }
}

// Leaves out what a better one says within its doubt.
std::vector<FocalHypothesis> Distinct(const std::vector<Reading>& readings) {
  constexpr double kFewPercent = 3.0;
  std::vector<FocalHypothesis> kept;
  for (const Reading& reading : readings) {
    const FocalHypothesis& focal = reading.focal;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const FocalHypothesis& better) {
      const double percent = 100.0 * std::abs(std::log(focal.focal_px / better.focal_px));
      return percent <= std::max(kFewPercent, 2.0 * better.sigma_percent);
    });
    if (!known) kept.push_back(focal);
  }
  return kept;
}

}  // namespace

double DiagonalViewDeg(double focal_px, double width, double height) {
  return 360.0 / std::numbers::pi * std::atan(0.5 * std::hypot(width, height) / focal_px);
}

bool IsPlausibleFocal(double focal_px, double width, double height) {
  constexpr double kLeastDeg = 5.0;
  constexpr double kMostDeg = 150.0;
  if (!(focal_px > 0.0) || !std::isfinite(focal_px)) return false;
  const double view = DiagonalViewDeg(focal_px, width, height);
  return view >= kLeastDeg && view <= kMostDeg;
}

FocalLength FocalLengthOf(const PictureFacts& facts, int width, int height) {
  const Size size{static_cast<double>(width), static_cast<double>(height)};
  Readings gathered(facts, size);
  std::vector<Reading> readings = gathered.Take();
  FocalLength result;
  result.notes = gathered.TakeNotes();
  readings.push_back(
      {Source::kAssumption,
       0.2,
       {kAssumed35mm * Diagonal(size) / kFilmDiagonalMm,
        kAssumedSigma,
        FormatText("not told by the picture; %.0f mm equivalent assumed, as of a phone",
                   kAssumed35mm)}});
  Rank(readings);
  result.assumed = readings.front().source == Source::kAssumption;
  if (!result.assumed) {
    std::erase_if(readings, [](const Reading& r) { return r.source == Source::kAssumption; });
  }
  Compare(readings, result.notes);
  result.hypotheses = Distinct(readings);
  return result;
}

}  // namespace ridgeline
