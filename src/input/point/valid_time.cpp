// SPDX-License-Identifier: Apache-2.0
#include "input/point/valid_time.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace cloudgen::input {

std::vector<base::UtcTime> ascending(std::vector<base::UtcTime> times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void failForTime(const std::string& where, base::UtcTime wanted, const std::vector<base::UtcTime>& times) {
  throw base::InputError(
      where, fmt::format("has nothing for {}", base::isoText(wanted)),
      times.size() == 1
          ? fmt::format("its only time is {}", base::isoText(times.front()))
          : fmt::format("its {} times run from {} to {}; `cloudgen inspect` lists them", times.size(),
                        base::isoText(times.front()), base::isoText(times.back())));
}

}  // namespace cloudgen::input
