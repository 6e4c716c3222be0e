// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace cloudgen::check {

/// The components that a profile brings, and their levels (ISO/IEC 19775-1 annexes A to H); "Full" and
/// unknown names bring everything at level 5.
std::map<std::string, int, std::less<>> componentsOf(std::string_view profile);

}  // namespace cloudgen::check
