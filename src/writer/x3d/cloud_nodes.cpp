// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace cloudgen::writer {
namespace {

/// Steps of shadow from other clouds, 0 in full sun: clouds of one step share what they are drawn with.
constexpr int kShades = 4;
int shadeOf(const scene::Instance& instance) {
  return static_cast<int>(std::lround((1 - instance.sunlight) * (kShades - 1)));
}
float sunlightOf(const scene::Instance& instance) {
  return 1 - static_cast<float>(shadeOf(instance)) / (kShades - 1);
}

/// Steps of Instance::opticalDepthFactor, as powers of this.
constexpr float kDepthStep = 1.09f;
int depthStepOf(const scene::Instance& instance) {
  return static_cast<int>(std::lround(std::log(instance.opticalDepthFactor) / std::log(kDepthStep)));
}

/// What clouds of its name share.
CloudLook lookOf(const scene::Instance& instance) {
  return {instance.lit, sunlightOf(instance),
          std::pow(kDepthStep, static_cast<float>(depthStepOf(instance)))};
}

/// A cloud is drawn in full up to about so many times its own size away, at least and at most.
constexpr float kLeastSizes = 0.75f, kMostSizes = 2;

}  // namespace

void CloudNodes::inLevels(std::uint32_t i, float rangeMeters) {
  const scene::Instance& instance = scene_.instances[i];
  const std::string name = nameOf(instance);
  open(i);
  if (defined_.insert(name).second) {
    const shape::Bounds& box = scene_.archetypes[scene_.lit[instance.lit].archetype].bounds;
    const glm::vec3 sides = box.upper - box.lower;
    const float size = std::max({sides.x, sides.y, sides.z});
    nodes_.open("LOD", "children", name);
    nodes_.vector("center", glm::vec3(0, 0.5f * (box.lower.y + box.upper.y), 0), 1);
    nodes_.numbers("range", std::array{std::clamp(rangeMeters, kLeastSizes * size, kMostSizes * size)}, 1, 0);
    parts(instance, CloudDetail::Full, {});
    nodes_.open("Group");
    pictures_->writeCloud(nodes_, shapes_, instance.lit, sunlightOf(instance));
    nodes_.close();
    nodes_.close();
  } else {
    nodes_.use("LOD", "children", name);
  }
  nodes_.close();
}

void CloudNodes::fixed(std::uint32_t i, CloudDetail detail) {
  const std::string name = nameOf(scene_.instances[i]) + (detail == CloudDetail::Full ? "_full" : "_far");
  open(i);
  if (defined_.insert(name).second)
    parts(scene_.instances[i], detail, name);
  else
    nodes_.use("Group", "children", name);
  nodes_.close();
}

void CloudNodes::open(std::uint32_t i) {
  const scene::Instance& instance = scene_.instances[i];
  nodes_.open("Transform");
  nodes_.vector("scale", glm::vec3(instance.scale), 4);
  nodes_.vector("translation", instance.position, 1);
  if (i < scene_.clouds.size()) record(scene_.clouds[i]);
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

std::string CloudNodes::nameOf(const scene::Instance& instance) const {
  const scene::LitArchetype& lit = scene_.lit[instance.lit];
  const int shade = shadeOf(instance), depth = depthStepOf(instance);
  return fmt::format("{}_yaw{}{}{}", scene_.archetypes[lit.archetype].name, lit.yawStep,
                     shade > 0 ? fmt::format("_shade{}", shade) : "",
                     depth != 0 ? fmt::format("_depth{}{}", depth < 0 ? "m" : "", std::abs(depth)) : "");
}

void CloudNodes::parts(const scene::Instance& instance, CloudDetail detail, const std::string& def) {
  const base::Genus genus = scene_.archetypes[scene_.lit[instance.lit].archetype].genus;
  nodes_.open("Group", "children", def);
  for (const CloudPart& part :
       partsOf(scene_, lookOf(instance), detail, coverings_.of(instance.lit, detail), shapes_.atlas(genus))) {
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

}  // namespace cloudgen::writer
