// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "base/thread.hpp"
#include "light/relief.hpp"
#include "light/shade.hpp"
#include "writer/gltf/cloud_mesh.hpp"
#include "writer/gltf/film_animation.hpp"
#include "writer/gltf/glb_file.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/gltf/scene_extras.hpp"
#include "writer/pictures/cloud_pictures.hpp"

namespace cloudgen::writer {
namespace {

using namespace gltf;

/// Clouds that get more of the sun than this are drawn as if they got all of it.
constexpr float kSunny = 0.98f;
/// Cells along a side of the ground where there is no terrain.
constexpr int kGroundCells = 64;

/// The instances of each lit archetype, ascending.
std::vector<std::vector<std::uint32_t>> instancesByLight(const scene::Scene& scene) {
  std::vector<std::vector<std::uint32_t>> groups(scene.lit.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) groups[scene.instances[i].lit].push_back(i);
  return groups;
}

/// The pictures of an archetype are the same for all of its clouds: with their mean optical-depth factor,
/// each by the area that it covers.
std::vector<float> meanFactors(const scene::Scene& scene) {
  std::vector<glm::dvec2> sums(scene.archetypes.size(), glm::dvec2(0));
  for (const scene::Instance& cloud : scene.instances) {
    const double area = static_cast<double>(cloud.scale) * static_cast<double>(cloud.scale);
    sums[scene.lit[cloud.lit].archetype] +=
        glm::dvec2(area * static_cast<double>(cloud.opticalDepthFactor), area);
  }
  std::vector<float> factors;
  for (const glm::dvec2& sum : sums) factors.push_back(sum.y > 0 ? static_cast<float>(sum.x / sum.y) : 1);
  return factors;
}

/// What is drawn of each lit archetype.
std::vector<std::vector<CloudPicture>> shellsOf(const scene::Scene& scene,
                                                const std::vector<std::vector<std::uint32_t>>& groups) {
  constexpr PictureSize kSize{1.5e6, 128};
  const auto factors = meanFactors(scene);
  const auto drawn = std::ranges::count_if(groups, [](const auto& group) { return !group.empty(); });
  const int pixels = pixelsOfEach(static_cast<std::size_t>(drawn), kShellSquares, kSize);
  std::vector<std::vector<CloudPicture>> clouds(groups.size());
  base::parallelFor(groups.size(), [&](std::size_t g) {
    if (!groups[g].empty())
      clouds[g] =
          shellPictures(scene, static_cast<std::uint32_t>(g), pixels, factors[scene.lit[g].archetype]);
  });
  return clouds;
}

/// The pictures of all clouds of a genus in one texture.
struct GenusPictures {
  PictureAtlas atlas;
  std::map<std::size_t, std::size_t> first;  ///< picture of a lit archetype
  int material = -1;
};

std::map<base::Genus, GenusPictures> picturesByGenus(GlbFile& file, const scene::Scene& scene,
                                                     const std::vector<std::vector<CloudPicture>>& clouds) {
  std::map<base::Genus, std::vector<const image::ByteImage*>> images;
  std::map<base::Genus, std::map<std::size_t, std::size_t>> firsts;
  for (std::size_t g = 0; g < clouds.size(); ++g) {
    if (clouds[g].empty()) continue;
    const base::Genus genus = scene.archetypes[scene.lit[g].archetype].genus;
    firsts[genus][g] = images[genus].size();
    for (const CloudPicture& one : clouds[g]) images[genus].push_back(&one.picture.image);
  }
  std::map<base::Genus, GenusPictures> genera;
  for (const auto& [genus, pictures] : images) {
    GenusPictures& one =
        genera.emplace(genus, GenusPictures{PictureAtlas(pictures), firsts[genus]}).first->second;
    const std::string name(base::abbreviation(genus));
    one.material =
        file.addPictureMaterial(name, file.addPngTexture(name, image::pngBytes(one.atlas.texture())));
  }
  return genera;
}

/// The middle of the instances in whole metres: places relative to it keep their precision.
glm::dvec3 middleOf(const scene::Scene& scene, const std::vector<std::uint32_t>& instances) {
  glm::dvec3 lower(1e30), upper(-1e30);
  for (const std::uint32_t i : instances) {
    lower = glm::min(lower, glm::dvec3(scene.instances[i].position));
    upper = glm::max(upper, glm::dvec3(scene.instances[i].position));
  }
  return glm::round(0.5 * (lower + upper));
}

Attributes addPlaces(GlbFile& file, const scene::Scene& scene, const std::vector<std::uint32_t>& instances,
                     const glm::dvec3& middle) {
  std::vector<float> translations, scales, colors;
  float least = 1;
  for (const std::uint32_t i : instances) {
    const scene::Instance& instance = scene.instances[i];
    const glm::vec3 place(glm::dvec3(instance.position) - middle);
    translations.insert(translations.end(), {place.x, place.y, place.z});
    scales.insert(scales.end(), 3, instance.scale);
    const glm::vec3 color = light::dimming(instance.sunlight, scene.sun.color, scene.sky);
    colors.insert(colors.end(), {color.x, color.y, color.z});
    least = std::min(least, instance.sunlight);
  }
  Attributes places{{"TRANSLATION", file.addFloats(3, translations)}, {"SCALE", file.addFloats(3, scales)}};
  // Not in the extension's text, but what three.js, Babylon.js and gltfpack take for an instance's colour.
  if (least < kSunny) places.emplace_back("_COLOR_0", file.addFloats(3, colors));
  return places;
}

/// What the clouds of a node are, in the order of the node's instances.
nlohmann::json cloudExtras(const scene::Scene& scene, const scene::Archetype& archetype,
                           std::span<const std::uint32_t> instances) {
  nlohmann::json ids = nlohmann::json::array();
  for (const std::uint32_t i : instances)
    if (i < scene.clouds.size()) ids.push_back(std::to_string(scene.clouds[i].id));
  return {{"genus", base::abbreviation(archetype.genus)},
          {"archetype", archetype.name},
          {"clouds", std::move(ids)}};
}

/// Of a cloud, near and far.
struct Meshes {
  int near = -1, far = -1;
};

/// One node for all clouds of a mesh, and one out of the scene for viewers that take it from afar.
void addInstanced(GlbFile& file, const scene::Scene& scene, const std::string& name, const Meshes& meshes,
                  const std::vector<std::uint32_t>& instances) {
  constexpr double kNearCoverage = 0.002;  // of the screen: a cloud some 4 % as wide as it
  const scene::LitArchetype& lit = scene.lit[scene.instances[instances.front()].lit];
  const glm::dvec3 middle = middleOf(scene, instances);
  nlohmann::json extras = cloudExtras(scene, scene.archetypes[lit.archetype], instances);
  extras["MSFT_screencoverage"] = {kNearCoverage, 0.0};
  const Attributes places = addPlaces(file, scene, instances, middle);
  const int farther = file.addNode({.name = name + " far",
                                    .mesh = meshes.far,
                                    .translation = middle,
                                    .instancing = places,
                                    .isInScene = false});
  file.addNode({.name = name,
                .mesh = meshes.near,
                .translation = middle,
                .extras = &extras,
                .instancing = places,
                .farther = farther});
}

/// A node a cloud, as it stands when the film begins. Core glTF has no colour of a node: clouds in the shadow of others
/// are as bright as all.
void addSingly(GlbFile& file, FilmAnimation& animation, const Film& film, const scene::Scene& scene,
               const std::string& name, int mesh, const std::vector<std::uint32_t>& instances) {
  for (const std::uint32_t i : instances) {
    const scene::Instance& cloud = scene.instances[i];
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    const nlohmann::json extras = cloudExtras(scene, scene.archetypes[lit.archetype], std::span(&i, 1));
    const int node = file.addNode({.name = name,
                                   .mesh = mesh,
                                   .translation = glm::dvec3(cloud.position),
                                   .scale = film.isThereAtFirst(i) ? static_cast<double>(cloud.scale) : 0,
                                   .extras = &extras});
    if (film.moves()) animation.move(i, node);
  }
}

/// The ground as a mesh; its colours hold sun, height and shadows, as it is unlit.
void addGround(GlbFile& file, const scene::Scene& scene) {
  const base::HeightField terrain =
      scene.terrain.empty() ? scene::flatGround(scene, kGroundCells) : scene.terrain;
  const glm::dvec2 middle =
      glm::round(terrain.origin + 0.5 * terrain.step * glm::dvec2(terrain.columns - 1, terrain.rows - 1));
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> colors;
  for (int row = 0; row < terrain.rows; ++row)
    for (int column = 0; column < terrain.columns; ++column) {
      const glm::vec3 point(terrain.point(column, row) - glm::dvec3(middle.x, 0, middle.y));
      const glm::vec3 normal = terrain.normal(column, row);
      positions.insert(positions.end(), {point.x, point.y, point.z});
      normals.insert(normals.end(), {normal.x, normal.y, normal.z});
      const glm::vec4 color(
          light::shadedReliefColor(terrain, column, row, scene.sun, scene.sky, scene.shadows), 1);
      for (int i = 0; i < 4; ++i)
        colors.push_back(static_cast<std::uint16_t>(std::lround(65535 * glm::clamp(color[i], 0.0f, 1.0f))));
    }
  const int mesh = file.addMesh("ground", {.attributes = {{"POSITION", file.addFloats(3, positions, true)},
                                                          {"NORMAL", file.addFloats(3, normals)},
                                                          {"COLOR_0", file.addUnitShorts(4, colors)}},
                                           .indices = file.addIndices(base::trianglesOf(terrain)),
                                           .material = file.addPlainMaterial("ground", glm::vec3(1))});
  file.addNode({.name = "ground", .mesh = mesh, .translation = {middle.x, 0, middle.y}});
}

}  // namespace

void writeCards(const scene::Scene& scene, const Destination& destination) {
  GlbFile file(sceneExtras(scene));
  addGround(file, scene);
  const Film film(scene);
  FilmAnimation animation(file, film);
  const auto groups = instancesByLight(scene);
  const auto clouds = shellsOf(scene, groups);
  const std::map<base::Genus, GenusPictures> genera = picturesByGenus(file, scene, clouds);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    destination.progress.step("glb", static_cast<double>(g) / static_cast<double>(groups.size()));
    const scene::LitArchetype& lit = scene.lit[g];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    if (groups[g].empty()) continue;
    const GenusPictures& genus = genera.at(archetype.genus);
    const CloudMesh cards = meshOf(clouds[g], genus.atlas, genus.first.at(g));
    if (cards.indices.empty()) continue;  // so faint that nothing of it is seen
    const std::string name = fmt::format("{} heading {}", archetype.name, lit.yawStep);
    const int near = addCloudMesh(file, name, cards, genus.material);
    if (destination.cards.singly || film.moves()) {
      addSingly(file, animation, film, scene, name, near, groups[g]);
      continue;
    }
    const CloudMesh few = farMeshOf(clouds[g], genus.atlas, genus.first.at(g));
    addInstanced(file, scene, name, {near, addCloudMesh(file, name + " far", few, genus.material)}, groups[g]);
  }
  file.write(destination.folder / "scene.glb");
  destination.progress.step("glb", 1);
}

}  // namespace cloudgen::writer
