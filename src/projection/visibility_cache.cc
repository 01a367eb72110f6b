// SPDX-License-Identifier: Apache-2.0
#include "projection/visibility_cache.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

// Locks and memory are split so that threads seldom wait for each other.
constexpr std::size_t kShards = 16;

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t bits = 0;
    for (const std::int64_t index : cell) bits = MixBits(bits ^ static_cast<std::uint64_t>(index));
    return static_cast<std::size_t>(bits);
  }
};

std::size_t BytesOf(const VisibleSet& set) {
  return sizeof(VisibleSet) + set.pieces.capacity() * sizeof(VisiblePiece) +
         set.skyline_elevation.capacity() * sizeof(float);
}

// Sets of some cells, the most recently used first.
class Shard {
 public:
  std::shared_ptr<const VisibleSet> Find(const Cell& cell) {
    const std::lock_guard lock(mutex_);
    const auto found = by_cell_.find(cell);
    if (found == by_cell_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->second;
  }

  void Add(const Cell& cell, std::shared_ptr<const VisibleSet> set, std::size_t max_bytes) {
    const std::lock_guard lock(mutex_);
    if (by_cell_.contains(cell)) return;  // another thread was faster
    bytes_ += BytesOf(*set);
    entries_.emplace_front(cell, std::move(set));
    by_cell_[cell] = entries_.begin();
    while (bytes_ > max_bytes) {
      bytes_ -= BytesOf(*entries_.back().second);
      by_cell_.erase(entries_.back().first);
      entries_.pop_back();
    }
  }

  std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  using Entries = std::list<std::pair<Cell, std::shared_ptr<const VisibleSet>>>;
  mutable std::mutex mutex_;
  Entries entries_;
  std::unordered_map<Cell, Entries::iterator, CellHash> by_cell_;
  std::size_t bytes_ = 0;
};

void Require(bool ok, const std::string& field, double value, const std::string& expected) {
  if (ok) return;
  throw InputError("", "visibility_cache." + field, std::to_string(value), expected);
}

}  // namespace

void VisibilityCacheOptions::Validate() const {
  Require(cell_m > 0.0, "cell_m", cell_m, "> 0");
  Require(height_cell_m > 0.0, "height_cell_m", height_cell_m, "> 0");
  Require(max_megabytes >= 0.0, "max_megabytes", max_megabytes, ">= 0");
}

struct VisibilityCache::Impl {
  const Scene& scene;
  const Eigen::Vector3d origin;
  const Sector sector;
  const Eigen::Vector3d cell_size;
  const std::size_t max_bytes_per_shard;
  std::array<Shard, kShards> shards{};

  Cell CellOf(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d index = (position - origin).cwiseQuotient(cell_size);
    return {std::llround(index.x()), std::llround(index.y()), std::llround(index.z())};
  }
  Eigen::Vector3d CenterOf(const Cell& cell) const {
    const Eigen::Vector3d index(
        static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2]));
    return origin + index.cwiseProduct(cell_size);
  }
};

VisibilityCache::VisibilityCache(const Scene& scene,
                                 const Eigen::Vector3d& origin,
                                 const Sector& sector,
                                 const VisibilityCacheOptions& options) {
  options.Validate();
  impl_.reset(new Impl{
      scene,
      origin,
      sector,
      Eigen::Vector3d(options.cell_m, options.cell_m, options.height_cell_m),
      static_cast<std::size_t>(options.max_megabytes * 1e6 / static_cast<double>(kShards))});
}

VisibilityCache::~VisibilityCache() = default;

std::shared_ptr<const VisibleSet> VisibilityCache::Near(const Eigen::Vector3d& position) {
  const Cell cell = impl_->CellOf(position);
  Shard& shard = impl_->shards[CellHash{}(cell) % kShards];
  if (auto known = shard.Find(cell)) return known;
  auto set = std::make_shared<const VisibleSet>(
      impl_->scene.VisibleFrom(impl_->CenterOf(cell), impl_->sector));
  shard.Add(cell, set, impl_->max_bytes_per_shard);
  return set;
}

Eigen::Vector3d VisibilityCache::CenterNear(const Eigen::Vector3d& position) const {
  return impl_->CenterOf(impl_->CellOf(position));
}

std::size_t VisibilityCache::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Shard& shard : impl_->shards) bytes += shard.bytes();
  return bytes;
}

}  // namespace ridgeline
