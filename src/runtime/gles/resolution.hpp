// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

namespace cloudgen::runtime::gles {

/// How finely clouds are drawn, by what the frames take. It gets coarser at once and finer only after a while, so that it
/// does not swing.
class Resolution {
 public:
  Resolution() = default;
  Resolution(float finest, float targetMilliseconds) : finest_(finest), target_(targetMilliseconds) {
    while (step_ + 1 < kSteps.size() && kSteps[step_] > finest_) ++step_;
  }

  /// Share of the picture's width and height.
  float scale() const noexcept { return std::min(kSteps[step_], finest_); }
  void tell(double frameMilliseconds) noexcept {
    if (!(target_ > 0) || !(frameMilliseconds > 0)) return;
    slow_ = frameMilliseconds > target_ ? slow_ + 1 : 0;
    fast_ = frameMilliseconds < kRoom * target_ ? fast_ + 1 : 0;
    if (slow_ >= kSlowFrames && step_ + 1 < kSteps.size()) ++step_, slow_ = 0;
    if (fast_ >= kFastFrames && step_ > 0 && kSteps[step_ - 1] <= finest_) --step_, fast_ = 0;
  }

 private:
  static constexpr std::array<float, 6> kSteps{1.0f, 0.75f, 0.5f, 0.375f, 0.25f, 0.1875f};
  /// A step finer takes up to 2.3 times as long.
  static constexpr double kRoom = 0.4;
  static constexpr int kSlowFrames = 2, kFastFrames = 20;

  float finest_ = 1, target_ = 0;
  std::size_t step_ = 0;
  int slow_ = 0, fast_ = 0;
};

}  // namespace cloudgen::runtime::gles
