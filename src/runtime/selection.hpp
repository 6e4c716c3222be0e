// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/camera.hpp"
#include "runtime/pack_view.hpp"
#include "runtime/radix_sort.hpp"

namespace cloudgen::runtime {

struct DetailOptions {
  float errorPixels = 3;     ///< detail up to this size may be lost
  float hysteresis = 0.15f;  ///< a cloud changes its level only this share of errorPixels beyond the limit
  /// Levels before this one are not used: 0 for all.
  std::uint32_t finestLevel = 0;
  /// A cloud that looks smaller than this, across its sphere, is one picture (kImpostor); 0: none is.
  float impostorPixels = 0;
  std::uint32_t mostImpostors = 256;
};

/// The clouds that a selection walks. Tiles may be none: then every cloud is looked at.
struct CloudSet {
  std::span<const pack::Instance> instances;
  std::span<const pack::Tile> tiles;
  float tileSlackMeters = 0;  ///< clouds may have moved out of their tiles by so much
};

inline constexpr std::size_t kMostAround = 128;
inline constexpr std::uint8_t kImpostorLevel = 0xfe;

/// What a camera sees of a set of clouds, each in the detail that it needs, in pieces: begin, then `advance` until it
/// says that all is done. Nothing is allocated after the constructor.
class Selection {
 public:
  Selection() = default;
  /// Of at most `capacity` puffs. Throws std::bad_alloc.
  Selection(const PackView& pack, std::size_t instances, std::size_t tiles, std::size_t capacity);

  /// `frustum` is the camera's, with a margin of `marginMeters`.
  void begin(const CloudSet& clouds, const Camera& camera, const Frustum& frustum, float marginMeters,
             const DetailOptions& detail) noexcept;
  /// Does about `work` steps more (one a tile, a cloud or a puff); false once there is nothing left to do.
  bool advance(std::uint64_t work) noexcept;

  /// The puffs that were found, and how far they are (farFirst).
  std::span<const DrawPuff> puffs() const noexcept { return {puffs_.data(), count_}; }
  std::span<const std::uint16_t> keys() const noexcept { return {keys_.data(), count_}; }
  /// Steps done since `begin`.
  std::uint64_t work() const noexcept { return work_; }
  /// The clouds whose sphere holds the eye, or nearly (within the frustum's margin): the first kMostAround of them.
  std::span<const std::uint32_t> around() const noexcept { return {around_.data(), aroundCount_}; }
  /// Level of a cloud when it was last seen, kImpostorLevel for a picture.
  std::uint32_t levelOf(std::size_t instance) const noexcept { return levels_[instance]; }

 private:
  struct Visit {
    std::uint32_t tile = 0;
    bool inside = false;
  };
  void visitTile(const Visit& visit) noexcept;
  void visitCloud(std::uint32_t index, bool inside) noexcept;
  bool isImpostor(std::uint32_t index, float pixels) const noexcept;
  std::uint32_t chosenLevel(const ArchetypeInfo& archetype, std::uint32_t current, float pixelsPerMeter) const noexcept;

  const PackView* pack_ = nullptr;
  CloudSet clouds_;
  Camera camera_;
  Frustum frustum_;
  DetailOptions detail_;
  float focalPixels_ = 1, marginMeters_ = 0;
  std::vector<Visit> waiting_;
  std::size_t waitingCount_ = 0;
  std::uint32_t nextCloud_ = 0, endCloud_ = 0;  ///< of the leaf that is being looked at
  bool leafInside_ = false;
  std::vector<std::uint8_t> levels_;
  std::vector<DrawPuff> puffs_;
  std::vector<std::uint16_t> keys_;
  std::size_t count_ = 0;
  std::uint32_t impostors_ = 0;
  std::uint64_t work_ = 0;
  std::array<std::uint32_t, kMostAround> around_{};
  std::size_t aroundCount_ = 0;
};

/// Where a heading turns the archetype's axes: cosine and sine of a yaw step.
struct Turn {
  float cosine = 1, sine = 0;
};
Turn turnOf(std::uint8_t yawStep) noexcept;

/// A point of an archetype as it stands in a cloud.
inline Vec3 placed(const pack::Instance& cloud, const Turn& turn, const Vec3& point) noexcept {
  const float s = cloud.scale();
  return {cloud.position().x() + s * (turn.cosine * point.x + turn.sine * point.z), cloud.position().y() + s * point.y,
          cloud.position().z() + s * (turn.cosine * point.z - turn.sine * point.x)};
}

}  // namespace cloudgen::runtime
