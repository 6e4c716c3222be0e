// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "image/volume.hpp"

namespace cloudgen::image {

class HeapNoise;

/// One ray through a volume, from near to far.
class March {
 public:
  /// `blobs` by `enter`.
  March(std::span<const Blob> blobs, const View& view, const VolumeOptions& options, const Ray& ray,
        const Haze& haze);

  Gathered run(float far, float jitter);

 private:
  /// A blob as the ray crosses it: a Gaussian of the distance.
  struct Crossing {
    std::uint32_t blob = 0;
    float middle = 0, deviation = 1, closest2 = 0;  ///< closest2: least squared deviations from the centre
    float start = 0, end = 0;
  };
  /// Sums over the blobs at a place, each weighed by its extinction there.
  struct Field {
    float extinction = 0, own = 0, scale = 0, billow = 0, deviation = 0, ice = 0, thread = 0;
    glm::vec3 color{0};
    glm::vec3 alongThread{0};  ///< from the middles of threads, along them
  };

  void meet(std::uint32_t blob, float after);
  void beginNext();
  static bool startsLater(const Crossing& a, const Crossing& b);
  Field fieldOnRay(float distance) const;
  static void addThread(Field& field, const Blob& blob, float extinction, const glm::vec3& point);
  Field fieldAt(const glm::vec3& point) const;
  float eaten(const Field& field, const glm::vec3& point, float shortest) const;
  float lightAt(const glm::vec3& point, float scale, float shortest) const;

  std::span<const Blob> blobs_;
  const VolumeOptions& options_;
  const Haze& haze_;
  const HeapNoise& noise_;
  glm::vec3 eye_, origin_, direction_;  ///< origin from the eye
  float pixelAtOrigin_ = 0, pixelPerMeter_ = 0;
  std::vector<Crossing> crossings_;  ///< begun and not passed
  std::vector<Crossing> waiting_;    ///< ahead, a heap by start
};

}  // namespace cloudgen::image
