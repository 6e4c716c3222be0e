// SPDX-License-Identifier: Apache-2.0
#include "writer/ply/ply.hpp"

#include <bit>
#include <cstring>

#include "base/growing_file.hpp"
#include "base/thread.hpp"
#include "writer/gltf/splat_source.hpp"

namespace cloudgen::writer {
namespace {

static_assert(std::endian::native == std::endian::little, "this file copies memory as it is");

/// Floats of a splat beside its harmonics above degree 0.
constexpr std::size_t kPlainFloats = 14;
constexpr std::size_t kMostSplatsAtOnce = 1 << 16;

std::size_t coefficients(int degree) { return static_cast<std::size_t>(degree * (degree + 2)); }

std::string headerOf(const scene::Scene& scene, std::size_t count, int degree) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment cloudgen, valid {}\n"
      "comment metres, x east, y up, z south\nelement vertex {}\n",
      base::isoText(scene.validTime), count);
  const auto add = [&](const std::string& name) { header += fmt::format("property float {}\n", name); };
  for (const char* name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2"}) add(name);
  for (std::size_t i = 0; i < 3 * coefficients(degree); ++i) add(fmt::format("f_rest_{}", i));
  for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    add(name);
  return header + "end_header\n";
}

/// The logit of 1 - exp(-optical depth): nearly the optical depth itself where that is large.
float opacityLogit(float opticalDepth) {
  return opticalDepth > 15 ? opticalDepth : std::log(std::expm1(opticalDepth));
}

void put(const gltf::Splat& splat, const glm::dvec3& center, std::span<const float> towardsSun, float* out) {
  const auto add = [&](float value) { *out++ = value; };
  for (int axis = 0; axis < 3; ++axis)
    add(static_cast<float>(center[axis] + static_cast<double>(splat.center[axis])));
  for (int channel = 0; channel < 3; ++channel) add((splat.color[channel] - 0.5f) / gltf::kHarmonic0);
  for (int channel = 0; channel < 3; ++channel)
    for (const float share : towardsSun) add(splat.towardsSun[channel] * share);
  add(opacityLogit(splat.opticalDepth));
  for (int axis = 0; axis < 3; ++axis) add(std::log(splat.sigma[axis]));
  for (const float part : {splat.rotation.w, splat.rotation.x, splat.rotation.y, splat.rotation.z}) add(part);
}

}  // namespace

void writePly(const scene::Scene& scene, const Destination& destination) {
  const auto tiles = scene::tilesOf(scene);
  const gltf::SplatMaker maker(scene);
  std::vector<std::vector<gltf::SplatSource>> sources(tiles.size());
  destination.progress.step("ply", 0);
  base::parallelFor(tiles.size(),
                    [&](std::size_t t) { sources[t] = maker.sourcesOf(tiles[t], kMostSplatsAtOnce); });
  std::size_t count = 0;
  for (const auto& ofTile : sources)
    for (const gltf::SplatSource& source : ofTile) count += source.count;
  const auto harmonics = gltf::harmonicsTowards(scene.sun.direction);
  const auto towardsSun = std::span(harmonics).first(coefficients(destination.splats.degree));
  const std::size_t floats = kPlainFloats + 3 * towardsSun.size();

  base::GrowingFile file(destination.folder / "scene.splats.ply");
  file.append(headerOf(scene, count, destination.splats.degree));
  std::vector<float> values;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    destination.progress.step("ply", static_cast<double>(t) / static_cast<double>(tiles.size()));
    for (const gltf::SplatSource& source : sources[t]) {
      values.resize(source.count * floats);
      gltf::makeAll(source, [&](std::size_t first, std::span<const gltf::Splat> splats) {
        for (std::size_t i = 0; i < splats.size(); ++i)
          put(splats[i], gltf::tileCenter(tiles[t]), towardsSun, values.data() + (first + i) * floats);
      });
      file.append({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
    }
  }
  file.commit();
  destination.progress.step("ply", 1);
}

}  // namespace cloudgen::writer
