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

constexpr int kShadowPixels = 1024;
constexpr std::size_t kMostShadows = std::size_t{1} << 18;
/// Sky and ground are smooth: they are drawn at this part of the resolution.
constexpr int kBackdropShare = 3;
/// Whoever climbs or sinks by this share of the air's height sees another sky.
constexpr float kSkyAnewMeters = 400;

/// What light is added up in: half floats where the device can draw into them, else bytes by the sRGB curve.
void makeLightTarget(int width, int height, Texture& texture, Framebuffer& target) noexcept {
  for (const GLenum format : {GLenum{GL_RGBA16F}, GLenum{GL_SRGB8_ALPHA8}}) {
    texture = newTexture2d(format, width, height, Filter::Linear, Border::Clamp);
    target = newFramebuffer(texture);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  }
}

}  // namespace

Status Renderer::make(const Runtime& runtime, DecodePng decode, int mostWidth, int mostHeight,
                      const RendererOptions& options) noexcept {
  *this = Renderer();
  runtime_ = &runtime;
  options_ = options;
  resolution_ = Resolution(options.finestScale, options.targetMilliseconds);
  most_ = {mostWidth, mostHeight};
  if (const Status made = makePrograms(); !made) return made;
  if (const Status made = textures_.make(runtime.pack(), runtime.lighting(), runtime.mostClouds(), decode); !made) return made;
  if (const Status made = brush_.make(runtime, textures_); !made) return made;
  if (const Status made = impostors_.make(runtime); !made) return made;
  if (options.volumes)
    if (const Status made = volumes_.make(runtime); !made) return made;
  try {
    list_.reserve(runtime.mostPuffs());
    shadows_.reserve(kMostShadows);
    runs_.reserve(2 * Impostors::kMost + 1);
    skyTable_ = std::make_unique<SkyTable>();
    makePatches();
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the sky"};
  }
  sky_ = newTexture2d(GL_RGBA16F, SkyTable::kColumns, SkyTable::kRows, Filter::Linear, Border::Clamp);
  makeLightTarget(mostWidth, mostHeight, cloudLight_, cloudTarget_);
  makeLightTarget(mostWidth / kBackdropShare + 1, mostHeight / kBackdropShare + 1, backdrop_, backdropTarget_);
  shadow_ = newTexture2d(GL_R8, kShadowPixels, kShadowPixels, Filter::Linear, Border::Clamp);
  shadowTarget_ = newFramebuffer(shadow_);

  noArray_ = newVertexArray();
  shadowArray_ = newVertexArray();
  shadowBuffer_ = newBuffer();
  glBindBuffer(GL_ARRAY_BUFFER, shadowBuffer_.id());
  glBufferData(GL_ARRAY_BUFFER, kMostShadows * sizeof(DrawPuff), nullptr, GL_STATIC_DRAW);
  drawBuffer_ = newBuffer();
  glBindBuffer(GL_ARRAY_BUFFER, drawBuffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(runtime.mostPuffs(), 1) * sizeof(DrawPuff)), nullptr,
               GL_DYNAMIC_DRAW);
  setLight();
  return glGetError() == GL_NO_ERROR ? Status{} : Status{"OpenGL has no room for the pictures"};
}

