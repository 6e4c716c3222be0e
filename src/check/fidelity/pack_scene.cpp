// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/pack/pack_motion.hpp"
#include "check/pack/read_pack.hpp"
#include "check/pack/validate_pack.hpp"

namespace cloudgen::check {
namespace {

constexpr std::uint64_t kMostPuffs = 50'000'000;

std::optional<base::Genus> genusOf(const flatbuffers::String* text) {
  return text ? base::genusFromName(text->string_view()) : std::nullopt;
}

/// The puffs of the first level, where they stand.
void addPuffs(const pack::RuntimePack& root, const pack::Instance& cloud, WrittenScene& scene) {
  const pack::Archetype& archetype = *root.archetypes()->Get(cloud.archetype());
  const pack::Level& level = *archetype.levels()->Get(0);
  const float yaw = static_cast<float>(cloud.yaw_step()) * std::numbers::pi_v<float> / 8;
  const glm::quat turn = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
  for (std::uint32_t p = level.first(); p < level.first() + level.count(); ++p) {
    const PackPuff puff = unpacked(*root.puffs()->Get(p), vec3(*archetype.center_lower()),
                                   vec3(*archetype.center_upper()));
    glm::mat3 halfAxes = glm::mat3_cast(turn * puff.rotation);
    for (int axis = 0; axis < 3; ++axis) halfAxes[axis] *= cloud.scale() * puff.sigma[axis];
    scene.blobs.push_back(volumeBlob(vec3(cloud.position()) + cloud.scale() * (turn * puff.center), halfAxes,
                                     cloud.optical_depth_factor() * puff.opticalDepth));
  }
}

}  // namespace

WrittenScene readPackScene(const std::filesystem::path& file, double seconds) {
  WrittenScene scene = readPackScene(base::readFile(file), file.string(), seconds);
  scene.file = file.filename().string();
  return scene;
}

WrittenScene readPackScene(std::string_view bytes, const std::string& where, double seconds) {
  const ValidationResult result = validatePack(bytes, where);
  if (!result.valid())
    throw base::InputError(where, "is not a sound pack: " + result.findings.front().message,
                           "cloudgen validate says more; build it again");
  std::string problem;
  const pack::RuntimePack& root = *packIn(bytes, problem);
  const std::vector<pack::Instance> clouds = cloudsAt(root, seconds);
  std::uint64_t puffs = 0;
  for (const pack::Instance& cloud : clouds)
    puffs += root.archetypes()->Get(cloud.archetype())->levels()->Get(0)->count();
  if (puffs > kMostPuffs)
    throw base::InputError(where, fmt::format("draws {} puffs, more than can be read", puffs),
                           "is it a scene of cloudgen?");
  WrittenScene scene{where, "pack", {}, {}, {}, 0};
  scene.blobs.reserve(puffs);
  for (const pack::Instance& cloud : clouds) {
    addPuffs(root, cloud, scene);
    const pack::Archetype& archetype = *root.archetypes()->Get(cloud.archetype());
    scene.clouds.push_back({vec3(cloud.position()), genusOf(archetype.genus()),
                            genusOf(root.atlases()->Get(archetype.atlas())->genus())});
  }
  return scene;
}

}  // namespace cloudgen::check
