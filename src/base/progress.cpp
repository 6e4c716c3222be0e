// SPDX-License-Identifier: Apache-2.0
#include "base/progress.hpp"

#include "base/error.hpp"

namespace cloudgen::base {

void Progress::step(std::string_view stage, double share) const {
  if (cancelled && cancelled()) throw InterruptedError();
  if (report) report(stage, share);
}

}  // namespace cloudgen::base
