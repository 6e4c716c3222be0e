// SPDX-License-Identifier: Apache-2.0
#include "runtime/lighting.hpp"

#include <algorithm>
#include <array>

#include "runtime/selection.hpp"

namespace cloudgen::runtime {
namespace {

constexpr std::size_t kHarmonics = 16;
using Harmonics = std::array<float, kHarmonics>;

float luminance(const Vec3& color) { return dot(color, {0.2126f, 0.7152f, 0.0722f}); }

/// Real spherical harmonics to degree 3, as schemas/runtime_pack.fbs orders them (Sloan 2008; y up). The runtime has
/// nothing of the compiler in it: light/harmonics.cpp is the other end, and a test compares the colours.
Harmonics harmonicsOf(const Vec3& d) {
  const float x = d.x, y = d.z, z = d.y, xx = x * x, yy = y * y, zz = z * z;
  return {0.28209479f,
          0.48860251f * y,
          0.48860251f * z,
          0.48860251f * x,
          1.09254843f * x * y,
          1.09254843f * y * z,
          0.31539157f * (3 * zz - 1),
          1.09254843f * x * z,
          0.54627422f * (xx - yy),
          0.59004359f * y * (3 * xx - yy),
          2.89061144f * x * y * z,
          0.45704580f * y * (5 * zz - 1),
          0.37317633f * z * (5 * zz - 3),
          0.45704580f * x * (5 * zz - 1),
          1.44530572f * z * (xx - yy),
          0.59004359f * x * (xx - 3 * yy)};
}

float dotOf(const std::int8_t* bytes, const Harmonics& weights) {
  float sum = 0;
  for (std::size_t i = 0; i < kHarmonics; ++i) sum += static_cast<float>(bytes[i]) * weights[i];
  return sum;
}

/// As pack::Tone says.
Vec3 developed(const pack::Tone& tone, Vec3 color, float face) {
  color = color * std::pow(luminance(color) / face, tone.contrast() - 1);
  const float most = std::max({color.x, color.y, color.z});
  if (most > tone.knee())
    color = color * ((tone.knee() + tone.room() * (1 - std::exp((tone.knee() - most) / tone.room()))) / most);
  return color;
}

/// The sRGB curve (IEC 61966-2-1), by a table of its 256 steps' limits.
class SrgbSteps {
 public:
  SrgbSteps() noexcept {
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const float encoded = (static_cast<float>(i) + 0.5f) / 255;
      limits_[i] = encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
    }
  }
  std::uint8_t operator()(float linear) const noexcept {
    return static_cast<std::uint8_t>(std::lower_bound(limits_.begin(), limits_.end(), linear) - limits_.begin());
  }

 private:
  std::array<float, 255> limits_;
};
const SrgbSteps kSrgb;

/// The sun's direction in the axes of an archetype that is turned.
Vec3 turnedBack(const Vec3& d, std::uint32_t yawStep) {
  const Turn turn = turnOf(static_cast<std::uint8_t>(yawStep));
  return {turn.cosine * d.x - turn.sine * d.z, d.y, turn.cosine * d.z + turn.sine * d.x};
}

std::uint32_t firstPuff(const ArchetypeInfo& info) { return info.first[0]; }
/// From the first puff of the first level to the last of the last, which follow each other in packs of cloudgen.
std::uint32_t endPuff(const ArchetypeInfo& info) {
  std::uint32_t end = 0;
  for (std::uint32_t l = 0; l < info.levels; ++l) end = std::max(end, info.first[l] + info.count[l]);
  return end;
}

}  // namespace

Vec3 directionTo(const SunPlace& sun) noexcept {
  constexpr float kDegree = 0.017453293f;
  const float azimuth = sun.azimuthDegrees * kDegree, elevation = sun.elevationDegrees * kDegree;
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
}

Lighting::Lighting(const PackView& pack, bool allHeadings) : pack_(&pack) {
  rows_.assign(pack.archetypes().size() * kYawSteps, -1);
  std::vector<bool> wanted(rows_.size(), allHeadings);
  for (const pack::Instance& cloud : pack.instances()) wanted[cloud.archetype() * kYawSteps + cloud.yaw_step()] = true;
  std::size_t colors = 0, longest = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!wanted[row]) continue;
    const ArchetypeInfo& info = pack.archetypes()[row / kYawSteps];
    rows_[row] = static_cast<std::int64_t>(colors);
    const std::size_t count = endPuff(info) - std::min(firstPuff(info), endPuff(info));
    colors += count;
    longest = std::max(longest, count);
  }
  colors_.resize(colors);
  linear_.resize(longest);
  sunColors_.resize(pack.root().sun_heights()->size());
}

