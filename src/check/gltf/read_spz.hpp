// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "check/gltf/read_splats.hpp"

namespace cloudgen::check {

/// Unpacks splats from SPZ (Niantic Labs), versions 2 and 3 of the file: gzip of a header of 16 bytes and
/// columns. Lengths are in the file's units; the optical depth is what the opacity says. Returns how many
/// there were. Throws InputError, naming `where`, if the bytes are something else or too few.
std::size_t readPackedSplats(std::string_view bytes, const std::string& where,
                             const std::function<void(const ReadSplat&)>& visit);

}  // namespace cloudgen::check
