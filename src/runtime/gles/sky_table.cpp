// SPDX-License-Identifier: Apache-2.0
// The runtime has nothing of the compiler in it: image/atmosphere.cpp is the other end, and a test compares pictures.
#include "runtime/gles/sky_table.hpp"

#include <algorithm>

namespace cloudgen::runtime::gles {
namespace {

constexpr int kSteps = 24;
constexpr float kPi = 3.14159265f, kDegree = kPi / 180;
constexpr float kDuskDegrees = -7, kNightDegrees = -16;
constexpr float kAirHeight = 8000, kAerosolHeight = 1300, kAtmosphere = 60'000;
// Vertical optical depths at 680, 550 and 440 nm.
constexpr Vec3 kAir{0.042f, 0.098f, 0.240f}, kOzone{0.012f, 0.026f, 0.001f}, kAerosol{0.050f, 0.060f, 0.080f};

Vec3 thinned(const Vec3& depth) { return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)}; }

float smoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Relative air mass, Kasten & Young 1989.
float airMass(float elevationDegrees) {
  const float elevation = std::max(elevationDegrees, -1.0f);
  return 1 / (std::sin(kDegree * std::max(elevation, 0.0f)) + 0.50572f * std::pow(elevation + 6.07995f, -1.6364f));
}

/// Of the sky while the sun is just below the horizon: what ozone leaves of the light from high up.
constexpr Vec3 kTwilight{0.13f, 0.21f, 0.44f};

/// The sun as the sky is lit by it.
struct SunOfSky {
  float elevationDegrees, sine, cosine, mass, day, eyeHeight, degreesBelow;
};

/// What of the light scattered once is left when the sun is down: the Earth's shadow rises opposite to the sun and
/// overhead first.
float outOfShadow(float degreesBelow, float sine, float azimuthCosine) {
  return std::exp(-0.12f * degreesBelow * (0.7f * (1 - azimuthCosine) + 2.4f * sine));
}

/// In units of a white face under a sun at the zenith.
Vec3 scattered(float sine, float azimuthFromSun, const SunOfSky& sun) {
  constexpr float g = 0.76f;
  const float cosine = std::sqrt(1 - sine * sine) * sun.cosine * std::cos(azimuthFromSun) + sine * sun.sine;
  const float air = 3 / (16 * kPi) * (1 + cosine * cosine),
              aerosol = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5f));
  const float slant = 1 / std::max(sine, 0.03f), lowest = sun.eyeHeight * smoothStep(-0.05f, 0.30f, sine);
  Vec3 sum, through;
  for (int i = 0; i < kSteps; ++i) {
    const float from = static_cast<float>(i) / kSteps, to = static_cast<float>(i + 1) / kSteps;
    const float lower = kAtmosphere * from * from, upper = kAtmosphere * to * to, height = lowest + 0.5f * (lower + upper);
    const float airShare = std::exp(-height / kAirHeight), aerosolShare = std::exp(-height / kAerosolHeight);
    const Vec3 airHere = kAir * (airShare * (upper - lower) / kAirHeight * slant),
               aerosolHere = kAerosol * (aerosolShare * (upper - lower) / kAerosolHeight * slant);
    const Vec3 path = (kAir * airShare + kAerosol * aerosolShare) * sun.mass + kOzone * std::min(sun.mass, 12.0f);
    const Vec3 sunlight = thinned(path);
    // Light scattered before: the same from all sides, whiter than the sun's.
    const Vec3 again = thinned(path * 0.3f) * Vec3{1.0f, 1.1f, 1.25f} *
                       (0.55f * std::max(0.12f, sun.sine + 0.10f) * 2 / (4 * kPi));
    const Vec3 seen = thinned(through + (airHere + aerosolHere) * 0.5f);
    sum = sum + seen * (airHere * (sunlight * air + again) + aerosolHere * (sunlight * aerosol + again));
    through = through + airHere + aerosolHere;
  }
  const Vec3 white = thinned((kAir + kAerosol) * -1);
  return sum * white * (sun.day * kPi * outOfShadow(sun.degreesBelow, sine, std::cos(azimuthFromSun)));
}

}  // namespace

void SkyTable::fill(const Lighting& lighting, const Vec3& sunColor, float elevationDegrees, float eyeHeightMeters) noexcept {
  const SkyColors& sky = lighting.sky();
  const float face = dot(sunColor * 0.9f + sky.ambient * 0.4f, {0.2126f, 0.7152f, 0.0722f}),
              exposure = 1 / std::max(0.02f, face), gain = 2.1f * std::pow(exposure, 0.65f);
  sunlight = sunColor * exposure;
  const float dusk = smoothStep(kNightDegrees, kDuskDegrees, elevationDegrees);
  const SunOfSky sun{elevationDegrees,
                     std::sin(kDegree * elevationDegrees),
                     std::cos(kDegree * elevationDegrees),
                     airMass(elevationDegrees),
                     std::clamp((elevationDegrees - kDuskDegrees) / 9, 0.02f, 1.0f) * dusk,
                     std::clamp(eyeHeightMeters, 0.0f, 30'000.0f),
                     std::clamp(-elevationDegrees, 0.0f, 18.0f)};
  const float twilight = (1 - smoothStep(-4, 1, elevationDegrees)) * std::exp(-0.33f * sun.degreesBelow),
              night = 1 - smoothStep(-9, -5, elevationDegrees);
  float* out = texels.data();
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const float up = static_cast<float>(row) / (kRows - 1), aside = static_cast<float>(column) / (kColumns - 1);
      const float sine = std::max(0.004f, up * up);
      const Vec3 ofNight = mix(sky.zenith, sky.horizon, std::exp(-3.5f * sine)) * night,
                 ofTwilight = kTwilight * (twilight * (0.6f + 0.4f * sine));
      const Vec3 color = scattered(sine, kPi * aside * aside, sun) * gain + ofTwilight + ofNight;
      for (const float channel : {color.x, color.y, color.z, 1.0f}) *out++ = channel;
    }
}

}  // namespace cloudgen::runtime::gles
