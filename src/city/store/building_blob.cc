// SPDX-License-Identifier: Apache-2.0
#include "city/store/building_blob.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"

namespace ridgeline {
namespace {

static_assert(std::endian::native == std::endian::little, "blobs are little endian");

constexpr std::uint32_t kVersion = 1;
constexpr std::uint8_t kHasClass = 0x80;
constexpr std::uint8_t kReversed = 0x40;
constexpr std::uint8_t kClassBits = 0x0F;

class Writer {
 public:
  template <typename T>
  void Put(const T& value) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
  }
  std::vector<std::uint8_t> Release() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, const std::string& file, const std::string& id)
      : bytes_(bytes), file_(file), id_(id) {}

  template <typename T>
  T Get() {
    if (bytes_.size() - position_ < sizeof(T)) Fail();
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }
  // A count of things of at least `size` bytes each.
  std::uint32_t GetCount(std::size_t size) {
    const auto count = Get<std::uint32_t>();
    if (count > (bytes_.size() - position_) / size) Fail();
    return count;
  }
  [[noreturn]] void Fail() const {
    throw InputError(file_, id_, "damaged surfaces", "a store written by ridgeline index");
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  const std::string& file_;
  const std::string& id_;
};

}  // namespace

std::vector<std::uint8_t> EncodeBuilding(const SourceModel& model,
                                         const SourceBuilding& building,
                                         int lod) {
  Writer out;
  out.Put(kVersion);
  out.Put(static_cast<std::uint32_t>(lod));
  std::uint32_t count = 0;
  for (const SourceMember& member : building.members) count += member.lod == lod ? 1 : 0;
  out.Put(count);
  for (const SourceMember& member : building.members) {
    if (member.lod != lod) continue;
    const SourcePolygon& polygon = model.polygons[member.polygon];
    out.Put(static_cast<std::uint8_t>(static_cast<std::uint8_t>(member.surface_class) |
                                      (member.has_class ? kHasClass : 0) |
                                      (member.reversed ? kReversed : 0)));
    out.Put(polygon.ring_count);
    for (std::uint32_t r = 0; r < polygon.ring_count; ++r) {
      const SourceRing& ring = model.rings[polygon.first_ring + r];
      out.Put(ring.point_count);
      for (std::uint32_t p = 0; p < ring.point_count; ++p) {
        for (int axis = 0; axis < 3; ++axis) out.Put(model.points[ring.first_point + p][axis]);
      }
    }
  }
  return out.Release();
}

void DecodeBuilding(std::span<const std::uint8_t> bytes,
                    const std::string& file,
                    SourceModel& model,
                    SourceBuilding& building) {
  Reader in(bytes, file, building.id);
  if (in.Get<std::uint32_t>() != kVersion) in.Fail();
  const auto lod = in.Get<std::uint32_t>();
  if (lod > 4) in.Fail();
  const std::uint32_t count = in.GetCount(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto flags = in.Get<std::uint8_t>();
    SourceMember member;
    member.polygon = static_cast<std::uint32_t>(model.polygons.size());
    member.lod = static_cast<std::int8_t>(lod);
    if ((flags & kClassBits) > static_cast<std::uint8_t>(SurfaceClass::kTerrain)) in.Fail();
    member.surface_class = static_cast<SurfaceClass>(flags & kClassBits);
    member.has_class = (flags & kHasClass) != 0;
    member.reversed = (flags & kReversed) != 0;
    SourcePolygon polygon;
    polygon.first_ring = static_cast<std::uint32_t>(model.rings.size());
    polygon.ring_count = in.GetCount(4);
    if (polygon.ring_count == 0) in.Fail();
    for (std::uint32_t r = 0; r < polygon.ring_count; ++r) {
      SourceRing ring{static_cast<std::uint32_t>(model.points.size()),
                      in.GetCount(3 * sizeof(double))};
      if (ring.point_count < 3) in.Fail();
      for (std::uint32_t p = 0; p < ring.point_count; ++p) {
        Eigen::Vector3d point;
        for (int axis = 0; axis < 3; ++axis) point[axis] = in.Get<double>();
        if (!point.allFinite()) in.Fail();
        model.points.push_back(point);
      }
      model.rings.push_back(ring);
    }
    model.polygons.push_back(std::move(polygon));
    building.members.push_back(member);
  }
}

}  // namespace ridgeline
