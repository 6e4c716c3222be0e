// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "runtime/draw_list.hpp"
#include "runtime/endless.hpp"
#include "runtime/facing.hpp"
#include "runtime/lighting.hpp"
#include "runtime/timeline.hpp"

namespace cloudgen::runtime {

struct RuntimeOptions {
  DetailOptions detail;
  LazyOptions lazy;
};

/// What to draw, valid until the next update.
struct Frame {
  std::span<const DrawPuff> puffs;  ///< the farthest first; their instances are those of `clouds`
  std::span<const pack::Instance> clouds;
  std::span<const FacingLock::Locked> locked;  ///< those that keep their facing
  bool puffsChanged = false, cloudsChanged = false;
  float orderErrorMeters = 0;  ///< DrawList
};

/// A pack that is flown through: open it, then once a frame say what has changed and `update`. Nothing throws, and
/// nothing is allocated but by open and startEndless. One thread at a time.
class Runtime {
 public:
  /// Opens a file. On failure the runtime is empty.
  Status open(const char* path, const RuntimeOptions& options = {}) noexcept;
  /// The same of bytes that start at a multiple of 8 and outlive the runtime.
  Status open(std::span<const std::uint8_t> bytes, const RuntimeOptions& options = {}) noexcept;
  /// From the pack's own sky to one without end, made of its archetypes.
  Status startEndless(const EndlessOptions& options) noexcept;

  bool empty() const noexcept { return state_ == nullptr; }
  const PackView& pack() const noexcept { return state_->pack; }
  const Lighting& lighting() const noexcept { return state_->lighting; }
  /// The most clouds and puffs that a frame may have, until the next startEndless.
  std::size_t mostClouds() const noexcept;
  std::size_t mostPuffs() const noexcept { return state_->list.capacity(); }
  /// Height of the ground under the clouds.
  float groundMeters() const noexcept;
  /// Lights the puffs anew: costs about 0.1 microseconds a colour (Lighting::colors).
  void setSun(const SunPlace& sun) noexcept { state_->lighting.setSun(sun); }
  /// Seconds from the pack's valid time; without keyframes nothing moves.
  void setTime(double seconds) noexcept;
  /// What this camera sees.
  Frame update(const Camera& camera) noexcept;

 private:
  struct State {
    PackView pack;
    RuntimeOptions options;
    Timeline timeline;
    Lighting lighting;
    DrawList list;
    FacingLock facing;
    EndlessSky endless;
    bool isEndless = false, cloudsChanged = true;
  };
  Status finish(std::unique_ptr<State> state, Status opened, const RuntimeOptions& options) noexcept;

  std::unique_ptr<State> state_;
};

}  // namespace cloudgen::runtime
