// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/geo_scene.hpp"

#include "writer/x3d/environment.hpp"
#include "writer/x3d/viewpoints.hpp"

namespace cloudgen::writer {
namespace {

constexpr const char* kOrigin = "Origin";

/// Latitude, longitude and height, as geoSystem GD has them.
glm::dvec3 placeOf(const base::LocalFrame& frame, const glm::dvec3& inScene) {
  const glm::dvec3 place = frame.toGeographic(inScene);
  return {place.y, place.x, place.z};
}

/// The same direction from true east and north, as a viewpoint on the globe has it, which the frame's x and -z are not away
/// from its middle.
glm::vec3 fromTrueEast(const glm::vec3& direction, const glm::vec2& east) {
  return {east.x * direction.x + east.y * direction.z, direction.y, east.x * direction.z - east.y * direction.x};
}

void writeView(NodeWriter& nodes, const base::LocalFrame& frame, const View& view, bool isFirst) {
  const glm::dvec3 eye = placeOf(frame, glm::dvec3(view.eye));
  const glm::vec3 ahead = fromTrueEast(view.target - view.eye, glm::vec2(frame.eastDirection(eye.y, eye.x)));
  nodes.open("GeoViewpoint", "children", view.name);
  nodes.string("description", view.description);
  nodes.rotation("orientation", rotationTowards(glm::vec3(0), ahead));
  nodes.place("position", eye);
  if (isFirst) return;  // it holds the origin
  nodes.use("GeoOrigin", "geoOrigin", kOrigin);
  nodes.close();
}

}  // namespace

void writeGeoScene(const scene::Scene& scene, const Stage& stage, const std::filesystem::path& folder) {
  const base::GeoBox& box = scene.frame.box();
  const glm::dvec3 tangent(box.centerLatitude(), box.centerLongitude(), 0);
  const auto nodes = nodeWriter(Encoding::Xml, folder / "scene.geo.x3d");
  nodes->start(headOf(scene, stage), "Geospatial");
  writeSurroundings(*nodes, scene, stage);
  bool isFirst = true;
  for (const View& view : viewsOf(scene, stage)) {
    writeView(*nodes, scene.frame, view, isFirst);
    if (isFirst) {
      // What is drawn is given in metres from here: viewers reckon in floats.
      nodes->open("GeoOrigin", "geoOrigin", kOrigin);
      nodes->place("geoCoords", tangent);
      nodes->boolean("rotateYUp", true);
      nodes->close();
      nodes->close();
    }
    isFirst = false;
  }
  nodes->open("GeoLocation");
  nodes->place("geoCoords", tangent);
  nodes->use("GeoOrigin", "geoOrigin", kOrigin);
  nodes->open("Transform");
  nodes->vector("translation", -glm::vec3(scene.frame.toScene(tangent.y, tangent.x, 0)), 1);
  nodes->open("Inline");
  nodes->strings("url", std::vector<std::string>{"scene.x3d"});
  nodes->close();
  nodes->close();
  nodes->close();
  nodes->finish();
}

}  // namespace cloudgen::writer
