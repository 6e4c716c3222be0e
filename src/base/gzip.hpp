// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cloudgen::base {

/// The bytes as a gzip member (RFC 1952) without name and time: the same bytes in, the same bytes out.
std::string gzipped(std::string_view bytes);

/// True of bytes that begin as gzip does.
bool isGzip(std::string_view bytes);

/// What gzip members hold. Throws InputError, naming `where`, if they are broken or hold more than `limitBytes`.
std::string unzipped(std::string_view bytes, const std::string& where, std::uint64_t limitBytes);

}  // namespace cloudgen::base
