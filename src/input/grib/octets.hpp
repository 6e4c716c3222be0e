// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::input::grib {

/// Numbers of a GRIB section by octet, counted from 1 as in the Manual on Codes, big-endian. Throws
/// InputError that names `where` for octets past the end.
class Octets {
 public:
  Octets(std::string_view bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}

  std::size_t size() const { return bytes_.size(); }
  const std::string& where() const { return where_; }
  bool has(std::size_t octet, std::size_t length = 1) const;

  /// 1 to 8 octets.
  std::uint64_t whole(std::size_t octet, std::size_t length) const;
  /// The first bit is the sign.
  std::int64_t withSign(std::size_t octet, std::size_t length) const;
  /// Nothing where all bits are set.
  std::optional<std::uint64_t> wholeIfAny(std::size_t octet, std::size_t length) const;
  std::optional<std::int64_t> withSignIfAny(std::size_t octet, std::size_t length) const;
  /// A scale factor (one octet) before a value of four: value / 10^factor; nothing where either is missing.
  std::optional<double> scaledIfAny(std::size_t octet) const;
  double ieee(std::size_t octet) const;  ///< four octets
  double ibm(std::size_t octet) const;   ///< four octets, base 16

 private:
  std::string_view bytes_;
  std::string where_;
};

}  // namespace cloudgen::input::grib
