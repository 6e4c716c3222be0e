// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_nodes.hpp"

#include <array>

#include "base/text.hpp"
#include "writer/x3d/cloud_parts.hpp"

namespace cloudgen::writer {
namespace {

/// Steps of shadow from other clouds: clouds of one step share what they are drawn with.
constexpr int kShades = 4;

}  // namespace

void CloudNodes::cloud(std::uint32_t i, bool full) {
  const scene::Instance& instance = scene_.instances[i];
  nodes_.open("Transform");
  nodes_.vector("scale", glm::vec3(instance.scale), 4);
  nodes_.vector("translation", instance.position, 1);
  if (i < scene_.clouds.size()) record(scene_.clouds[i]);
  const scene::LitArchetype& lit = scene_.lit[instance.lit];
  const int shade = static_cast<int>(std::lround((1 - instance.sunlight) * (kShades - 1)));
  const std::string name = fmt::format("{}_yaw{}{}{}", scene_.archetypes[lit.archetype].name, lit.yawStep,
                                       shade > 0 ? fmt::format("_shade{}", shade) : "", full ? "" : "_far");
  if (defined_.insert(name).second)
    look(instance.lit, 1 - static_cast<float>(shade) / (kShades - 1), full, name);
  else
    nodes_.use("Group", "children", name);
  nodes_.close();
}

void CloudNodes::look(std::uint32_t lit, float sunlight, bool full, const std::string& name) {
  const base::Genus genus = scene_.archetypes[scene_.lit[lit].archetype].genus;
  nodes_.open("Group", "children", name);
  for (const CloudPart& part :
       (full ? fullParts : simpleParts)(scene_, lit, sunlight, shapes_.atlas(genus))) {
    if (!part.turns) {
      shapes_.write(genus, part.mesh);
      continue;
    }
    nodes_.open("Transform");
    nodes_.vector("translation", part.center, 1);
    nodes_.open("Billboard");
    nodes_.vector("axisOfRotation", glm::vec3(0), 0);
    shapes_.write(genus, part.mesh);
    nodes_.close();
    nodes_.close();
  }
  nodes_.close();
}

void CloudNodes::record(const scene::CloudRecord& cloud) {
  const std::string genus(base::abbreviation(cloud.genus)), id = std::to_string(cloud.id);
  const std::array<float, 3> measures{cloud.baseMeters, cloud.topMeters, cloud.opticalDepth};
  if (nodes_.encoding() == Encoding::Vrml97) {
    std::string numbers = "base_m ";
    base::appendFixed(numbers, measures[0], 0);
    numbers += " top_m ";
    base::appendFixed(numbers, measures[1], 0);
    numbers += " optical_depth ";
    base::appendFixed(numbers, measures[2], 2);
    nodes_.open("WorldInfo");
    nodes_.strings("info", std::vector<std::string>{"id " + id, "genus " + genus, "rule " + cloud.rule,
                                                    "cell " + std::to_string(cloud.cell), numbers});
    nodes_.string("title", "cloud");
    nodes_.close();
    return;
  }
  nodes_.open("MetadataSet", "metadata");
  nodes_.string("name", "cloud");
  nodes_.open("MetadataString", "value");
  nodes_.string("name", "id genus rule");
  nodes_.strings("value", std::vector<std::string>{id, genus, cloud.rule});
  nodes_.close();
  nodes_.open("MetadataInteger", "value");
  nodes_.string("name", "cell");
  nodes_.integers("value", std::array{static_cast<std::int32_t>(cloud.cell)});
  nodes_.close();
  nodes_.open("MetadataFloat", "value");
  nodes_.string("name", "base_m top_m optical_depth");
  nodes_.numbers("value", measures, 1, 2);
  nodes_.close();
  nodes_.close();
}

}  // namespace cloudgen::writer
