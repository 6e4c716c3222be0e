// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <cstdint>
#include <span>

#include "runtime/status.hpp"

namespace cloudgen::runtime {

/// The first thing that keeps bytes from being a pack that can be drawn; success means that PackView may walk it
/// without looking again. Allocates nothing.
Status soundnessOf(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace cloudgen::runtime
