// SPDX-License-Identifier: Apache-2.0
#include "cli/shape_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "base/file.hpp"
#include "input/mesh/mesh_file.hpp"
#include "input/volume/volume_file.hpp"
#include "shape/file_shape.hpp"

namespace cloudgen::cli {
namespace {

constexpr std::uint64_t kGrammarLimitBytes = 1 << 20;

void standUp(base::Mesh& mesh) {
  for (glm::dvec3& point : mesh.points) point = {point.x, point.z, -point.y};
}

shape::FileShape opened(const shape::Recipe& recipe) {
  const std::filesystem::path file(recipe.shapeFile);
  if (input::isMeshFile(file)) {
    base::Mesh mesh = input::readMesh(file);
    if (recipe.zUp) standUp(mesh);
    return shape::shapeFromMesh(mesh, recipe.shapeFile);
  }
  if (base::hasExtension(file, ".json"))
    return shape::shapeFromGrammar(base::readFile(file, kGrammarLimitBytes), recipe.shapeFile);
  if (input::isVolumeFile(file))
    return shape::shapeFromVolume(input::readVolume(file, recipe.shapeVariable, recipe.zUp));
  throw base::InputError(
      recipe.shapeFile, "is not a kind of file that a shape is read from",
      "give a mesh (.obj .ply .off .gltf .glb), an L-system (.json) or a volume (.vdb .nc)");
}

/// The archetype that most clouds of a genus have; null if there is no cloud.
const scene::Archetype* commonest(const scene::Scene& scene, base::Genus genus) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const scene::Instance& instance : scene.instances) {
    const std::uint32_t archetype = scene.lit[instance.lit].archetype;
    if (scene.archetypes[archetype].genus == genus) ++counts[archetype];
  }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? nullptr : &scene.archetypes[most->first];
}

nlohmann::ordered_json errorsOf(const shape::FileShape& shape, const scene::Archetype& archetype) {
  const auto errors = shape.opticalDepthErrors(archetype.puffs, archetype.widthMeters, archetype.depthMeters);
  const auto rounded = [](double error) { return std::round(error * 1e4) / 1e4; };
  return {{"above", rounded(errors[0])}, {"along_x", rounded(errors[1])}, {"along_z", rounded(errors[2])}};
}

}  // namespace

void openShapes(pipeline::RecipeBook& recipes, const ShapeLine& line) {
  if (!line.file.empty())
    for (const base::Genus genus : {base::Genus::Cumulus, base::Genus::Cumulonimbus}) {
      shape::Recipe recipe = recipes.of(genus);
      recipe.form = shape::Form::File;
      recipe.shapeFile = line.file, recipe.shapeVariable = line.variable, recipe.zUp = line.zUp;
      recipes.put(recipe);
    }
  std::map<std::tuple<std::string, std::string, bool>, std::shared_ptr<const shape::FileShape>> known;
  for (const base::Genus genus : base::allGenera()) {
    shape::Recipe recipe = recipes.of(genus);
    if (recipe.form != shape::Form::File) continue;
    auto& shape = known[{recipe.shapeFile, recipe.shapeVariable, recipe.zUp}];
    if (!shape) shape = std::make_shared<const shape::FileShape>(opened(recipe));
    recipe.fileShape = shape;
    recipes.put(recipe);
  }
}

nlohmann::ordered_json shapesOf(const pipeline::RecipeBook& recipes, const scene::Scene& scene) {
  nlohmann::ordered_json shapes = nlohmann::ordered_json::array();
  for (const base::Genus genus : base::allGenera()) {
    const shape::Recipe& recipe = recipes.of(genus);
    if (recipe.form != shape::Form::File) continue;
    nlohmann::ordered_json entry{
        {"genus", base::abbreviation(genus)},
        {"file", std::filesystem::path(recipe.shapeFile).filename().string()},
        {"kind", recipe.fileShape->kind},
        {"clouds", std::count_if(scene.clouds.begin(), scene.clouds.end(),
                                 [&](const auto& cloud) { return cloud.genus == genus; })}};
    if (const scene::Archetype* archetype = commonest(scene, genus)) {
      entry["puffs"] = archetype->puffs.size();
      if (recipe.fileShape->opticalDepthErrors)
        entry["optical_depth_error"] = errorsOf(*recipe.fileShape, *archetype);
    }
    shapes.push_back(std::move(entry));
  }
  return shapes;
}

}  // namespace cloudgen::cli
