// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "image/splat.hpp"
#include "image/view.hpp"

namespace cloudgen::image {

/// A puff as a field of extinction about the eye: `extinction` * exp(-|toUnit (x - center)|^2 / 2), cut at
/// three deviations.
struct Blob {
  glm::vec3 center{0};  ///< from the view's eye
  float extinction = 0;
  glm::mat3 toUnit{1};  ///< from space to the blob's deviations
  glm::vec3 color{1};   ///< display-linear radiance, already as seen from the eye
  float scale = 1;      ///< geometric mean of the deviations, m
  float billow = 0;     ///< 1: a lump of a heap, 0: part of a sheet or a thread
  float ice = 0;        ///< share of ice
  glm::vec3 fibre{0};   ///< its long axis, as long as it is a thread: 1, or not: 0
  float enter = 0;      ///< distance from the eye at which rays may meet it
};

/// What a ray gathers.
struct Gathered {
  glm::vec3 radiance{0};     ///< display-linear, through haze
  float open = 1;            ///< share of what lies behind that is seen
  float water = 0, ice = 0;  ///< optical depths of each
  float distance = 0;  ///< mean distance of what is seen, m, weighed by how much of it is seen; 0 for nothing
};

/// The haze in front of what a ray meets.
struct Haze {
  glm::vec3 color{0};            ///< display-linear
  double perMeterAtEye = 0;      ///< extinction at the eye's height
  double scaleHeightMeters = 1;  ///< it falls off with
};

/// Share of a thing's own colour that reaches an eye this far from it along a ray that rises by
/// `risePerMeter`.
float clarityThrough(const Haze& haze, double risePerMeter, float distanceMeters);

struct VolumeOptions {
  bool detail = true;  ///< noise finer than the puffs, and the shadows that it throws
  glm::vec3 sunDirection{0, 1, 0};
  /// Share of a lit face's colour that the sun gives; the rest comes from the sky.
  float sunShare = 0.8f;
};

/// Clouds as extinction along rays. Puffs carry their light; this adds what is finer than they are: noise
/// eats into the skin of heaps (as Schneider & Vos 2015 erode a coarse cloud by a remap of its density), and
/// each sample is shaded by the optical depth of that eaten field a few puff widths towards the sun. Puffs
/// narrower than a pixel are widened to it and thinned, so that no light is gained or lost. The same for any
/// number of threads.
class Volume {
 public:
  Volume(std::span<const Splat> splats, const View& view, const VolumeOptions& options);

  /// Numbers of all blobs, by `enter`, and of those among a list that rays through a box of pixels may meet.
  std::span<const std::uint32_t> all() const { return all_; }
  std::vector<std::uint32_t> listFor(int left, int top, int width, int height,
                                     std::span<const std::uint32_t> among) const;

  /// The blobs of a list side by side: rays that are near each other read them again and again.
  std::vector<Blob> blobsOf(std::span<const std::uint32_t> list) const;
  /// All of them, by `enter`.
  std::span<const Blob> blobs() const { return blobs_; }

  /// Along a ray of the view as far as `farMeters` through blobs that are sorted by `enter`. `jitter` 0..1
  /// shifts the samples.
  Gathered along(const Ray& ray, std::span<const Blob> blobs, double farMeters, float jitter,
                 const Haze& haze) const;

 private:
  struct Box {
    float left, right, top, bottom;
  };
  View view_;
  VolumeOptions options_;
  std::vector<Blob> blobs_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> all_;
};

/// A jitter for a pixel's ray, as different as can be between neighbours (interleaved gradient noise, Jimenez
/// 2014).
float jitterAt(int x, int y);

}  // namespace cloudgen::image