Status Renderer::makePrograms() noexcept {
  try {
    const std::string readers = std::string(shader::kCommon) + PackTextures::kReaders;
    if (const Status made = makeProgram(readers.c_str(), shader::kShadowVertex, shader::kShadowFragment, shadowProgram_); !made)
      return made;
    if (const Status made = makeProgram(shader::kCommon, shader::kPictureVertex, shader::kBackdropFragment, backdropProgram_); !made)
      return made;
    const std::string withSun = std::string("#define SUN_IN_VIEW\n") + shader::kCommon;
    if (const Status made = makeProgram(withSun.c_str(), shader::kPictureVertex, shader::kPictureFragment, sunPictureProgram_); !made)
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
  impostors_.forget();
  if (options_.volumes) volumes_.light();
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

/// The list with the grids or tiles of whole clouds instead of kImpostor, and its runs of each kind.
void Renderer::upload(const Frame& frame, const Camera& camera) noexcept {
  impostors_.beginFrame();
  bool isChanged = isNew_ || frame.puffsChanged;
  if (isChanged) {
    list_.assign(frame.puffs.begin(), frame.puffs.end());
    runs_.clear();
    for (std::uint32_t i = 0; i < list_.size(); ++i) {
      DrawPuff& puff = list_[i];
      Run::Kind kind = Run::Puffs;
      if (puff.puff == kImpostor) {
        if (options_.volumes) puff.puff = volumes_.gridOf(frame.clouds[puff.instance]);
        kind = puff.puff == kImpostor ? Run::Picture : Run::Volume;
      }
      if (runs_.empty() || runs_.back().kind != kind) runs_.push_back({i, 0, kind});
      ++runs_.back().count;
    }
  }
  for (const Run& run : runs_) {
    if (run.kind != Run::Picture) continue;
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const std::uint32_t tile = impostors_.tileOf(list_[i].instance, frame, camera, sky_, brush_);
      isChanged |= list_[i].puff != tile;
      list_[i].puff = tile;
    }
  }
  if (!isChanged) return;
  glBindBuffer(GL_ARRAY_BUFFER, drawBuffer_.id());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(list_.size() * sizeof(DrawPuff)), list_.data());
}

/// Those of all clouds, wherever one looks, by their coarse puffs.
void Renderer::drawShadows(const Frame& frame) noexcept {
  Vec3 lower{1e30f, 0, 1e30f}, upper{-1e30f, 0, -1e30f};
  const Vec3 sun = runtime_->lighting().sunDirection();
  const float fall = 1 / std::max(sun.y, 0.14f), ground = runtime_->groundMeters();
  shadows_.clear();
  for (std::uint32_t i = 0; i < frame.clouds.size(); ++i) {
    const pack::Instance& cloud = frame.clouds[i];
    const ArchetypeInfo& info = runtime_->pack().archetypes()[cloud.archetype()];
    const Vec3 middle = vec3(cloud.position()) + info.middle * cloud.scale();
    const float reach = info.radiusMeters * cloud.scale(), down = (middle.y - ground) * fall;
    lower = {std::min(lower.x, middle.x - sun.x * down - reach), 0, std::min(lower.z, middle.z - sun.z * down - reach)};
    upper = {std::max(upper.x, middle.x - sun.x * down + reach), 0, std::max(upper.z, middle.z - sun.z * down + reach)};
    const std::uint32_t level = info.levels > 1 ? info.levels - 2 : 0;
    for (std::uint32_t p = 0; p < info.count[level] && shadows_.size() < kMostShadows; ++p)
      shadows_.push_back({i, info.first[level] + p});
  }
  const float side = std::max({upper.x - lower.x, upper.z - lower.z, 1.0f});
  shadowBox_ = {lower.x, lower.z, 1 / side, 1 / side};
  shadowCell_ = side / kShadowPixels;

  glBindFramebuffer(GL_FRAMEBUFFER, shadowTarget_.id());
  glViewport(0, 0, kShadowPixels, kShadowPixels);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glUseProgram(shadowProgram_.id());
  textures_.bind(shadowProgram_, 0);
  setVec3(shadowProgram_, "uSun", sun);
  glUniform1f(uniform(shadowProgram_, "uGround"), ground);
  glUniform1f(uniform(shadowProgram_, "uCell"), shadowCell_);
  glUniform4fv(uniform(shadowProgram_, "uShadowBox"), 1, shadowBox_.data());
  glBindBuffer(GL_ARRAY_BUFFER, shadowBuffer_.id());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(shadows_.size() * sizeof(DrawPuff)), shadows_.data());
  drawQuads(shadowArray_, shadowBuffer_, 0, shadows_.size());
}

void Renderer::drawClouds(const Frame& frame, const Camera& camera) noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, cloudTarget_.id());
  glViewport(0, 0, cloudSize_.width, cloudSize_.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, cloudSize_.width, cloudSize_.height);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const float pixel = 1 / (camera.focalPixels() * resolution_.scale());
  for (const Run& run : runs_) {
    if (run.kind == Run::Picture) {
      impostors_.begin(camera, sky_, textures_);
      impostors_.draw(drawBuffer_, run.first, run.count);
    } else if (run.kind == Run::Volume) {
      volumes_.begin(camera, sky_, textures_);
      volumes_.draw(drawBuffer_, run.first, run.count);
    } else {
      brush_.begin(camera, sky_, pixel, frame.locked);
      brush_.draw(drawBuffer_, run.first, run.count);
    }
  }
}

