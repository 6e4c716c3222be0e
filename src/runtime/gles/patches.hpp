// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace cloudgen::runtime::gles {

inline constexpr int kPatchesAcross = 256;

/// Patches of the ground, brighter and darker about 128, kPatchesAcross squared, that go on at their borders: value noise
/// in five octaves from a tenth of the side down. Throws std::bad_alloc.
std::vector<std::uint8_t> groundPatches();

}  // namespace cloudgen::runtime::gles
