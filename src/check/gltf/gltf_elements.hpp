// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace cloudgen::check {

using Json = nlohmann::json;
using Count = std::uint64_t;

/// A whole number of an object, if it is one and no larger than sums of two can be.
inline std::optional<Count> integer(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_number_integer() ||
      (found->is_number_integer() && !found->is_number_unsigned()))
    return {};
  const Count value = found->get<Count>();
  return value > (Count{1} << 40) ? std::nullopt : std::optional(value);  // sums of two stay exact
}

/// An array of an object; an empty one if there is none.
inline const Json& list(const Json& object, const char* key) {
  static const Json empty = Json::array();
  if (!object.is_object()) return empty;
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : empty;
}

/// A member of an object; null if there is none.
inline const Json& member(const Json& object, const char* key) {
  static const Json nothing;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : nothing;
}

/// Bytes of a component type, 0 if it is none.
inline Count componentBytes(Count type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

/// Numbers of an accessor type, 0 if it is none.
inline Count componentsOf(const Json& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

/// An accessor as bytes: nothing in it if it has no buffer view or is broken.
struct Elements {
  bool known = false;
  Count count = 0, componentType = 0, components = 0;
  std::string_view bytes;
  Count stride = 0;
  bool normalized = false;

  bool isFloat() const { return componentType == 5126; }
  /// One number of an element, normalized integers as 0..1 or -1..1. The element must be there.
  double number(Count element, Count component) const {
    const char* at = bytes.data() + element * stride + component * componentBytes(componentType);
    const auto as = [&](auto value, double whole) {
      std::memcpy(&value, at, sizeof value);
      return normalized ? std::max(static_cast<double>(value) / whole, -1.0) : static_cast<double>(value);
    };
    switch (componentType) {
      case 5120:
        return as(std::int8_t{}, 127);
      case 5121:
        return as(std::uint8_t{}, 255);
      case 5122:
        return as(std::int16_t{}, 32767);
      case 5123:
        return as(std::uint16_t{}, 65535);
      case 5125:
        return as(std::uint32_t{}, 4294967295.0);
      default:
        float value = 0;
        std::memcpy(&value, at, sizeof value);
        return static_cast<double>(value);
    }
  }
};

}  // namespace cloudgen::check
