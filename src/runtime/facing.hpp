// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/selection.hpp"

namespace cloudgen::runtime {

inline constexpr std::size_t kMostLocked = 256;

/// Puffs that no longer turn to the eye, as it is inside half their radius: there a sprite would spin as one flies
/// through it (Wang 2004, "Realistic and fast cloud rendering"). Each keeps the facing that it had when the eye came
/// in, until it leaves.
class FacingLock {
 public:
  struct Locked {
    DrawPuff puff;
    Vec3 facing;  ///< a unit vector from the puff
  };

  /// Looks at the puffs of the clouds about the eye. Nothing is allocated; of more than kMostLocked the rest turns on.
  void update(const PackView& pack, const CloudSet& clouds, const Selection& selection, const Vec3& eye) noexcept;
  std::span<const Locked> locked() const noexcept { return {now_.data(), count_}; }

 private:
  Vec3 facingOf(const DrawPuff& puff, const Vec3& otherwise) const noexcept;

  std::array<Locked, kMostLocked> now_{}, before_{};
  std::size_t count_ = 0, countBefore_ = 0;
};

/// Where the sprite of a puff ends, in its widest deviations.
inline constexpr float kReach = 2.2f;

}  // namespace cloudgen::runtime
