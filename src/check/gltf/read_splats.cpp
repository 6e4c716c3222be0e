// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/read_splats.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "check/gltf/glb_parts.hpp"
#include "check/gltf/read_spz.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr const char* kPacked = "KHR_gaussian_splatting_compression_spz_2";

glm::vec3 triple(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// What the opacity says; where it is nearly 1 it says little more than that, and what the file states beside
/// it counts, unless that is another opacity.
float opticalDepthOf(float opacity, float stated) {
  constexpr float kMostOpaque = 1 - 0x1p-24f;  // the last float before 1
  constexpr float kAgreeing = 2e-4f;  // more than what shorts round by
  if (stated > 0 && std::isfinite(stated) && std::abs(-std::expm1(-stated) - opacity) < kAgreeing)
    return stated;
  return -std::log1p(-std::clamp(opacity, 0.0f, kMostOpaque));
}

/// Where a node stands: it is moved, and as large in all directions.
struct Pose {
  glm::vec3 translation{0};
  float scale = 1;
};

Pose poseOf(const GlbParts& glb, const json& node) {
  Pose pose;
  if (node.contains("translation"))
    for (int axis = 0; axis < 3; ++axis)
      pose.translation[axis] = node["translation"].at(static_cast<std::size_t>(axis));
  if (!node.contains("matrix")) return pose;
  pose.scale = node["matrix"].at(0);
  for (std::size_t i = 0; i < 16; ++i) {
    const float value = node["matrix"].at(i);
    if (i / 4 == 3 && i % 4 < 3)
      pose.translation[static_cast<int>(i % 4)] = value;
    else if (value != (i % 5 != 0 ? 0 : i == 15 ? 1 : pose.scale))
      glb.fail("has splats in a node that is more than moved and scaled");
  }
  if (!(pose.scale > 0)) glb.fail("has splats in a node of no size");
  return pose;
}

ReadSplat posed(ReadSplat splat, const Pose& pose) {
  splat.center = pose.scale * splat.center + pose.translation;
  splat.sigma *= pose.scale;
  return splat;
}

/// The optical depths that the extras of a node of packed splats tell, one each; empty if none are told.
std::vector<float> toldOpticalDepths(const GlbParts& glb, const json& node) {
  const json told = node.value("extras", json::object()).value("opticalDepths", json::object());
  if (!told.contains("bufferView")) return {};
  const float offset = told.at("offset"), scale = told.at("scale");
  std::vector<float> depths;
  for (const char byte : glb.view(told["bufferView"].get<std::size_t>()))
    depths.push_back(std::exp(offset + scale * static_cast<float>(static_cast<unsigned char>(byte)) / 255));
  return depths;
}

/// A primitive whose columns are packed. Opacities are whole shares of 255, give or take one: what is told of
/// the optical depth counts where it agrees with them.
void readPacked(const GlbParts& glb, const json& node, const json& packed, std::size_t expected,
                const Pose& pose,
                const std::function<void(const ReadSplat&)>& visit) {
  constexpr float kMostOpaque = 1 - 0.5f / 255, kAgreeing = 2.5f / 255;
  const auto told = toldOpticalDepths(glb, node);
  std::size_t at = 0;
  const std::size_t count =
      readPackedSplats(glb.view(packed.at("bufferView")), glb.where(), [&](ReadSplat splat) {
        const float stated = at < told.size() ? told[at] : 0;
        ++at;
        splat.opticalDepth = std::abs(-std::expm1(-stated) - splat.opacity) < kAgreeing
                                 ? stated
                                 : -std::log1p(-std::min(splat.opacity, kMostOpaque));
        visit(posed(splat, pose));
      });
  if (count != expected || (!told.empty() && told.size() != count))
    glb.fail("has packed splats of another number than it says");
}

/// `depthStep`: _OPTICAL_DEPTH counts in it.
void readPrimitive(const GlbParts& glb, const json& attributes, const Pose& pose, float depthStep,
                   const std::function<void(const ReadSplat&)>& visit) {
  const auto column = [&](const std::string& name, std::size_t components) {
    return glb.floats(attributes.at(name), components);
  };
  const std::string prefix = "KHR_gaussian_splatting:";
  const auto positions = column("POSITION", 3), scales = column(prefix + "SCALE", 3),
             rotations = column(prefix + "ROTATION", 4);
  const auto opacities = column(prefix + "OPACITY", 1), base = column(prefix + "SH_DEGREE_0_COEF_0", 3);
  std::array<std::vector<float>, 3> harmonics;
  const bool hasDegree1 = attributes.contains(prefix + "SH_DEGREE_1_COEF_0");
  for (std::size_t k = 0; hasDegree1 && k < 3; ++k)
    harmonics[k] = column(prefix + "SH_DEGREE_1_COEF_" + std::to_string(k), 3);
  std::vector<float> stated;
  if (attributes.contains("_OPTICAL_DEPTH")) stated = column("_OPTICAL_DEPTH", 1);
  const std::size_t count = opacities.size();
  bool even = positions.size() == 3 * count && scales.size() == 3 * count && rotations.size() == 4 * count &&
              base.size() == 3 * count && (stated.empty() || stated.size() == count);
  for (const auto& values : harmonics) even = even && (!hasDegree1 || values.size() == 3 * count);
  if (!even) glb.fail("has splat attributes of different lengths");
  for (std::size_t i = 0; i < count; ++i) {
    ReadSplat splat;
    splat.center = triple(positions, i);
    splat.sigma = triple(scales, i);
    splat.rotation =
        glm::quat(rotations[4 * i + 3], rotations[4 * i], rotations[4 * i + 1], rotations[4 * i + 2]);
    splat.opacity = opacities[i];
    splat.opticalDepth = opticalDepthOf(splat.opacity, stated.empty() ? 0 : depthStep * stated[i]);
    splat.color = triple(base, i) * 0.2820947917738781f + 0.5f;
    for (std::size_t k = 0; hasDegree1 && k < 3; ++k) splat.harmonics[k] = triple(harmonics[k], i);
    visit(posed(splat, pose));
  }
}

void readTerrain(const GlbParts& glb, const json& from, base::HeightField& terrain) {
  terrain.columns = from.at("columns");
  terrain.rows = from.at("rows");
  terrain.origin = {from.at("origin").at(0), from.at("origin").at(1)};
  terrain.step = {from.at("step").at(0), from.at("step").at(1)};
  terrain.heights = from.at("heights_m").get<std::vector<float>>();
  const auto within = [](double low, double value, double high) { return value >= low && value <= high; };
  const bool sound = within(2, terrain.columns, 4096) && within(2, terrain.rows, 4096) &&
                     within(-1e8, terrain.origin.x, 1e8) && within(-1e8, terrain.origin.y, 1e8) &&
                     within(0.01, terrain.step.x, 1e7) && within(0.01, terrain.step.y, 1e7) &&
                     terrain.heights.size() ==
                         static_cast<std::size_t>(terrain.columns) * static_cast<std::size_t>(terrain.rows) &&
                     std::all_of(terrain.heights.begin(), terrain.heights.end(),
                                 [&](float height) { return within(-20000, height, 20000); });
  if (!sound) glb.fail("has terrain that cannot be: its size or its heights are wrong");
}

}  // namespace

