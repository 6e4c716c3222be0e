// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/fidelity/card_scene.hpp"
#include "check/xsd/xml_parser.hpp"

namespace cloudgen::check {

/// What moves the nodes of an X3D document by its clock, a TimeSensor that says how many of its seconds are an hour.
class X3dFilm {
 public:
  /// Takes an element in document order.
  void take(std::string_view name, std::span<const XmlAttribute> attributes);
  /// Puts Transforms and Switches, by their DEFs, as they are so many seconds of the forecast after the start.
  void pose(double seconds, const std::map<std::string, std::uint32_t>& named, std::vector<CardNode>& nodes) const;

 private:
  struct Driver {
    std::vector<float> keys, values;
    std::size_t components() const { return keys.empty() ? 0 : values.size() / keys.size(); }
  };
  struct Route {
    std::string driver, driven, field;
  };
  std::map<std::string, Driver> drivers_;
  std::vector<Route> routes_;
  double cycleSeconds_ = 0, secondsAnHour_ = 0;
};

}  // namespace cloudgen::check
