// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/overlay.h"

namespace ridgeline {

// A chart as a list of marks, to become a picture of pixels or an SVG. Coordinates in pixels, y
// down; later marks cover earlier ones.
class Drawing {
 public:
  Drawing(int width, int height) : width_(width), height_(height) {}
  int width() const { return width_; }
  int height() const { return height_; }

  // What follows is cut at a rectangle, until Unclip().
  void Clip(const cv::Rect& rect) { clip_ = rect; }
  void Unclip() { clip_.reset(); }

  void Line(cv::Point a, cv::Point b, const Rgb& color, int line_width);
  // @param line_width  0: filled.
  void Rectangle(const cv::Rect& rect, const Rgb& color, int line_width);
  void Circle(cv::Point center, int radius, const Rgb& color, int line_width);
  // Letters of a height about 11 px times `scale` / 0.45, their foot at `at`.
  // @param anchor  0 writes to the right of the point, 0.5 about it, 1 to its left.
  void Text(const std::string& text, cv::Point at, double anchor, const Rgb& color, double scale);
  // Text that reads upwards, its middle at `middle`.
  void TextUp(const std::string& text, cv::Point middle, const Rgb& color, double scale);
  // An 8-bit BGR picture, its pixels as sharp squares.
  void Image(const cv::Mat& bgr, const cv::Rect& place);

  // Width of a text as pixels show it; an SVG's is held to it.
  static int TextWidth(const std::string& text, double scale);

  cv::Mat Picture() const;  // 8-bit BGR on white
  std::string Svg() const;

 private:
  enum class Shape { kLine, kRectangle, kCircle, kText, kTextUp, kImage };
  struct Mark {
    Shape shape = Shape::kLine;
    cv::Point a;
    cv::Point b;
    int size = 0;  // line width
    int radius = 0;
    double anchor = 0.0;
    double scale = 0.0;
    Rgb color;
    std::string text;
    cv::Mat image;
    std::optional<cv::Rect> clip;
  };

  void Add(Mark mark);
  static void Paint(const Mark& mark, cv::Point shift, cv::Mat& picture);
  static std::string SvgOf(const Mark& mark);

  int width_;
  int height_;
  std::optional<cv::Rect> clip_;
  std::vector<Mark> marks_;
};

}  // namespace ridgeline
