// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/impostors.hpp"

#include <algorithm>
#include <new>
#include <string>

#include "runtime/gles/shaders.hpp"

namespace cloudgen::runtime::gles {
namespace {

constexpr int kAtlasPixels = Impostors::kTilePixels * Impostors::kTilesAcross;
/// A tile is this much wider than the cloud's sphere, so that its border stays empty.
constexpr float kMargin = 1.08f;
/// A picture is as good as new while one has gone round the cloud by less than this, or come nearer by that.
constexpr float kTurnRadians = 0.03f, kNearer = 1.4f, kChange = 0.03f;
constexpr int kRedrawnAFrame = 6;
constexpr float kErrorPixels = 1.5f;

}  // namespace

Status Impostors::make(const Runtime& runtime) noexcept {
  runtime_ = &runtime;
  std::size_t longest = 1;
  for (const ArchetypeInfo& info : runtime.pack().archetypes())
    for (std::uint32_t l = 0; l < info.levels; ++l) longest = std::max<std::size_t>(longest, info.count[l]);
  try {
    tileOf_.assign(runtime.mostClouds(), -1);
    tiles_.assign(kMost, Tile());
    puffs_.resize(longest);
    sorted_.resize(longest);
    const std::string readers = std::string(shader::kCommon) + PackTextures::kReaders;
    if (const Status made = makeProgram(readers.c_str(), shader::kImpostorVertex, shader::kImpostorFragment, program_); !made) return made;
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the impostors"};
  }
  atlas_ = newTexture2d(GL_SRGB8_ALPHA8, kAtlasPixels, kAtlasPixels, Filter::Linear, Border::Clamp);
  target_ = newFramebuffer(atlas_);
  places_ = newTexture2d(GL_RGBA32F, 2, kMost, Filter::Nearest, Border::Clamp);
  buffer_ = newBuffer();
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(longest * sizeof(DrawPuff)), nullptr, GL_STREAM_DRAW);
  array_ = newVertexArray();
  return {};
}

void Impostors::forget() noexcept {
  for (Tile& tile : tiles_) tile.isOld = true;
}

std::uint32_t Impostors::freeTile() const noexcept {
  const auto oldest = std::min_element(tiles_.begin(), tiles_.end(), [](const Tile& a, const Tile& b) { return a.usedAt < b.usedAt; });
  return static_cast<std::uint32_t>(oldest - tiles_.begin());
}

std::uint32_t Impostors::tileOf(std::uint32_t cloud, const Frame& frame, const Camera& camera, const Texture& sky, PuffBrush& brush) noexcept {
  const bool isNew = tileOf_[cloud] < 0;
  if (isNew) {
    const std::uint32_t tile = freeTile();
    if (tiles_[tile].cloud != 0xffffffff) tileOf_[tiles_[tile].cloud] = -1;
    tiles_[tile].cloud = cloud;
    tileOf_[cloud] = static_cast<std::int32_t>(tile);
  }
  const auto index = static_cast<std::uint32_t>(tileOf_[cloud]);
  Tile& tile = tiles_[index];
  tile.usedAt = now_;
  const pack::Instance& instance = frame.clouds[cloud];
  const ArchetypeInfo& info = runtime_->pack().archetypes()[instance.archetype()];
  const Vec3 away = camera.eye - (vec3(instance.position()) + info.middle * instance.scale());
  const float distance = std::max(length(away), 1.0f);
  const Vec3 towardsEye = away * (1 / distance);
  const auto isLike = [](float a, float b) { return std::abs(a - b) <= kChange * std::abs(a); };
  const bool isGood = !tile.isOld && dot(towardsEye, tile.towardsEye) > std::cos(kTurnRadians) && tile.distance < kNearer * distance &&
                      distance < kNearer * tile.distance && isLike(instance.scale(), tile.scale) && isLike(instance.optical_depth_factor(), tile.factor);
  if (isNew || (!isGood && redrawn_ < kRedrawnAFrame)) {
    if (!isNew) ++redrawn_;
    tile = {cloud, now_, towardsEye, distance, instance.scale(), instance.optical_depth_factor(), false};
    redraw(index, frame, camera, sky, brush);
  }
  return index;
}

void Impostors::redraw(std::uint32_t index, const Frame& frame, const Camera& camera, const Texture& sky, PuffBrush& brush) noexcept {
  const Tile& tile = tiles_[index];
  const pack::Instance& instance = frame.clouds[tile.cloud];
  const PackView& pack = runtime_->pack();
  const ArchetypeInfo& info = pack.archetypes()[instance.archetype()];
  const float radius = kMargin * info.radiusMeters * instance.scale();
  // The coarsest level whose loss a tile does not show, its puffs from the farthest to the nearest.
  std::uint32_t level = info.levels - 1;
  while (level > 0 && info.errorMeters[level] * instance.scale() * kTilePixels > kErrorPixels * 2 * radius) --level;
  const std::uint32_t count = std::min(info.count[level], static_cast<std::uint32_t>(sorted_.size()));
  const Turn turn = turnOf(instance.yaw_step());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t puff = info.first[level] + i;
    sorted_[i] = {dot(placed(instance, turn, pack.centers()[puff]), tile.towardsEye), {tile.cloud, puff}};
  }
  std::sort(sorted_.begin(), sorted_.begin() + count, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.puff < b.second.puff;
  });
  for (std::uint32_t i = 0; i < count; ++i) puffs_[i] = sorted_[i].second;
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(DrawPuff)), puffs_.data());

  const Vec3 offset = info.middle * instance.scale();
  const float place[8]{tile.towardsEye.x, tile.towardsEye.y, tile.towardsEye.z, radius, offset.x, offset.y, offset.z, 0};
  glBindTexture(GL_TEXTURE_2D, places_.id());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(index), 2, 1, GL_RGBA, GL_FLOAT, place);

  glBindFramebuffer(GL_FRAMEBUFFER, target_.id());
  const int x = static_cast<int>(index) % kTilesAcross * kTilePixels, y = static_cast<int>(index) / kTilesAcross * kTilePixels;
  glViewport(x, y, kTilePixels, kTilePixels);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, kTilePixels, kTilePixels);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  Camera view;
  view.eye = camera.eye;
  view.forward = tile.towardsEye * -1;
  view.up = std::abs(tile.towardsEye.y) > 0.999f ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
  view.widthPixels = view.heightPixels = kTilePixels;
  view.verticalFieldRadians = 2 * std::atan(radius / tile.distance);
  brush.begin(view, sky, 1 / view.focalPixels(), {});
  brush.setClear();
  brush.draw(buffer_, 0, count);
  glDisable(GL_SCISSOR_TEST);
}

void Impostors::begin(const Camera& camera, const Texture& sky, const PackTextures& textures) noexcept {
  useProgram(program_, camera, *runtime_);
  int unit = textures.bind(program_, 0);
  bindTexture(program_, "uSky", unit++, GL_TEXTURE_2D, sky);
  bindTexture(program_, "uPlaces", unit++, GL_TEXTURE_2D, places_);
  bindTexture(program_, "uAtlas", unit, GL_TEXTURE_2D, atlas_);
}

}  // namespace cloudgen::runtime::gles
