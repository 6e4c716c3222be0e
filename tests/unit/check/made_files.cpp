// SPDX-License-Identifier: Apache-2.0
#include "unit/check/made_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "unit/check/made_glb.hpp"

namespace cloudgen::check::test {
namespace {

using nlohmann::json;

double opacityOf(double opticalDepth) { return -std::expm1(-opticalDepth); }

}  // namespace

std::string x3dOf(const WrittenScene& scene) {
  std::string text = "<X3D profile='Immersive' version='4.0'><Scene>";
  for (std::size_t i = 0; i < scene.blobs.size(); ++i) {
    const Blob& blob = scene.blobs[i];
    const WrittenCloud& cloud = scene.clouds[i];
    const float half = kCardReach * blob.right().x, above = blob.center.y - cloud.foot.y;
    text += fmt::format(
        "<Transform translation='{:.3f} {:.3f} {:.3f}'><MetadataSet name='cloud'><MetadataString name='id "
        "genus rule' value='\"{}\" \"{}\" \"made\"'/></MetadataSet><Shape><Appearance><ImageTexture "
        "url='\"textures/{}.png\"'/></Appearance><IndexedTriangleSet index='0 1 2 0 2 3'><ColorRGBA color='",
        blob.center.x, cloud.foot.y, blob.center.z, i, base::abbreviation(*cloud.recorded),
        base::name(*cloud.drawn));
    for (int corner = 0; corner < 4; ++corner) text += fmt::format("1 1 1 {:.6f} ", opacityOf(blob.strength));
    text += fmt::format(
        "'/><Coordinate point='{0:.3f} {1:.3f} {2:.3f} {2:.3f} {1:.3f} {2:.3f} {2:.3f} {1:.3f} {0:.3f} "
        "{0:.3f} {1:.3f} {0:.3f}'/></IndexedTriangleSet></Shape></Transform>",
        -half, above, half);
  }
  return text + "</Scene></X3D>";
}

std::string glbOf(const WrittenScene& scene) {
  MadeGlb glb;
  glb.document = {{"asset", {{"version", "2.0"}}}, {"buffers", {json::object()}}};
  std::map<std::pair<base::Genus, base::Genus>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < scene.clouds.size(); ++i)
    groups[{*scene.clouds[i].recorded, *scene.clouds[i].drawn}].push_back(i);
  const std::vector<float> corners{-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1}, places{0, 1, 1, 1, 1, 0, 0, 0};
  const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
  for (const auto& [genera, members] : groups) {
    const auto alpha =
        static_cast<std::uint16_t>(std::lround(65535 * opacityOf(scene.blobs[members.front()].strength)));
    std::vector<std::uint16_t> colors(16, 65535);
    for (std::size_t corner = 0; corner < 4; ++corner) colors[4 * corner + 3] = alpha;
    std::vector<float> shifts, scales;
    for (const std::size_t i : members) {
      const Blob& blob = scene.blobs[i];
      shifts.insert(shifts.end(), {blob.center.x, blob.center.y, blob.center.z});
      scales.insert(scales.end(), {kCardReach * blob.right().x, 1, -kCardReach * blob.up().z});
    }
    const std::size_t index = glb.document["meshes"].size();
    glb.document["images"].push_back({{"name", base::abbreviation(genera.second)}});
    glb.document["textures"].push_back({{"source", index}});
    glb.document["materials"].push_back(
        {{"alphaMode", "BLEND"},
         {"doubleSided", true},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", index}}}}}});
    const json attributes{{"POSITION", glb.column(corners, "VEC3", 3)},
                          {"TEXCOORD_0", glb.column(places, "VEC2", 2)},
                          {"COLOR_0", glb.column(colors, "VEC4", 4)}};
    glb.document["meshes"].push_back({{"primitives",
                                       {{{"attributes", attributes},
                                         {"indices", glb.column(triangles, "SCALAR", 1)},
                                         {"material", index}}}}});
    const json instancing{{"TRANSLATION", glb.column(shifts, "VEC3", 3)},
                          {"SCALE", glb.column(scales, "VEC3", 3)}};
    glb.document["nodes"].push_back(
        {{"mesh", index},
         {"extras", {{"genus", base::abbreviation(genera.first)}}},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", instancing}}}}}});
  }
  return glb.bytes();
}

std::string splatsOf(const WrittenScene& scene) {
  std::vector<float> centers, sigmas, turns, opacities, colors(3 * scene.blobs.size(), 0.5f);
  for (const Blob& blob : scene.blobs) {
    const float sx = std::sqrt(blob.shape[0]), sy = std::sqrt(blob.shape[3]), sz = std::sqrt(blob.shape[5]);
    centers.insert(centers.end(), {blob.center.x, blob.center.y, blob.center.z});
    sigmas.insert(sigmas.end(), {sx, sy, sz});
    turns.insert(turns.end(), {0, 0, 0, 1});
    const double frontal = blob.strength * static_cast<double>(std::min({sx, sy, sz})) /
                           (2 * std::numbers::pi * static_cast<double>(sx) * sy * sz);
    opacities.push_back(static_cast<float>(opacityOf(frontal)));
  }
  MadeGlb glb;
  glb.document = {{"asset", {{"version", "2.0"}}}, {"buffers", {json::object()}}, {"nodes", {{{"mesh", 0}}}}};
  const std::string prefix = "KHR_gaussian_splatting:";
  const json attributes{{"POSITION", glb.column(centers, "VEC3", 3)},
                        {prefix + "SCALE", glb.column(sigmas, "VEC3", 3)},
                        {prefix + "ROTATION", glb.column(turns, "VEC4", 4)},
                        {prefix + "OPACITY", glb.column(opacities, "SCALAR", 1)},
                        {prefix + "SH_DEGREE_0_COEF_0", glb.column(colors, "VEC3", 3)}};
  glb.document["meshes"].push_back(
      {{"primitives",
        {{{"attributes", attributes}, {"extensions", {{"KHR_gaussian_splatting", json::object()}}}}}}});
  return glb.bytes();
}

}  // namespace cloudgen::check::test