SplatFile readSplats(const std::filesystem::path& file) {
  return readSplats(base::readFile(file), file.string());
}

SplatFile readSplats(std::string_view bytes, const std::string& where) {
  std::vector<ReadSplat> splats;
  SplatFile out = readSplats(bytes, where, [&](const ReadSplat& splat) { splats.push_back(splat); });
  out.splats = std::move(splats);
  return out;
}

SplatFile readSplats(std::string_view bytes, const std::string& where,
                     const std::function<void(const ReadSplat&)>& visit) {
  const GlbParts glb(bytes, where, "name a scene.splats.glb that cloudgen wrote, or its folder");
  SplatFile out;
  try {
    const json& root = glb.root();
    for (const json& node : root.value("nodes", json::array())) {
      if (!node.contains("mesh")) continue;
      const Pose pose = poseOf(glb, node);
      for (const json& primitive : root.at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives")) {
        if (!primitive.contains("extensions") || !primitive["extensions"].contains("KHR_gaussian_splatting"))
          glb.fail("has a primitive without splats");
        const json inner = primitive["extensions"]["KHR_gaussian_splatting"].value("extensions", json::object());
        const json& attributes = primitive.at("attributes");
        if (inner.contains(kPacked))
          readPacked(glb, node, inner[kPacked], root.at("accessors").at(attributes.at("POSITION").get<std::size_t>()).at("count"),
                     pose, visit);
        else
          readPrimitive(glb, attributes, pose,
                        node.value("extras", json::object()).value("optical_depth_step", 1.0f), visit);
      }
    }
    const json extras = root.value("asset", json::object()).value("extras", json::object());
    if (extras.contains("terrain")) readTerrain(glb, extras["terrain"], out.terrain);
    out.moonlight = std::clamp(extras.value("moonlight", out.moonlight), 0.0f, 10.0f);
    if (extras.contains("sun")) {
      out.sunAzimuthDegrees = extras["sun"].value("azimuth_degrees", out.sunAzimuthDegrees);
      out.sunElevationDegrees = extras["sun"].value("elevation_degrees", out.sunElevationDegrees);
    }
  } catch (const json::exception& error) {
    glb.fail(std::string("is not a splat file (") + error.what() + ")");
  }
  return out;
}

}  // namespace cloudgen::check
