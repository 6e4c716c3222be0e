// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/volumes.hpp"

#include <algorithm>
#include <new>
#include <string>

#include "runtime/gles/shaders.hpp"

namespace cloudgen::runtime::gles {
namespace {

constexpr int kSide = Volumes::kSide;
constexpr std::size_t kCells = std::size_t{kSide} * kSide * kSide;
constexpr float kReach = 3;  ///< deviations

float linearOf(std::uint8_t encoded) {
  const float value = static_cast<float>(encoded) / 255;
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}
std::uint8_t encodedOf(float linear) {
  const float value = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(255 * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

/// Where an archetype's axes point, of a puff: rows are its own axes over their deviations.
struct Unit {
  Vec3 x, y, z;
};
Unit unitOf(const pack::Puff& puff) {
  const std::uint32_t bits = puff.rotation(), missing = bits >> 30;
  float parts[4], sum = 0;
  for (std::uint32_t i = 0, shift = 0; i < 4; ++i) {
    if (i == missing) continue;
    parts[i] = (static_cast<float>(bits >> shift & 1023) * (2.0f / 1023) - 1) * 0.70710678f;
    sum += parts[i] * parts[i];
    shift += 10;
  }
  parts[missing] = std::sqrt(std::max(0.0f, 1 - sum));
  const auto [x, y, z, w] = parts;
  const auto over = [](const Vec3& axis, std::uint16_t sigma) { return axis * (1 / std::max(floatOf(sigma), 1e-3f)); };
  return {over({1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)}, puff.sigma_x()),
          over({2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)}, puff.sigma_y()),
          over({2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}, puff.sigma_z())};
}

}  // namespace

Status Volumes::make(const Runtime& runtime) noexcept {
  runtime_ = &runtime;
  try {
    grids_.reserve(kMost);
    for (const pack::Instance& cloud : runtime.pack().instances())
      if (grids_.size() < kMost && gridOf(cloud) == kImpostor) grids_.push_back({cloud.archetype(), cloud.yaw_step()});
    extinction_.resize(4 * kCells);
    texels_.resize(4 * kCells);
    const std::string readers = std::string(shader::kCommon) + PackTextures::kReaders;
    if (const Status made = makeProgram(readers.c_str(), shader::kVolumeVertex, shader::kVolumeFragment, program_); !made) return made;
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the volumes"};
  }
  cells_ = newTexture();
  glBindTexture(GL_TEXTURE_3D, cells_.id());
  glTexStorage3D(GL_TEXTURE_3D, 1, GL_SRGB8_ALPHA8, kSide * kAcross, kSide * kAcross, kSide);
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) glTexParameteri(GL_TEXTURE_3D, side, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  boxes_ = newTexture2d(GL_RGBA32F, 2, kMost, Filter::Nearest, Border::Clamp);
  array_ = newVertexArray();
  return glGetError() == GL_NO_ERROR ? Status{} : Status{"OpenGL has no room for the volumes"};
}

std::uint32_t Volumes::gridOf(const pack::Instance& cloud) const noexcept {
  for (std::uint32_t g = 0; g < grids_.size(); ++g)
    if (grids_[g].archetype == cloud.archetype() && grids_[g].yawStep == cloud.yaw_step()) return g;
  return kImpostor;
}

void Volumes::light() noexcept {
  for (std::uint32_t g = 0; g < grids_.size(); ++g) bake(g);
}

void Volumes::bake(std::uint32_t index) noexcept {
  const Grid& grid = grids_[index];
  const PackView& pack = runtime_->pack();
  const Lighting& lighting = runtime_->lighting();
  const pack::Archetype& archetype = *pack.root().archetypes()->Get(grid.archetype);
  const ArchetypeInfo& info = pack.archetypes()[grid.archetype];
  // The outermost cells stay empty.
  const Vec3 low = vec3(*archetype.lower()), high = vec3(*archetype.upper()), margin = (high - low) * (1.5f / (kSide - 3));
  const Vec3 lower = low - margin, cell = (high - low + margin * 2) * (1.0f / kSide);
  std::fill(extinction_.begin(), extinction_.end(), 0.0f);
  const std::int64_t firstColor = lighting.firstColor(grid.archetype, grid.yawStep);
  const auto range = [](float at, float reach, float from, float step, int& first, int& last) {
    first = std::clamp(static_cast<int>((at - reach - from) / step), 1, kSide - 2);
    last = std::clamp(static_cast<int>((at + reach - from) / step) + 1, 1, kSide - 2);
  };
  for (std::uint32_t p = info.first[0]; p < info.first[0] + info.count[0]; ++p) {
    const pack::Puff& puff = pack.puffs()[p];
    const Unit unit = unitOf(puff);
    const float sx = floatOf(puff.sigma_x()), sy = floatOf(puff.sigma_y()), sz = floatOf(puff.sigma_z());
    const float inMiddle = floatOf(puff.optical_depth()) / (2.5066283f * std::max(std::min({sx, sy, sz}), 1e-3f)), reach = kReach * std::max({sx, sy, sz});
    const PuffColor& encoded = lighting.colors()[static_cast<std::size_t>(firstColor + p - info.first[0])];
    const Vec3 color{linearOf(encoded.red), linearOf(encoded.green), linearOf(encoded.blue)}, center = pack.centers()[p];
    int x0, x1, y0, y1, z0, z1;
    range(center.x, reach, lower.x, cell.x, x0, x1);
    range(center.y, reach, lower.y, cell.y, y0, y1);
    range(center.z, reach, lower.z, cell.z, z0, z1);
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const Vec3 away = lower + cell * Vec3{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, static_cast<float>(z) + 0.5f} - center;
          const float a = dot(unit.x, away), b = dot(unit.y, away), c = dot(unit.z, away), squared = a * a + b * b + c * c;
          if (squared > kReach * kReach) continue;
          const float here = inMiddle * std::exp(-0.5f * squared);
          float* const sums = &extinction_[4 * (static_cast<std::size_t>(z * kSide + y) * kSide + static_cast<std::size_t>(x))];
          sums[0] += here;
          sums[1] += here * color.x;
          sums[2] += here * color.y;
          sums[3] += here * color.z;
        }
  }
  float most = 1e-12f;
  Vec3 mean;
  float whole = 1e-12f;
  for (std::size_t i = 0; i < kCells; ++i) {
    const float* const sums = &extinction_[4 * i];
    most = std::max(most, sums[0]);
    whole += sums[0];
    mean = mean + Vec3{sums[1], sums[2], sums[3]};
  }
  // Empty cells have the mean colour, so that none bleeds in; the root keeps thin cloud apart from none.
  for (std::size_t i = 0; i < kCells; ++i) {
    const float* const sums = &extinction_[4 * i];
    const Vec3 color = (Vec3{sums[1], sums[2], sums[3]} + mean * (1e-6f * most / whole)) * (1 / (sums[0] + 1e-6f * most));
    std::uint8_t* const texel = &texels_[4 * i];
    texel[0] = encodedOf(color.x);
    texel[1] = encodedOf(color.y);
    texel[2] = encodedOf(color.z);
    texel[3] = static_cast<std::uint8_t>(255 * std::sqrt(sums[0] / most) + 0.5f);
  }
  glBindTexture(GL_TEXTURE_3D, cells_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const int x = static_cast<int>(index) % kAcross * kSide, y = static_cast<int>(index) / kAcross * kSide;
  glTexSubImage3D(GL_TEXTURE_3D, 0, x, y, 0, kSide, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, texels_.data());
  const Vec3 upper = lower + cell * static_cast<float>(kSide);
  const float box[8]{lower.x, lower.y, lower.z, most, upper.x, upper.y, upper.z, 0};
  glBindTexture(GL_TEXTURE_2D, boxes_.id());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(index), 2, 1, GL_RGBA, GL_FLOAT, box);
}

void Volumes::begin(const Camera& camera, const Texture& sky, const PackTextures& textures) noexcept {
  useProgram(program_, camera, *runtime_);
  int unit = textures.bind(program_, 0);
  bindTexture(program_, "uSky", unit++, GL_TEXTURE_2D, sky);
  bindTexture(program_, "uBoxes", unit++, GL_TEXTURE_2D, boxes_);
  bindTexture(program_, "uCells", unit, GL_TEXTURE_3D, cells_);
}

}  // namespace cloudgen::runtime::gles
