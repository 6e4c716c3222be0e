// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/scene_extras.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "writer/film/film.hpp"

namespace cloudgen::writer::gltf {

nlohmann::json arrayOf(glm::dvec3 values) { return {values.x, values.y, values.z}; }

/// Heights in whole metres, as they are made.
nlohmann::json terrainExtras(const base::HeightField& terrain) {
  std::vector<long> heights;
  for (const float height : terrain.heights) heights.push_back(std::lround(height));
  return {{"columns", terrain.columns},
          {"rows", terrain.rows},
          {"origin", {terrain.origin.x, terrain.origin.y}},
          {"step", {terrain.step.x, terrain.step.y}},
          {"heights_m", heights}};
}

nlohmann::json sceneExtras(const scene::Scene& scene) {
  const base::GeoBox& box = scene.frame.box();
  const glm::dvec3 origin = scene.frame.toGeographic(glm::dvec3(0));
  nlohmann::json extras{{"source",
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
                        {"moonlight", scene.sky.moonlight},
                        {"clouds", scene.instances.size()}};
  if (const Film film(scene); film.moves())
    extras["film"] = {{"description", film.description()},
                      {"seconds", film.seconds()},
                      {"seconds_an_hour", kFilmSecondsPerHour}};
  if (!scene.terrain.empty()) extras["terrain"] = terrainExtras(scene.terrain);
  return extras;
}

}  // namespace cloudgen::writer::gltf
