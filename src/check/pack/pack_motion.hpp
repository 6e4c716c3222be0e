// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "check/pack/read_pack.hpp"

namespace cloudgen::check {

/// The clouds of a sound pack as they stand so many seconds after its valid time, those that are not there left out.
std::vector<pack::Instance> cloudsAt(const pack::RuntimePack& root, double seconds);

}  // namespace cloudgen::check
