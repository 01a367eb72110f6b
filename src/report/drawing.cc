// SPDX-License-Identifier: Apache-2.0
#include "report/drawing.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "report/picture_file.h"

namespace ridgeline {
namespace {

constexpr int kFace = cv::FONT_HERSHEY_SIMPLEX;
// Font size of an SVG for a scale of OpenCV's letters.
constexpr double kPxPerScale = 28.0;

cv::Scalar Bgr(const Rgb& color) { return {double(color.b), double(color.g), double(color.r)}; }

cv::Size SizeOf(const std::string& text, double scale) {
  int baseline = 0;
  return cv::getTextSize(text, kFace, scale, 1, &baseline);
}

std::string Attribute(const char* name, double value) {
  char text[64];
  std::snprintf(text, sizeof text, " %s=\"%g\"", name, value);
  return text;
}

std::string Color(const char* name, const Rgb& color) {
  return std::string(" ") + name + "=\"" + HexColor(color) + "\"";
}

// Filled, or its outline.
std::string Ink(const Rgb& color, int line_width) {
  if (line_width <= 0) return Color("fill", color);
  return " fill=\"none\"" + Color("stroke", color) + Attribute("stroke-width", line_width);
}

// Held to the width that the layout reckons with, whatever font there is.
std::string Letters(const std::string& text, double scale, const Rgb& color) {
  return Attribute("font-size", kPxPerScale * scale) +
         Attribute("textLength", SizeOf(text, scale).width) + " lengthAdjust=\"spacingAndGlyphs\"" +
         Color("fill", color) + ">" + EscapeMarkup(text) + "</text>\n";
}

}  // namespace

void Drawing::Add(Mark mark) {
  mark.clip = clip_;
  marks_.push_back(std::move(mark));
}

void Drawing::Line(cv::Point a, cv::Point b, const Rgb& color, int line_width) {
  Mark mark;
  mark.shape = Shape::kLine;
  mark.a = a;
  mark.b = b;
  mark.color = color;
  mark.size = line_width;
  Add(std::move(mark));
}

void Drawing::Rectangle(const cv::Rect& rect, const Rgb& color, int line_width) {
  Mark mark;
  mark.shape = Shape::kRectangle;
  mark.a = rect.tl();
  mark.b = rect.br();
  mark.color = color;
  mark.size = line_width;
  Add(std::move(mark));
}

void Drawing::Circle(cv::Point center, int radius, const Rgb& color, int line_width) {
  Mark mark;
  mark.shape = Shape::kCircle;
  mark.a = center;
  mark.radius = radius;
  mark.color = color;
  mark.size = line_width;
  Add(std::move(mark));
}

void Drawing::Text(
    const std::string& text, cv::Point at, double anchor, const Rgb& color, double scale) {
  if (text.empty()) return;
  Mark mark;
  mark.shape = Shape::kText;
  mark.a = at;
  mark.anchor = anchor;
  mark.scale = scale;
  mark.color = color;
  mark.text = text;
  Add(std::move(mark));
}

void Drawing::TextUp(const std::string& text, cv::Point middle, const Rgb& color, double scale) {
  if (text.empty()) return;
  Mark mark;
  mark.shape = Shape::kTextUp;
  mark.a = middle;
  mark.scale = scale;
  mark.color = color;
  mark.text = text;
  Add(std::move(mark));
}

void Drawing::Image(const cv::Mat& bgr, const cv::Rect& place) {
  Mark mark;
  mark.shape = Shape::kImage;
  mark.a = place.tl();
  mark.b = place.br();
  mark.image = bgr;
  Add(std::move(mark));
}

int Drawing::TextWidth(const std::string& text, double scale) { return SizeOf(text, scale).width; }

void Drawing::Paint(const Mark& mark, cv::Point shift, cv::Mat& picture) {
  const cv::Point a = mark.a - shift;
  const cv::Point b = mark.b - shift;
  const cv::Scalar color = Bgr(mark.color);
  const int line_width = mark.size > 0 ? mark.size : cv::FILLED;
  const cv::Rect whole(0, 0, picture.cols, picture.rows);
  switch (mark.shape) {
    case Shape::kLine: {
      const bool is_straight = a.x == b.x || a.y == b.y;
      cv::line(picture, a, b, color, mark.size, is_straight ? cv::LINE_8 : cv::LINE_AA);
      return;
    }
    case Shape::kRectangle:
      if (mark.size > 0) {
        cv::rectangle(picture, cv::Rect(a, b), color, mark.size);
      } else {
        picture(cv::Rect(a, b) & whole).setTo(color);
      }
      return;
    case Shape::kCircle:
      cv::circle(picture, a, mark.radius, color, line_width, cv::LINE_AA);
      return;
    case Shape::kText: {
      const int back = cvRound(mark.anchor * SizeOf(mark.text, mark.scale).width);
      cv::putText(
          picture, mark.text, {a.x - back, a.y}, kFace, mark.scale, color, 1, cv::LINE_AA);
      return;
    }
    case Shape::kTextUp: {
      const cv::Size size = SizeOf(mark.text, mark.scale);
      cv::Mat strip(size.height + 8, size.width + 4, CV_8UC3, cv::Scalar::all(255));
      cv::putText(
          strip, mark.text, {2, size.height + 2}, kFace, mark.scale, color, 1, cv::LINE_AA);
      cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
      const cv::Rect place(a.x - strip.cols / 2, a.y - strip.rows / 2, strip.cols, strip.rows);
      const cv::Rect inside = place & whole;
      if (inside.empty()) return;
      cv::Mat target = picture(inside);
      cv::min(target, strip(cv::Rect(inside.tl() - place.tl(), inside.size())), target);
      return;
    }
    case Shape::kImage: {
      const cv::Rect place = cv::Rect(a, b) & whole;
      cv::Mat large;
      cv::resize(mark.image, large, cv::Rect(a, b).size(), 0.0, 0.0, cv::INTER_NEAREST);
      large(cv::Rect(place.tl() - a, place.size())).copyTo(picture(place));
      return;
    }
  }
}

cv::Mat Drawing::Picture() const {
  cv::Mat picture(height_, width_, CV_8UC3, cv::Scalar::all(255));
  const cv::Rect whole(0, 0, width_, height_);
  for (const Mark& mark : marks_) {
    const cv::Rect area = mark.clip ? *mark.clip & whole : whole;
    if (area.empty()) continue;
    cv::Mat part = picture(area);
    Paint(mark, area.tl(), part);
  }
  return picture;
}

std::string Drawing::SvgOf(const Mark& mark) {
  const cv::Point a = mark.a;
  const cv::Point b = mark.b;
  switch (mark.shape) {
    case Shape::kLine:
      return "<line" + Attribute("x1", a.x) + Attribute("y1", a.y) + Attribute("x2", b.x) +
             Attribute("y2", b.y) + Color("stroke", mark.color) +
             Attribute("stroke-width", mark.size) + "/>\n";
    case Shape::kRectangle:
      return "<rect" + Attribute("x", a.x) + Attribute("y", a.y) + Attribute("width", b.x - a.x) +
             Attribute("height", b.y - a.y) + Ink(mark.color, mark.size) + "/>\n";
    case Shape::kCircle:
      return "<circle" + Attribute("cx", a.x) + Attribute("cy", a.y) +
             Attribute("r", mark.radius) + Ink(mark.color, mark.size) + "/>\n";
    case Shape::kText: {
      const double back = mark.anchor * SizeOf(mark.text, mark.scale).width;
      return "<text" + Attribute("x", a.x - back) + Attribute("y", a.y) +
             Letters(mark.text, mark.scale, mark.color);
    }
    case Shape::kTextUp: {
      char turn[64];
      std::snprintf(turn, sizeof turn, " transform=\"translate(%d %d) rotate(-90)\"", a.x, a.y);
      return std::string("<text") + turn +
             Attribute("x", -0.5 * SizeOf(mark.text, mark.scale).width) + Attribute("y", 4.0) +
             Letters(mark.text, mark.scale, mark.color);
    }
    case Shape::kImage:
      return "<image" + Attribute("x", a.x) + Attribute("y", a.y) +
             Attribute("width", b.x - a.x) + Attribute("height", b.y - a.y) +
             " preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"" +
             PngDataUrl(mark.image) + "\"/>\n";
  }
  return "";
}

std::string Drawing::Svg() const {
  const std::string size = std::to_string(width_) + " " + std::to_string(height_);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                    "\" font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" "
                    "height=\"100%\" fill=\"#fff\"/>\n";
  std::map<std::tuple<int, int, int, int>, int> clips;
  for (const Mark& mark : marks_) {
    if (!mark.clip) {
      svg += SvgOf(mark);
      continue;
    }
    const cv::Rect& clip = *mark.clip;
    const auto [it, added] = clips.emplace(std::tuple(clip.x, clip.y, clip.width, clip.height),
                                           static_cast<int>(clips.size()));
    const std::string name = "clip" + std::to_string(it->second);
    if (added) {
      svg += "<clipPath id=\"" + name + "\"><rect" + Attribute("x", clip.x) +
             Attribute("y", clip.y) + Attribute("width", clip.width) +
             Attribute("height", clip.height) + "/></clipPath>\n";
    }
    svg += "<g clip-path=\"url(#" + name + ")\">" + SvgOf(mark) + "</g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace ridgeline
