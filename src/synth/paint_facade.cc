// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "synth/paint.h"

namespace ridgeline {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

const std::array<Vector3f, 10> kPlaster = {Vector3f(0.72f, 0.66f, 0.52f),
                                           Vector3f(0.80f, 0.77f, 0.70f),
                                           Vector3f(0.70f, 0.55f, 0.36f),
                                           Vector3f(0.62f, 0.44f, 0.36f),
                                           Vector3f(0.55f, 0.58f, 0.50f),
                                           Vector3f(0.66f, 0.66f, 0.66f),
                                           Vector3f(0.50f, 0.54f, 0.60f),
                                           Vector3f(0.76f, 0.62f, 0.42f),
                                           Vector3f(0.42f, 0.20f, 0.15f),
                                           Vector3f(0.85f, 0.84f, 0.80f)};

// Uniform value in [0, 1) of a cell.
float Hash(std::uint64_t key, int a, int b) {
  const auto cell = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) |
                    static_cast<std::uint32_t>(b);
  return static_cast<float>(MixBits(MixBits(key) ^ cell) >> 40) * 0x1p-24f;
}

// What all storeys of a building share.
struct Style {
  explicit Style(std::uint64_t look) {
    Random random(look, 0x60);
    plaster =
        kPlaster[random.Below(kPlaster.size())] * static_cast<float>(random.Uniform(0.9, 1.1));
    plinth = plaster * static_cast<float>(random.Uniform(0.45, 0.7));
    trim = Vector3f::Constant(static_cast<float>(random.Uniform(0.55, 0.85)));
    spacing_m = static_cast<float>(random.Uniform(2.0, 3.2));
    window_m = Vector2f(static_cast<float>(random.Uniform(0.9, 1.35)),
                        static_cast<float>(random.Uniform(1.3, 1.75)));
    sill_m = static_cast<float>(random.Uniform(0.7, 1.0));
    shop = random.Uniform() < 0.25;
    cornice = random.Uniform() < 0.5;
    shutters = random.Uniform() < 0.25;
    shutter_color = Vector3f(0.12f,
                             static_cast<float>(random.Uniform(0.15, 0.3)),
                             static_cast<float>(random.Uniform(0.1, 0.25)));
  }
  Vector3f plaster, plinth, trim, shutter_color;
  Vector2f window_m;
  float spacing_m = 2.5f, sill_m = 0.8f;
  bool shop = false, cornice = false, shutters = false;
};

Paint Glass(float curtain, float height_in_window) {
  const float dark = curtain > 0.6f && height_in_window > 0.35f ? 0.35f : 0.03f;
  return {Vector3f(0.9f, 1.0f, 1.05f) * dark, 0.35f};
}

// A window around its middle; x, y relative to its lower middle [m]. Returns false outside of it.
bool PaintWindow(
    const Style& style, const Vector2f& at, const Vector2f& size, float curtain, Paint& paint) {
  const float border = 0.12f;
  const float half = 0.5f * size.x();
  if (std::abs(at.x()) > half + border || at.y() < -border || at.y() > size.y() + border) {
    const bool sill = std::abs(at.x()) < half + 0.25f && at.y() < -border && at.y() > -0.22f;
    if (sill) paint = {style.trim, 0.0f};
    const bool shutter = style.shutters && std::abs(at.x()) > half + border &&
                         std::abs(at.x()) < 2.0f * half + border && at.y() > 0.0f &&
                         at.y() < size.y();
    if (shutter) paint = {style.shutter_color, 0.0f};
    return sill || shutter;
  }
  const bool surround = std::abs(at.x()) > half || at.y() < 0.0f || at.y() > size.y();
  const bool reveal = at.y() > size.y() - 0.10f || at.x() < -half + 0.07f;  // shaded by the wall
  const bool frame = std::abs(at.x()) > half - 0.12f || std::abs(at.x()) < 0.05f ||
                     at.y() < 0.08f || std::abs(at.y() - 0.7f * size.y()) < 0.04f;
  if (surround) {
    paint = {style.trim, 0.0f};
  } else if (reveal) {
    paint = {0.3f * style.plaster, 0.0f};
  } else if (frame) {
    paint = {Vector3f::Constant(0.75f), 0.0f};
  } else {
    paint = Glass(curtain, at.y() / size.y());
  }
  return true;
}

// Ground floor of a building with shops: panes between pillars.
bool PaintShop(const Vector2f& uv, const WallLook& wall, Paint& paint) {
  if (uv.y() < 0.35f || uv.y() > 0.8f * wall.storey_m) return false;
  const float pane = std::fmod(uv.x(), 3.4f);
  if (pane < 0.45f || uv.x() > wall.length_m - 0.45f) return false;
  const bool frame = pane < 0.55f || pane > 3.3f || uv.y() < 0.45f;
  paint = frame ? Paint{Vector3f::Constant(0.15f), 0.0f} : Paint{Vector3f::Constant(0.05f), 0.3f};
  return true;
}

bool PaintDoor(const Vector2f& uv, const WallLook& wall, Paint& paint) {
  const float middle = wall.length_m * (0.25f + 0.5f * Hash(wall.side, 1, 2));
  if (std::abs(uv.x() - middle) > 0.65f || uv.y() > 2.3f) return false;
  const bool frame = std::abs(uv.x() - middle) > 0.52f || uv.y() > 2.15f;
  paint.albedo = frame ? Vector3f::Constant(0.6f) : Vector3f(0.22f, 0.13f, 0.08f);
  return true;
}

}  // namespace

Paint PaintFacade(const WallLook& wall, const Vector2f& uv) {
  const Style style(wall.look);
  const float stains = FractalNoise(uv * 0.6f, 3, wall.side);
  Paint paint{style.plaster * (0.88f + 0.2f * stains), 0.0f};
  if (uv.y() < 0.5f) paint.albedo = style.plinth;
  const float storey_height = wall.storey_m;
  const int storey = static_cast<int>(std::floor(uv.y() / storey_height));
  const float above = uv.y() - static_cast<float>(storey) * storey_height;
  if (style.cornice && storey >= 1 && storey < wall.storeys && above < 0.14f) {
    paint.albedo = style.trim;
  }
  if (wall.faces_street && PaintDoor(uv, wall, paint)) return paint;
  if (wall.faces_street && style.shop && storey == 0 && PaintShop(uv, wall, paint)) return paint;

  // Gable windows; party and yard walls have fewer windows.
  if (storey >= wall.storeys) {
    const Vector2f at(uv.x() - 0.5f * wall.length_m, uv.y() - wall.storeys * storey_height - 0.9f);
    PaintWindow(style, at, {0.8f, 1.1f}, 0.0f, paint);
    return paint;
  }
  if (storey < 0 || (!wall.faces_street && Hash(wall.side, 3, 4) < 0.45f)) return paint;
  const int columns = static_cast<int>((wall.length_m - 0.8f) / style.spacing_m);
  if (columns < 1) return paint;
  const float margin = 0.5f * (wall.length_m - static_cast<float>(columns) * style.spacing_m);
  const int column = static_cast<int>(std::floor((uv.x() - margin) / style.spacing_m));
  if (column < 0 || column >= columns) return paint;
  const float middle = margin + (static_cast<float>(column) + 0.5f) * style.spacing_m;
  const Vector2f at(uv.x() - middle, above - style.sill_m);
  PaintWindow(style, at, style.window_m, Hash(wall.side, column, storey), paint);
  return paint;
}

}  // namespace ridgeline
