// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/flight.hpp"

#include <glm/geometric.hpp>

#include "writer/x3d/viewpoints.hpp"

namespace cloudgen::writer {
namespace {

constexpr float kMetersPerSecond = 200;
/// Share of a leg over which the view turns into the next.
constexpr float kTurning = 0.15f;

/// What is at a share of the whole way.
struct Stations {
  std::vector<float> keys, places, turns;
  std::vector<float> turnKeys;

  void addPlace(float key, const glm::vec3& place) {
    keys.push_back(key);
    places.insert(places.end(), {place.x, place.y, place.z});
  }
  void addTurn(float key, const glm::vec4& rotation) {
    turnKeys.push_back(key);
    turns.insert(turns.end(), {rotation.x, rotation.y, rotation.z, rotation.w});
  }
};

/// The places but those that are where the one before is.
std::vector<glm::vec3> distinct(const std::vector<glm::vec3>& places) {
  std::vector<glm::vec3> out;
  for (const glm::vec3& place : places)
    if (out.empty() || glm::distance(out.back(), place) > 1) out.push_back(place);
  return out;
}

Stations stationsOf(const std::vector<glm::vec3>& places, float length) {
  Stations stations;
  float gone = 0;
  stations.addPlace(0, places.front());
  for (std::size_t leg = 0; leg + 1 < places.size(); ++leg) {
    const float step = glm::distance(places[leg], places[leg + 1]) / length;
    const glm::vec4 ahead = rotationTowards(places[leg], places[leg + 1]);
    const bool isFirst = leg == 0, isLast = leg + 2 == places.size();
    stations.addTurn(isFirst ? 0 : gone + kTurning * step, ahead);
    gone = isLast ? 1 : gone + step;
    stations.addTurn(isLast ? 1 : gone - kTurning * step, ahead);
    stations.addPlace(gone, places[leg + 1]);
  }
  return stations;
}

}  // namespace

void writeFlight(NodeWriter& nodes, const std::vector<glm::vec3>& given) {
  const auto places = distinct(given);
  if (places.size() < 2) return;
  float length = 0;
  for (std::size_t leg = 0; leg + 1 < places.size(); ++leg)
    length += glm::distance(places[leg], places[leg + 1]);
  const Stations stations = stationsOf(places, length);
  nodes.open("Viewpoint", "children", "View_Flight");
  nodes.string("description", "Along the flight path");
  nodes.rotation("orientation", rotationTowards(places[0], places[1]));
  nodes.vector("position", places[0], 1);
  nodes.close();
  nodes.open("TimeSensor", "children", "Flight_Clock");
  nodes.number("cycleInterval", std::max(1.0f, length / kMetersPerSecond), 1);
  nodes.close();
  nodes.open("PositionInterpolator", "children", "Flight_Places");
  nodes.numbers("key", stations.keys, 1, 6);
  nodes.numbers("keyValue", stations.places, 3, 1);
  nodes.close();
  nodes.open("OrientationInterpolator", "children", "Flight_Turns");
  nodes.numbers("key", stations.turnKeys, 1, 6);
  nodes.numbers("keyValue", stations.turns, 4, 5);
  nodes.close();
  // Nobody flies, and nothing is drawn again, before the viewpoint is chosen.
  nodes.route("View_Flight", "bindTime", "Flight_Clock", "startTime");
  for (const auto& [interpolator, field] :
       {std::pair{"Flight_Places", "position"}, {"Flight_Turns", "orientation"}}) {
    nodes.route("Flight_Clock", "fraction_changed", interpolator, "set_fraction");
    nodes.route(interpolator, "value_changed", "View_Flight", field);
  }
}

}  // namespace cloudgen::writer
