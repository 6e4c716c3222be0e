// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace cloudgen::base {

/// Progress and cancel as one object that is passed in: library code reports, the caller shows it or not.
struct Progress {
  /// Called with the name of the stage and the share of it done (0..1); may be empty.
  std::function<void(std::string_view stage, double share)> report;
  /// True when the user wants to stop; may be empty.
  std::function<bool()> cancelled;

  /// Reports, and throws InterruptedError when the user wants to stop.
  void step(std::string_view stage, double share) const;
};

}  // namespace cloudgen::base
