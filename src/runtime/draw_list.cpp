// SPDX-License-Identifier: Apache-2.0
#include "runtime/draw_list.hpp"

#include <algorithm>
#include <limits>

namespace cloudgen::runtime {
namespace {

bool sameLens(const Camera& a, const Camera& b) {
  return a.widthPixels == b.widthPixels && a.heightPixels == b.heightPixels &&
         a.verticalFieldRadians == b.verticalFieldRadians && a.farMeters == b.farMeters;
}

}  // namespace

DrawList::DrawList(const PackView& pack, std::size_t instances, std::size_t tiles, std::uint64_t puffs,
                   const LazyOptions& options)
    : options_(options) {
  const auto capacity = static_cast<std::size_t>(std::min<std::uint64_t>(puffs, options.mostPuffs));
  selection_ = Selection(pack, instances, tiles, capacity);
  lists_[0].resize(capacity);
  lists_[1].resize(capacity);
  half_.resize(capacity);
  halfKeys_.resize(capacity);
  keys_.resize(capacity);
}

bool DrawList::isWithin(const Camera& made, const Camera& now, float share) const noexcept {
  if (!sameLens(made, now)) return false;
  const float moved = length(now.eye - made.eye);
  const auto turned = [](const Vec3& a, const Vec3& b) {
    return std::acos(std::clamp(dot(normalized(a), normalized(b)), -1.0f, 1.0f));
  };
  return moved <= share * options_.moveMeters && turned(made.forward, now.forward) + turned(made.up, now.up) <=
                                                     share * options_.turnRadians;
}

bool DrawList::update(const CloudSet& clouds, const Camera& camera, const DetailOptions& detail) noexcept {
  bool isNew = false;
  if (!isMade_ || !isWithin(madeFor_, camera, 1)) {
    begin(clouds, camera, detail);
    isNew = advance(std::numeric_limits<std::uint64_t>::max());
  } else {
    if (!isMaking_ && !isWithin(madeFor_, camera, 1.0f / 3)) begin(clouds, camera, detail);
    if (isMaking_)
      isNew = advance(std::max<std::uint64_t>(lastWork_ / static_cast<std::uint64_t>(std::max(options_.slices, 1)), 64));
  }
  orderError_ = 2 * length(camera.eye - madeFor_.eye);
  return isNew;
}

void DrawList::begin(const CloudSet& clouds, const Camera& camera, const DetailOptions& detail) noexcept {
  makingFor_ = camera;
  isMaking_ = true;
  isSelected_ = false;
  passesDone_ = 0;
  isPassBegun_ = false;
  selection_.begin(clouds, camera, Frustum(camera, options_.turnRadians, options_.moveMeters),
                   options_.moveMeters, detail);
}

bool DrawList::advance(std::uint64_t work) noexcept {
  const std::uint64_t before = selection_.work();
  if (!isSelected_) {
    if (selection_.advance(work)) return false;
    isSelected_ = true;
  }
  std::uint64_t left = work - std::min(work, selection_.work() - before);
  const std::size_t count = selection_.puffs().size();
  const int next = 1 - shown_;
  const std::span<std::uint16_t> halfKeys(halfKeys_.data(), count), keys(keys_.data(), count);
  const std::span<DrawPuff> half(half_.data(), count), whole(lists_[next].data(), count);
  while (passesDone_ < 2) {
    if (left == 0 && count > 0) return false;
    const bool isFirst = passesDone_ == 0;
    const std::span<const std::uint16_t> fromKeys = isFirst ? selection_.keys() : halfKeys;
    if (!isPassBegun_) {
      isPassBegun_ = true;
      passMoved_ = 0;
      pass_ = RadixPass(passesDone_, fromKeys);
      left -= std::min<std::uint64_t>(left, count / 4);
    }
    const std::size_t moved = isFirst ? pass_.advance(left, fromKeys, selection_.puffs(), halfKeys, half)
                                      : pass_.advance(left, fromKeys, half, keys, whole);
    passMoved_ += moved;
    left -= moved;
    if (passMoved_ < count) return false;
    ++passesDone_;
    isPassBegun_ = false;
  }
  shown_ = next;
  count_ = count;
  isMade_ = true;
  isMaking_ = false;
  madeFor_ = makingFor_;
  lastWork_ = selection_.work() + 2 * (count + count / 4);
  return true;
}

}  // namespace cloudgen::runtime
