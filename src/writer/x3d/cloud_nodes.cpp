// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "writer/x3d/cloud_record.hpp"
#include "writer/x3d/shades.hpp"

namespace cloudgen::writer {
namespace {

/// Steps of Instance::opticalDepthFactor, as powers of this.
constexpr float kDepthStep = 1.09f;
int depthStepOf(const scene::Instance& instance) {
  return static_cast<int>(std::lround(std::log(instance.opticalDepthFactor) / std::log(kDepthStep)));
}

const shape::Bounds& boxOf(const scene::Scene& scene, const scene::Instance& instance) {
  return scene.archetypes[scene.lit[instance.lit].archetype].bounds;
}

/// The longest side of a cloud before it is scaled.
float sizeOf(const scene::Scene& scene, const scene::Instance& instance) {
  const glm::vec3 sides = boxOf(scene, instance).upper - boxOf(scene, instance).lower;
  return std::max({sides.x, sides.y, sides.z});
}

base::Genus genusOf(const scene::Scene& scene, const scene::Instance& instance) {
  return scene.archetypes[scene.lit[instance.lit].archetype].genus;
}

/// What clouds of its name share.
CloudLook lookOf(const scene::Instance& instance) {
  return {instance.lit, sunlightOf(instance),
          std::pow(kDepthStep, static_cast<float>(depthStepOf(instance)))};
}

/// Of a cloud's own size: how far away it is drawn in full, at least and at most.
constexpr float kLeastSizes = 0.15f, kMostSizes = 0.25f;
constexpr std::array kFineToCoarse{MeshFineness::Fine, MeshFineness::Middle, MeshFineness::Coarse};

}  // namespace

float nearRange(const scene::Scene& scene, const scene::Instance& instance, float reachMeters) {
  const float size = sizeOf(scene, instance);
  return std::clamp(reachMeters, kLeastSizes * size, kMostSizes * size);
}

void CloudNodes::near(std::uint32_t i, float reachMeters, Beyond beyond) {
  const scene::Instance& instance = scene_.instances[i];
  const std::string name = nameOf(instance);
  open(i);
  if (!defined_.insert(name).second) {
    nodes_.use("LOD", "children", name);
    return nodes_.close();
  }
  const std::vector<CloudPart> full = partsIn(instance, CloudDetail::Full);
  const std::array<float, 3> beginnings = beginningsOf(instance, reachMeters);
  const std::size_t here = beyond == Beyond::Here ? beginnings.size() : static_cast<std::size_t>(finestWhole_);
  const auto pictures = std::span(kFineToCoarse).first(here);

  openLevels(instance, name, std::span(beginnings).first(beyond == Beyond::Here ? here : here + 1));
  parts(genusOf(scene_, instance), full, {});
  for (const MeshFineness fineness : pictures) picture(instance, fineness);
  if (beyond == Beyond::Elsewhere) empty();
  nodes_.close();
  nodes_.close();
}

void CloudNodes::whole(std::uint32_t i, std::optional<float> reachMeters) {
  const scene::Instance& instance = scene_.instances[i];
  const std::uint32_t archetype = scene_.lit[instance.lit].archetype;
  const std::string name =
      fmt::format("{}_{}_shade{}", reachMeters ? "Beyond" : "Whole", archetype, shadeOf(instance));
  film_.openFollower(i, instance);
  if (defined_.insert(name).second) {
    const std::array<float, 3> beginnings = beginningsOf(instance, reachMeters.value_or(0));
    const std::size_t first = static_cast<std::size_t>(finestWhole_) + (reachMeters ? 0 : 1);
    openLevels(instance, name, std::span(beginnings).subspan(first));
    if (reachMeters) empty();
    for (const MeshFineness fineness : kFineToCoarse)
      if (fineness >= finestWhole_) picture(instance, fineness);
    nodes_.close();
  } else {
    nodes_.use("LOD", "children", name);
  }
  nodes_.close();
}

std::array<float, 3> CloudNodes::beginningsOf(const scene::Instance& instance, float reachMeters) const {
  constexpr float kStep = 1.1f;  // they rise, whatever the pictures are
  const std::uint32_t archetype = scene_.lit[instance.lit].archetype;
  std::array<float, 3> beginnings{nearRange(scene_, instance, reachMeters)};
  for (std::size_t i = 1; i < beginnings.size(); ++i)
    beginnings[i] = std::max(meshes_.beginningOf(archetype, kFineToCoarse[i]), kStep * beginnings[i - 1] + 1);
  return beginnings;
}

void CloudNodes::empty() {
  nodes_.open("Group");
  nodes_.close();
}

/// Clouds of an archetype share it, whatever their heading.
void CloudNodes::picture(const scene::Instance& instance, MeshFineness fineness) {
  constexpr std::array kNames{"fine", "middle", "coarse"};
  const std::uint32_t archetype = scene_.lit[instance.lit].archetype;
  const std::string name = fmt::format("Picture_{}_{}_shade{}", archetype,
                                       kNames[static_cast<std::size_t>(fineness)], shadeOf(instance));
  if (!defined_.insert(name).second) return nodes_.use("Group", "children", name);
  nodes_.open("Group", "children", name);
  meshes_.write(nodes_, archetype, sunlightOf(instance), fineness);
  nodes_.close();
}

void CloudNodes::openLevels(const scene::Instance& instance, const std::string& def,
                            std::span<const float> ranges) {
  const shape::Bounds& box = boxOf(scene_, instance);
  nodes_.open("LOD", "children", def);
  nodes_.vector("center", glm::vec3(0, 0.5f * (box.lower.y + box.upper.y), 0), 1);
  nodes_.numbers("range", ranges, 1, 0);
}

void CloudNodes::fixed(std::uint32_t i, CloudDetail detail) {
  const std::string name = nameOf(scene_.instances[i]) + (detail == CloudDetail::Full ? "_full" : "_far");
  open(i);
  if (defined_.insert(name).second)
    parts(genusOf(scene_, scene_.instances[i]), partsIn(scene_.instances[i], detail), name);
  else
    nodes_.use("Group", "children", name);
  nodes_.close();
}

void CloudNodes::open(std::uint32_t i) {
  film_.openFollower(i, scene_.instances[i]);
  if (i < scene_.clouds.size()) writeRecord(nodes_, scene_.clouds[i]);
}

std::string CloudNodes::nameOf(const scene::Instance& instance) const {
  const scene::LitArchetype& lit = scene_.lit[instance.lit];
  const int shade = shadeOf(instance), depth = depthStepOf(instance);
  return fmt::format("{}_yaw{}{}{}", scene_.archetypes[lit.archetype].name, lit.yawStep,
                     shade > 0 ? fmt::format("_shade{}", shade) : "",
                     depth != 0 ? fmt::format("_depth{}{}", depth < 0 ? "m" : "", std::abs(depth)) : "");
}

std::vector<CloudPart> CloudNodes::partsIn(const scene::Instance& instance, CloudDetail detail) const {
  return partsOf(scene_, lookOf(instance), detail, coverings_.of(instance.lit, detail),
                 shapes_.atlas(genusOf(scene_, instance)));
}

void CloudNodes::parts(base::Genus genus, const std::vector<CloudPart>& parts, const std::string& def) {
  nodes_.open("Group", "children", def);
  for (const CloudPart& part : parts) {
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
