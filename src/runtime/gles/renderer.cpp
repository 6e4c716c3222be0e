// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/renderer.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "runtime/gles/patches.hpp"
#include "runtime/gles/shaders.hpp"

namespace cloudgen::runtime::gles {
namespace {

constexpr float kHazeHeightMeters = 2200, kHazeLengthMeters = 42'000;
constexpr int kShadowPixels = 1024;
/// Whoever climbs or sinks by this share of the air's height sees another sky.
constexpr float kSkyAnewMeters = 400;

/// As shader::kPuffVertex lays it out (std140).
struct Locks {
  std::uint32_t puff[kMostLocked][4];
  float facing[kMostLocked][4];
};

void setVec3(const Program& program, const char* name, const Vec3& v) { glUniform3f(uniform(program, name), v.x, v.y, v.z); }

}  // namespace

Status Renderer::make(const Runtime& runtime, DecodePng decode, int mostWidth, int mostHeight,
                      const RendererOptions& options) noexcept {
  *this = Renderer();
  runtime_ = &runtime;
  options_ = options;
  resolution_ = Resolution(options.finestScale, options.targetMilliseconds);
  mostWidth_ = mostWidth;
  mostHeight_ = mostHeight;
  if (const Status made = makePrograms(); !made) return made;
  if (const Status made = textures_.make(runtime.pack(), runtime.lighting(), runtime.mostClouds(), decode); !made) return made;
  try {
    skyTable_ = std::make_unique<SkyTable>();
    makePatches();
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the sky"};
  }
  sky_ = newTexture2d(GL_RGBA16F, SkyTable::kColumns, SkyTable::kRows, Filter::Linear, Border::Clamp);
  cloudLight_ = newTexture2d(GL_SRGB8_ALPHA8, mostWidth, mostHeight, Filter::Linear, Border::Clamp);
  cloudTarget_ = newFramebuffer(cloudLight_);
  shadow_ = newTexture2d(GL_R8, kShadowPixels, kShadowPixels, Filter::Linear, Border::Clamp);
  shadowTarget_ = newFramebuffer(shadow_);

  drawBuffer_ = newBuffer();
  noArray_ = newVertexArray();
  puffArray_ = newVertexArray();
  glBindVertexArray(puffArray_.id());
  glBindBuffer(GL_ARRAY_BUFFER, drawBuffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(runtime.mostPuffs(), 1) * sizeof(DrawPuff)), nullptr,
               GL_DYNAMIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribDivisor(0, 1);
  lockBuffer_ = newBuffer();
  glBindBuffer(GL_UNIFORM_BUFFER, lockBuffer_.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(Locks), nullptr, GL_DYNAMIC_DRAW);
  glUniformBlockBinding(puffProgram_.id(), glGetUniformBlockIndex(puffProgram_.id(), "Locks"), 0);
  setLight();
  return glGetError() == GL_NO_ERROR ? Status{} : Status{"OpenGL has no room for the pictures"};
}

Status Renderer::makePrograms() noexcept {
  try {
    const std::string readers = std::string(shader::kCommon) + PackTextures::kReaders;
    if (const Status made = makeProgram(readers.c_str(), shader::kPuffVertex, shader::kPuffFragment, puffProgram_); !made)
      return made;
    if (const Status made = makeProgram(readers.c_str(), shader::kShadowVertex, shader::kShadowFragment, shadowProgram_); !made)
      return made;
    return makeProgram(shader::kCommon, shader::kPictureVertex, shader::kPictureFragment, pictureProgram_);
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the shaders"};
  }
}

void Renderer::makePatches() {
  patches_ = newTexture2d(GL_R8, kPatchesAcross, kPatchesAcross, Filter::Mipmaps, Border::Repeat);
  const auto texels = groundPatches();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kPatchesAcross, kPatchesAcross, GL_RED, GL_UNSIGNED_BYTE, texels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
}

void Renderer::setLight() noexcept {
  textures_.setLight(runtime_->pack(), runtime_->lighting());
  isShadowOld_ = isSkyOld_ = true;
}

void Renderer::lightFrom(float eyeHeight) noexcept {
  if (!isSkyOld_ && std::abs(eyeHeight - skyHeight_) < kSkyAnewMeters) return;
  const Lighting& lighting = runtime_->lighting();
  const float elevation = 57.29578f * std::asin(std::clamp(lighting.sunDirection().y, -1.0f, 1.0f));
  skyTable_->fill(lighting, lighting.sunColorAtGround(), elevation, eyeHeight - runtime_->groundMeters());
  glBindTexture(GL_TEXTURE_2D, sky_.id());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, SkyTable::kColumns, SkyTable::kRows, GL_RGBA, GL_FLOAT, skyTable_->texels.data());
  skyHeight_ = eyeHeight;
  isSkyOld_ = false;
}

