// SPDX-License-Identifier: Apache-2.0
#include "input/grib/octets.hpp"

#include <bit>
#include <cmath>

#include "base/error.hpp"

namespace cloudgen::input::grib {

bool Octets::has(std::size_t octet, std::size_t length) const {
  return octet >= 1 && octet <= bytes_.size() && length <= bytes_.size() - (octet - 1);
}

std::uint64_t Octets::whole(std::size_t octet, std::size_t length) const {
  if (!has(octet, length)) throw base::InputError(where_, "has a section cut short", "fetch the file again");
  std::uint64_t value = 0;
  for (const char byte : bytes_.substr(octet - 1, length))
    value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

std::int64_t Octets::withSign(std::size_t octet, std::size_t length) const {
  const std::uint64_t sign = std::uint64_t{1} << (8 * length - 1), value = whole(octet, length);
  const auto size = static_cast<std::int64_t>(value & (sign - 1));
  return value & sign ? -size : size;
}

std::optional<std::uint64_t> Octets::wholeIfAny(std::size_t octet, std::size_t length) const {
  const std::uint64_t value = whole(octet, length), missing = ~std::uint64_t{0} >> (64 - 8 * length);
  return value == missing ? std::nullopt : std::optional(value);
}

std::optional<std::int64_t> Octets::withSignIfAny(std::size_t octet, std::size_t length) const {
  return wholeIfAny(octet, length) ? std::optional(withSign(octet, length)) : std::nullopt;
}

std::optional<double> Octets::scaledIfAny(std::size_t octet) const {
  const auto factor = withSignIfAny(octet, 1), value = withSignIfAny(octet + 1, 4);
  if (!factor || !value) return std::nullopt;
  return static_cast<double>(*value) * std::pow(10.0, static_cast<double>(-*factor));
}

double Octets::ieee(std::size_t octet) const {
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(whole(octet, 4))));
}

double Octets::ibm(std::size_t octet) const {
  const std::uint64_t bits = whole(octet, 4);
  const double fraction = static_cast<double>(bits & 0xffffff) / 16777216.0;
  const double size = fraction * std::pow(16.0, static_cast<double>(bits >> 24 & 0x7f) - 64);
  return bits & 0x80000000u ? -size : size;
}

}  // namespace cloudgen::input::grib
