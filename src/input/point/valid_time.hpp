// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/time.hpp"

namespace cloudgen::input {

/// Sorted, each time once.
std::vector<base::UtcTime> ascending(std::vector<base::UtcTime> times);

/// Throws the InputError of a wanted time that the input (`times` ascending, not empty) does not have.
[[noreturn]] void failForTime(const std::string& where, base::UtcTime wanted,
                              const std::vector<base::UtcTime>& times);

}  // namespace cloudgen::input
