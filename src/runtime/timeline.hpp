// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "runtime/pack_view.hpp"

namespace cloudgen::runtime {

/// The clouds of a pack at a time between its keyframes: places and sizes run straight from one to the next, and a
/// cloud that comes or goes changes its optical depth.
class Timeline {
 public:
  Timeline() = default;
  /// The pack must stay where it is. Throws std::bad_alloc.
  explicit Timeline(const PackView& pack);

  bool moves() const noexcept { return !moved_.empty(); }
  /// First and last time, seconds from the pack's valid time; 0 and 0 for a sky that stands still.
  double firstSeconds() const noexcept { return first_; }
  double lastSeconds() const noexcept { return last_; }
  /// Times before the first and after the last are taken there. Nothing is allocated.
  void setTime(double seconds) noexcept;
  /// As they stand at that time.
  std::span<const pack::Instance> instances() const noexcept {
    return moves() ? std::span<const pack::Instance>(moved_) : pack_->instances();
  }
  /// No cloud ever reaches out of its tile by more.
  float tileSlackMeters() const noexcept { return slack_; }

 private:
  const PackView* pack_ = nullptr;
  std::vector<pack::Instance> moved_;
  double first_ = 0, last_ = 0;
  float slack_ = 0;
};

}  // namespace cloudgen::runtime
