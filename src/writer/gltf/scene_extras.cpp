// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/scene_extras.hpp"

#include <nlohmann/json.hpp>

namespace cloudgen::writer::gltf {

nlohmann::json arrayOf(glm::dvec3 values) { return {values.x, values.y, values.z}; }

nlohmann::json sceneExtras(const scene::Scene& scene) {
  const base::GeoBox& box = scene.frame.box();
  const glm::dvec3 origin = scene.frame.toGeographic(glm::dvec3(0));
  return {{"source",
           {{"files", scene.provenance.files},
            {"format", scene.provenance.format},
            {"model", scene.provenance.model},
            {"run", scene.provenance.run}}},
          {"valid_time", base::isoText(scene.validTime)},
          {"bbox", {box.west, box.south, box.east, box.north}},
          {"frame",
           {{"definition", scene.frame.definition()},
            {"axes", "x east, y up (metres above mean sea level), z south"},
            {"origin_longitude", origin.x},
            {"origin_latitude", origin.y}}},
          {"seed", std::to_string(scene.seed)},
          {"sun",
           {{"azimuth_degrees", scene.sun.azimuthDegrees},
            {"elevation_degrees", scene.sun.elevationDegrees},
            {"direction", arrayOf(scene.sun.direction)}}},
          {"clouds", scene.instances.size()}};
}

}  // namespace cloudgen::writer::gltf
