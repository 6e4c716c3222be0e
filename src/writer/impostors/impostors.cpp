// SPDX-License-Identifier: Apache-2.0
#include "writer/impostors/impostors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/file.hpp"
#include "image/impostor.hpp"

namespace cloudgen::writer {
namespace {

using Json = nlohmann::ordered_json;

constexpr image::ImpostorOptions kViews{.viewsAcross = 6, .tilePixels = 48, .detail = true};
constexpr std::string_view kFolder = "impostors";

double millimeters(double meters) { return std::round(1000 * meters) / 1000; }
Json placeOf(const glm::vec3& point) { return {millimeters(point.x), millimeters(point.y), millimeters(point.z)}; }

double headingDegrees(int yawStep) { return 360.0 * yawStep / scene::kYawSteps; }

/// The sun in the axes of a cloud that is turned.
light::Sun turnedBack(light::Sun sun, int yawStep) {
  sun.direction = glm::angleAxis(-scene::yawRadians(yawStep), glm::vec3(0, 1, 0)) * sun.direction;
  return sun;
}

Json writeAtlas(const scene::Scene& scene, const scene::LitArchetype& lit, const std::filesystem::path& folder) {
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  const image::ImpostorAtlas atlas =
      image::bakeImpostor(archetype.puffs, lit.puffs, turnedBack(scene.sun, lit.yawStep), kViews, {});
  const std::string name = fmt::format("{}/{}_h{}", kFolder, archetype.name, lit.yawStep);
  const std::string color = fmt::format("{}.png", name), depth = fmt::format("{}.depth.png", name);
  image::writePng(folder / color, atlas.color);
  base::writeFile(folder / depth, image::depthPng(atlas));
  return {{"archetype", archetype.name},
          {"genus", base::abbreviation(archetype.genus)},
          {"heading_degrees", headingDegrees(lit.yawStep)},
          {"color", color},
          {"depth", depth},
          {"center_m", placeOf(atlas.center)},
          {"radius_m", millimeters(atlas.radiusMeters)}};
}

}  // namespace

void writeImpostors(const scene::Scene& scene, const Destination& destination) {
  std::error_code error;
  std::filesystem::create_directories(destination.folder / kFolder, error);
  if (error)
    throw base::OutputError((destination.folder / kFolder).string(), "cannot be made: " + error.message(),
                            "check the output folder");
  Json file{{"cloudgen_impostors", 1},
            {"views_across", kViews.viewsAcross},
            {"tile_pixels", kViews.tilePixels},
            {"sun", {{"azimuth_degrees", scene.sun.azimuthDegrees}, {"elevation_degrees", scene.sun.elevationDegrees}}},
            {"atlases", Json::array()},
            {"clouds", Json::array()}};
  for (std::size_t i = 0; i < scene.lit.size(); ++i) {
    destination.progress.step("impostors", static_cast<double>(i) / static_cast<double>(scene.lit.size()));
    file["atlases"].push_back(writeAtlas(scene, scene.lit[i], destination.folder));
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& cloud = scene.instances[i];
    file["clouds"].push_back({{"id", scene.clouds[i].id},
                              {"atlas", cloud.lit},
                              {"position_m", placeOf(cloud.position)},
                              {"scale", cloud.scale},
                              {"optical_depth_factor", cloud.opticalDepthFactor},
                              {"sunlight", cloud.sunlight}});
  }
  base::writeFile(destination.folder / "impostors.json", file.dump(1) + "\n");
  destination.progress.step("impostors", 1);
}

}  // namespace cloudgen::writer