void Lighting::setSun(const SunPlace& sun) noexcept {
  const pack::RuntimePack& root = pack_->root();
  direction_ = directionTo(sun);
  // Between the two entries of daylight about the sun's elevation.
  const auto& days = *root.daylight();
  std::uint32_t above = 1;
  while (above + 1 < days.size() && days.Get(above)->elevation_degrees() < sun.elevationDegrees) ++above;
  const pack::Daylight &a = *days.Get(above - 1), &b = *days.Get(above);
  const float share = std::clamp(
      (sun.elevationDegrees - a.elevation_degrees()) / (b.elevation_degrees() - a.elevation_degrees()), 0.0f, 1.0f);
  sky_ = {mix(vec3(a.zenith()), vec3(b.zenith()), share), mix(vec3(a.horizon()), vec3(b.horizon()), share),
          mix(vec3(a.ground()), vec3(b.ground()), share), mix(vec3(a.ambient()), vec3(b.ambient()), share),
          mix(vec3(a.bounce()), vec3(b.bounce()), share)};
  const auto heights = static_cast<std::uint32_t>(sunColors_.size());
  for (std::uint32_t h = 0; h < heights; ++h)
    sunColors_[h] = mix(vec3(*root.sun_colors()->Get((above - 1) * heights + h)),
                        vec3(*root.sun_colors()->Get(above * heights + h)), share);
  const pack::Tone& tone = *root.tone();
  const float lift = std::pow(std::fmax(direction_.y, root.lift_lowest()), -root.lift_power());
  for (std::uint32_t row = 0; row < rows_.size(); ++row) {
    if (rows_[row] < 0) continue;
    const std::uint32_t archetype = row / kYawSteps;
    const float white =
        luminance(sunColor(archetype) * tone.white_sun() + sky_.ambient * skyShare(archetype)) + 1e-6f;
    const float exposure = std::min(tone.white() / white, tone.most_exposure());
    lightRow(archetype, row % kYawSteps, {exposure, exposure * white / tone.white(), lift});
  }
}

void Lighting::lightRow(std::uint32_t index, std::uint32_t yawStep, const Exposure& set) noexcept {
  const auto [exposure, face, lift] = set;
  const pack::Archetype& archetype = *pack_->root().archetypes()->Get(index);
  const ArchetypeInfo& info = pack_->archetypes()[index];
  const pack::Tone& tone = *pack_->root().tone();
  const Vec3 sun = sunColor(index), ambient = sky_.ambient * skyShare(index);
  Harmonics weights = harmonicsOf(turnedBack(direction_, yawStep)), forward = weights;
  for (std::size_t i = 0; i < kHarmonics; ++i) {
    weights[i] *= archetype.sun_scale()->Get(static_cast<std::uint32_t>(i)) / 127;
    forward[i] *= archetype.forward_scale()->Get(static_cast<std::uint32_t>(i)) / 127;
  }
  const std::uint32_t first = firstPuff(info), end = endPuff(info);
  PuffColor* const colors = colors_.data() + rows_[index * kYawSteps + yawStep];
  Vec3 mean;
  float meanWeight = 0;
  for (std::uint32_t p = first; p < end; ++p) {
    const pack::Response& response = pack_->responses()[p];
    const auto* const bytes = reinterpret_cast<const std::int8_t*>(&response);
    const float level = static_cast<float>(pack_->puffs()[p].level()) / 255;
    const float answer = (1 + level * (lift - 1)) *
                         std::fmin(std::fmax(dotOf(bytes, weights), archetype.sun_least()), archetype.sun_most());
    const Vec3 radiance = sun * answer + ambient * (static_cast<float>(response.sky()) / 255) +
                          sky_.bounce * (static_cast<float>(response.ground()) / 255);
    const Vec3 color = developed(tone, radiance * exposure, face);
    linear_[p - first] = color;
    const float weight = static_cast<float>(response.weight());
    mean = mean + color * weight;
    meanWeight += weight;
    const float seen = static_cast<float>(response.seen()) / 255,
                beam = std::fmin(std::fmax(dotOf(bytes + kHarmonics, forward), 0.0f), archetype.forward_most()),
                lining = std::fmin(std::fmax(beam + exposure * archetype.beam() * answer, 0.0f), tone.most_forward());
    colors[p - first].forward =
        static_cast<std::uint8_t>(std::fmin(std::fmax(0.0f, seen * lining * (255 / kMostForward)), 255.0f) + 0.5f);
  }
  if (meanWeight > 0) mean = mean * (1 / meanWeight);
  for (std::uint32_t p = first; p < end; ++p) {
    const float seen = meanWeight > 0 ? static_cast<float>(pack_->responses()[p].seen()) / 255 : 1.0f;
    const Vec3 color = mix(mean, linear_[p - first], seen);
    PuffColor& out = colors[p - first];
    out.red = kSrgb(color.x);
    out.green = kSrgb(color.y);
    out.blue = kSrgb(color.z);
  }
}

Vec3 Lighting::sunColor(std::uint32_t archetype) const noexcept {
  return sunColors_[pack_->root().archetypes()->Get(archetype)->sun_height()];
}

float Lighting::skyShare(std::uint32_t archetype) const noexcept {
  const pack::Tone& tone = *pack_->root().tone();
  const float sun = std::fmin(1.0f, luminance(sunColor(archetype)));
  return tone.sky_without_sun() + sun * (tone.sky_at_noon() - tone.sky_without_sun());
}

Dimming Lighting::dimming(std::uint32_t archetype) const noexcept {
  const pack::Tone& tone = *pack_->root().tone();
  return {sunColor(archetype) * tone.mean_sun(), sky_.ambient * (tone.mean_sky() * skyShare(archetype)) + sky_.bounce * tone.mean_ground()};
}

}  // namespace cloudgen::runtime