void Renderer::useProgram(const Program& program, const Camera& camera) noexcept {
  glUseProgram(program.id());
  const Vec3 forward = normalized(camera.forward), right = normalized(cross(forward, camera.up)), up = cross(right, forward);
  const float focal = camera.focalPixels();
  setVec3(program, "uEye", camera.eye);
  setVec3(program, "uRight", right);
  setVec3(program, "uUp", up);
  setVec3(program, "uForward", forward);
  glUniform2f(uniform(program, "uLens"), 2 * focal / static_cast<float>(camera.widthPixels),
              2 * focal / static_cast<float>(camera.heightPixels));
  setVec3(program, "uSun", runtime_->lighting().sunDirection());
  glUniform1f(uniform(program, "uGround"), runtime_->groundMeters());
  const float perMeter = std::exp(-std::max(0.0f, camera.eye.y) / kHazeHeightMeters) / kHazeLengthMeters;
  glUniform2f(uniform(program, "uHaze"), perMeter, kHazeHeightMeters);
}

void Renderer::drawPuffs(std::size_t first, std::size_t count) noexcept {
  glBindVertexArray(puffArray_.id());
  glBindBuffer(GL_ARRAY_BUFFER, drawBuffer_.id());
  glVertexAttribIPointer(0, 2, GL_UNSIGNED_INT, sizeof(DrawPuff), reinterpret_cast<const void*>(first * sizeof(DrawPuff)));
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

void Renderer::drawShadows(const Frame& frame) noexcept {
  // Of the puffs that are drawn now, on the ground that they can fall on.
  Vec3 lower{1e30f, 0, 1e30f}, upper{-1e30f, 0, -1e30f};
  const Vec3 sun = runtime_->lighting().sunDirection();
  const float fall = 1 / std::max(sun.y, 0.14f), ground = runtime_->groundMeters();
  std::uint32_t before = 0xffffffff;
  for (const DrawPuff& puff : frame.puffs) {
    if (puff.instance == before) continue;
    before = puff.instance;
    const pack::Instance& cloud = frame.clouds[puff.instance];
    const ArchetypeInfo& info = runtime_->pack().archetypes()[cloud.archetype()];
    const Vec3 middle = vec3(cloud.position()) + info.middle * cloud.scale();
    const float reach = info.radiusMeters * cloud.scale(), down = (middle.y - ground) * fall;
    lower = {std::min(lower.x, middle.x - sun.x * down - reach), 0, std::min(lower.z, middle.z - sun.z * down - reach)};
    upper = {std::max(upper.x, middle.x - sun.x * down + reach), 0, std::max(upper.z, middle.z - sun.z * down + reach)};
  }
  const float side = std::max({upper.x - lower.x, upper.z - lower.z, 1.0f});
  shadowBox_ = {lower.x, lower.z, 1 / side, 1 / side};
  shadowCell_ = side / kShadowPixels;

  glBindFramebuffer(GL_FRAMEBUFFER, shadowTarget_.id());
  glViewport(0, 0, kShadowPixels, kShadowPixels);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glBlendFunc(GL_ONE, GL_ONE);
  glUseProgram(shadowProgram_.id());
  textures_.bind(shadowProgram_, 0);
  setVec3(shadowProgram_, "uSun", sun);
  glUniform1f(uniform(shadowProgram_, "uGround"), ground);
  glUniform1f(uniform(shadowProgram_, "uCell"), shadowCell_);
  glUniform4fv(uniform(shadowProgram_, "uShadowBox"), 1, shadowBox_.data());
  drawPuffs(0, frame.puffs.size());
}

void Renderer::draw(const Frame& frame, const Camera& camera, GLuint framebuffer, double frameMilliseconds) noexcept {
  resolution_.tell(frameMilliseconds);
  lightFrom(camera.eye.y);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  if (isNew_ || frame.cloudsChanged) textures_.setClouds(frame.clouds);
  if (isNew_ || frame.puffsChanged) {
    glBindBuffer(GL_ARRAY_BUFFER, drawBuffer_.id());
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(frame.puffs.size_bytes()), frame.puffs.data());
  }
  if (isShadowOld_ || frame.cloudsChanged) drawShadows(frame);
  isShadowOld_ = isNew_ = false;

  const int width = std::min(camera.widthPixels, mostWidth_), height = std::min(camera.heightPixels, mostHeight_);
  const float scale = resolution_.scale();
  const int cloudWidth = std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(width)))),
            cloudHeight = std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(height))));
  glBindFramebuffer(GL_FRAMEBUFFER, cloudTarget_.id());
  glViewport(0, 0, cloudWidth, cloudHeight);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, cloudWidth, cloudHeight);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  useProgram(puffProgram_, camera);
  int unit = textures_.bind(puffProgram_, 0);
  bindTexture(puffProgram_, "uSky", unit, GL_TEXTURE_2D, sky_);
  setVec3(puffProgram_, "uCameraUp", camera.up);
  glUniform1f(uniform(puffProgram_, "uPixel"), 1 / (camera.focalPixels() * scale));
  glUniform1i(uniform(puffProgram_, "uLocked"), static_cast<GLint>(frame.locked.size()));
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, lockBuffer_.id());
  for (std::size_t i = 0; i < frame.locked.size(); ++i) {
    const auto& [puff, facing] = frame.locked[i];
    const std::uint32_t name[4]{puff.instance, puff.puff, 0, 0};
    const float way[4]{facing.x, facing.y, facing.z, 0};
    glBufferSubData(GL_UNIFORM_BUFFER, static_cast<GLintptr>(offsetof(Locks, puff) + i * sizeof(name)), sizeof(name), name);
    glBufferSubData(GL_UNIFORM_BUFFER, static_cast<GLintptr>(offsetof(Locks, facing) + i * sizeof(way)), sizeof(way), way);
  }
  drawPuffs(0, frame.puffs.size());

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_BLEND);
  useProgram(pictureProgram_, camera);
  bindTexture(pictureProgram_, "uSky", 0, GL_TEXTURE_2D, sky_);
  bindTexture(pictureProgram_, "uCloudLight", 1, GL_TEXTURE_2D, cloudLight_);
  bindTexture(pictureProgram_, "uShadow", 2, GL_TEXTURE_2D, shadow_);
  bindTexture(pictureProgram_, "uPatches", 3, GL_TEXTURE_2D, patches_);
  glUniform2f(uniform(pictureProgram_, "uCloudShare"), static_cast<float>(cloudWidth) / static_cast<float>(mostWidth_),
              static_cast<float>(cloudHeight) / static_cast<float>(mostHeight_));
  const Lighting& lighting = runtime_->lighting();
  const Vec3 sun = lighting.sunColorAtGround();
  setVec3(pictureProgram_, "uGroundColor", lighting.sky().ground);
  setVec3(pictureProgram_, "uSunlight", lighting.sunDirection().y > -0.009f ? skyTable_->sunlight : Vec3{});
  setVec3(pictureProgram_, "uDimSun", sun * std::max(lighting.sunDirection().y, 0.0f));
  setVec3(pictureProgram_, "uDimOther", lighting.sky().ambient * 0.62f);
  glUniform4fv(uniform(pictureProgram_, "uShadowBox"), 1, shadowBox_.data());
  glBindVertexArray(noArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace cloudgen::runtime::gles
