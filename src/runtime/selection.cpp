// SPDX-License-Identifier: Apache-2.0
#include "runtime/selection.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::runtime {
namespace {

std::array<Turn, kYawSteps> turns() noexcept {
  std::array<Turn, kYawSteps> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float angle = 6.2831853f * static_cast<float>(i) / kYawSteps;
    all[i] = {std::cos(angle), std::sin(angle)};
  }
  return all;
}
const std::array<Turn, kYawSteps> kTurns = turns();

}  // namespace

Turn turnOf(std::uint8_t yawStep) noexcept { return kTurns[yawStep % kYawSteps]; }

Selection::Selection(const PackView& pack, std::size_t instances, std::size_t tiles, std::size_t capacity)
    : pack_(&pack), waiting_(tiles + 1), levels_(instances, 0xff), puffs_(capacity), keys_(capacity) {}

void Selection::begin(const CloudSet& clouds, const Camera& camera, const Frustum& frustum,
                      float marginMeters, const DetailOptions& detail) noexcept {
  clouds_ = clouds;
  camera_ = camera;
  frustum_ = frustum;
  detail_ = detail;
  focalPixels_ = camera.focalPixels();
  marginMeters_ = marginMeters;
  count_ = aroundCount_ = impostors_ = 0;
  work_ = 0;
  waitingCount_ = 0;
  nextCloud_ = endCloud_ = 0;
  if (clouds.tiles.empty()) {
    endCloud_ = static_cast<std::uint32_t>(clouds.instances.size());
    leafInside_ = false;
  } else {
    waiting_[waitingCount_++] = {0, false};
  }
}

bool Selection::advance(std::uint64_t work) noexcept {
  const std::uint64_t until = work > ~work_ ? ~std::uint64_t{0} : work_ + work;
  while (work_ < until) {
    if (nextCloud_ < endCloud_)
      visitCloud(nextCloud_++, leafInside_);
    else if (waitingCount_ > 0)
      visitTile(waiting_[--waitingCount_]);
    else
      return false;
    ++work_;
  }
  return nextCloud_ < endCloud_ || waitingCount_ > 0;
}

void Selection::visitTile(const Visit& visit) noexcept {
  const pack::Tile& tile = clouds_.tiles[visit.tile];
  bool inside = visit.inside;
  if (!inside) {
    const float slack = clouds_.tileSlackMeters;
    const Side side = frustum_.sideOfBox(vec3(tile.lower()) - Vec3{slack, slack, slack},
                                         vec3(tile.upper()) + Vec3{slack, slack, slack});
    if (side == Side::Outside) return;
    inside = side == Side::Inside;
  }
  if (tile.children() == 0) {
    nextCloud_ = tile.first();
    endCloud_ = tile.first() + tile.count();
    leafInside_ = inside;
    return;
  }
  for (std::uint32_t c = 0; c < tile.children(); ++c) waiting_[waitingCount_++] = {tile.first_child() + c, inside};
}

std::uint32_t Selection::chosenLevel(const ArchetypeInfo& archetype, std::uint32_t current,
                                     float pixelsPerMeter) const noexcept {
  const std::uint32_t finest = std::min(detail_.finestLevel, archetype.levels - 1);
  const auto errorOf = [&](std::uint32_t level) { return archetype.errorMeters[level] * pixelsPerMeter; };
  const bool isNew = current >= archetype.levels;
  const float slack = isNew ? 0 : detail_.hysteresis;
  std::uint32_t level = isNew ? archetype.levels - 1 : std::max(current, finest);
  while (level > finest && errorOf(level) > detail_.errorPixels * (1 + slack)) --level;
  if (isNew) return level;
  while (level + 1 < archetype.levels && errorOf(level + 1) < detail_.errorPixels * (1 - slack)) ++level;
  return level;
}

bool Selection::isImpostor(std::uint32_t index, float pixels) const noexcept {
  if (!(detail_.impostorPixels > 0) || impostors_ >= detail_.mostImpostors || count_ == puffs_.size()) return false;
  const float slack = levels_[index] == kImpostorLevel ? detail_.hysteresis : -detail_.hysteresis;
  return pixels < detail_.impostorPixels * (1 + slack);
}

void Selection::visitCloud(std::uint32_t index, bool inside) noexcept {
  const pack::Instance& cloud = clouds_.instances[index];
  if (!(cloud.optical_depth_factor() > 0)) return;
  const ArchetypeInfo& archetype = pack_->archetypes()[cloud.archetype()];
  const float radius = archetype.radiusMeters * cloud.scale();
  const Vec3 middle = vec3(cloud.position()) + archetype.middle * cloud.scale();
  if (!inside && !frustum_.meetsSphere(middle, radius)) return;
  const Vec3 away = middle - camera_.eye;
  const float squared = dot(away, away);
  const float reach = radius + marginMeters_;
  if (squared < reach * reach && aroundCount_ < kMostAround) around_[aroundCount_++] = index;
  const float distance = std::sqrt(squared), nearest = std::max(distance - radius, 1.0f);
  if (isImpostor(index, 2 * radius * focalPixels_ / std::max(distance, 1.0f))) {
    levels_[index] = kImpostorLevel;
    keys_[count_] = farFirst(squared);
    puffs_[count_++] = {index, kImpostor};
    ++impostors_;
    ++work_;
    return;
  }
  const std::uint32_t level = chosenLevel(archetype, levels_[index], cloud.scale() * focalPixels_ / nearest);
  levels_[index] = static_cast<std::uint8_t>(level);
  const std::uint32_t first = archetype.first[level], count = archetype.count[level];
  if (count > puffs_.size() - count_) return;  // full: the capacity is that of all clouds, or a stated limit
  const Turn turn = turnOf(cloud.yaw_step());
  const std::span<const Vec3> centers = pack_->centers();
  DrawPuff* puff = puffs_.data() + count_;
  std::uint16_t* key = keys_.data() + count_;
  for (std::uint32_t p = first; p < first + count; ++p) {
    const Vec3 from = placed(cloud, turn, centers[p]) - camera_.eye;
    *key++ = farFirst(dot(from, from));
    *puff++ = {index, p};
  }
  count_ += count;
  work_ += count;
}

}  // namespace cloudgen::runtime