void Renderer::drawBackdrop(const Camera& camera) noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, backdropTarget_.id());
  glViewport(0, 0, backdropSize_.width, backdropSize_.height);
  glDisable(GL_BLEND);
  useProgram(backdropProgram_, camera, *runtime_);
  bindTexture(backdropProgram_, "uSky", 0, GL_TEXTURE_2D, sky_);
  bindTexture(backdropProgram_, "uShadow", 1, GL_TEXTURE_2D, shadow_);
  bindTexture(backdropProgram_, "uPatches", 2, GL_TEXTURE_2D, patches_);
  const Lighting& lighting = runtime_->lighting();
  setVec3(backdropProgram_, "uGroundColor", lighting.sky().ground);
  setVec3(backdropProgram_, "uDimSun", lighting.sunColorAtGround() * std::max(lighting.sunDirection().y, 0.0f));
  setVec3(backdropProgram_, "uDimOther", lighting.sky().ambient * 0.62f);
  glUniform4fv(uniform(backdropProgram_, "uShadowBox"), 1, shadowBox_.data());
  glBindVertexArray(noArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::drawPicture(const Camera& camera, GLuint framebuffer) noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, picture_.width, picture_.height);
  glDisable(GL_BLEND);
  // Its glare reaches 20 degrees; half a picture's diagonal is what one looks beside it.
  const Vec3 sun = runtime_->lighting().sunDirection();
  const float halfDiagonal = std::atan(0.5f * std::hypot(static_cast<float>(camera.widthPixels), static_cast<float>(camera.heightPixels)) / camera.focalPixels());
  const bool isSunSeen = sun.y > -0.009f && dot(sun, normalized(camera.forward)) > std::cos(std::min(halfDiagonal + 0.35f, 3.14f));
  const Program& program = isSunSeen ? sunPictureProgram_ : pictureProgram_;
  useProgram(program, camera, *runtime_);
  bindTexture(program, "uCloudLight", 0, GL_TEXTURE_2D, cloudLight_);
  bindTexture(program, "uBackdrop", 1, GL_TEXTURE_2D, backdrop_);
  const auto setPart = [&](const char* name, const Size& part, const Size& whole) {
    const auto w = static_cast<float>(part.width), h = static_cast<float>(part.height);
    glUniform4f(uniform(program, name), w / static_cast<float>(whole.width), h / static_cast<float>(whole.height), 0.5f / w, 0.5f / h);
  };
  setPart("uCloudPart", cloudSize_, most_);
  setPart("uBackdropPart", backdropSize_, {most_.width / kBackdropShare + 1, most_.height / kBackdropShare + 1});
  setVec3(program, "uSunlight", skyTable_->sunlight);
  glBindVertexArray(noArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::draw(const Frame& frame, const Camera& camera, GLuint framebuffer, double frameMilliseconds) noexcept {
  resolution_.tell(frameMilliseconds);
  lightFrom(camera.eye.y);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  if (isNew_ || frame.cloudsChanged) textures_.setClouds(frame.clouds);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  upload(frame, camera);
  if (isShadowOld_ || frame.cloudsChanged) drawShadows(frame);
  isShadowOld_ = isNew_ = false;

  picture_ = {std::min(camera.widthPixels, most_.width), std::min(camera.heightPixels, most_.height)};
  const auto part = [](int whole, float share) { return std::max(1, static_cast<int>(std::lround(share * static_cast<float>(whole)))); };
  cloudSize_ = {part(picture_.width, resolution_.scale()), part(picture_.height, resolution_.scale())};
  backdropSize_ = {part(picture_.width, 1.0f / kBackdropShare), part(picture_.height, 1.0f / kBackdropShare)};
  drawClouds(frame, camera);
  drawBackdrop(camera);
  drawPicture(camera, framebuffer);
}

}  // namespace cloudgen::runtime::gles
