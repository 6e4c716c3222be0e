// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/x3d_film.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "check/rules/keyframes.hpp"
#include "check/rules/numbers.hpp"

namespace cloudgen::check {
namespace {

std::string_view textOf(std::span<const XmlAttribute> attributes, std::string_view name) {
  const auto found = std::ranges::find(attributes, name, &XmlAttribute::name);
  return found == attributes.end() ? std::string_view{} : std::string_view(found->value);
}

template <class Number>
std::vector<float> listOf(std::string_view text) {
  std::vector<float> list;
  forEachNumber<Number>(text, [&](Number number) { list.push_back(static_cast<float>(number)); });
  return list;
}

}  // namespace

void X3dFilm::take(std::string_view name, std::span<const XmlAttribute> attributes) {
  const auto text = [&](std::string_view attribute) { return textOf(attributes, attribute); };
  if (name == "TimeSensor") {
    const auto cycle = listOf<double>(text("cycleInterval"));
    const auto hour = listOf<double>(text("description").substr(0, text("description").find(' ')));
    if (!cycle.empty()) cycleSeconds_ = cycle[0];
    if (!hour.empty()) secondsAnHour_ = hour[0];
  } else if (name == "PositionInterpolator") {
    drivers_[std::string(text("DEF"))] = {listOf<double>(text("key")), listOf<double>(text("keyValue"))};
  } else if (name == "IntegerSequencer") {
    drivers_[std::string(text("DEF"))] = {listOf<double>(text("key")), listOf<std::int64_t>(text("keyValue"))};
  } else if (name == "ROUTE" && text("fromField") == "value_changed") {
    routes_.push_back({std::string(text("fromNode")), std::string(text("toNode")), std::string(text("toField"))});
  }
}

void X3dFilm::pose(double seconds, const std::map<std::string, std::uint32_t>& named,
                   std::vector<CardNode>& nodes) const {
  if (!(cycleSeconds_ > 0)) return;
  const auto share = static_cast<float>(seconds / 3600 * secondsAnHour_ / cycleSeconds_);
  for (const Route& route : routes_) {
    const auto driver = drivers_.find(route.driver);
    const auto driven = named.find(route.driven);
    if (driver == drivers_.end() || driven == named.end()) continue;
    const auto& [keys, values] = driver->second;
    CardNode& node = nodes[driven->second];
    if (keys.empty()) continue;
    const Keyframe time = keyframeAt(keys, share);
    if (driver->second.components() == 1 && route.field == "whichChoice") node.choice = std::lround(values[time.before]);
    if (driver->second.components() != 3) continue;
    const auto at = [&](std::size_t k) { return glm::vec3(values[3 * k], values[3 * k + 1], values[3 * k + 2]); };
    const glm::vec3 value = glm::mix(at(time.before), at(time.after), time.share);
    if (route.field == "translation") node.matrix[3] = glm::vec4(value, 1);
    if (route.field == "scale")
      for (int axis = 0; axis < 3; ++axis)
        if (const float length = glm::length(node.matrix[axis]); length > 0) node.matrix[axis] *= value[axis] / length;
  }
}

}  // namespace cloudgen::check
