// SPDX-License-Identifier: Apache-2.0
#include "made_model.hpp"

#include <cmath>

namespace cloudgen::check::test {

namespace {

/// Of a blob with a deviation of 1: the area that is cloudy to the imager, and the optical depth over it.
struct Cloudy {
  double area = 0, opticalDepth = 0;
};

Cloudy cloudyPart(BlobKind kind) {
  constexpr double kStep = 0.005, kHalf = 4;
  const double reach = kind == BlobKind::Card ? kCardReach : kHalf;
  Cloudy cloudy;
  for (double x = -reach + 0.5 * kStep; x < reach; x += kStep)
    for (double y = -reach + 0.5 * kStep; y < reach; y += kStep) {
      const double here = std::hypot(x, y) > reach ? 0 : std::exp(-0.5 * (x * x + y * y));
      if (-std::expm1(-kPeak) * here > -std::expm1(-kCloudyOpticalDepth)) cloudy.area += kStep * kStep;
      cloudy.opticalDepth += kPeak * here * kStep * kStep;
    }
  return cloudy;
}

Blob cloudAt(const glm::vec3& center, BlobKind kind, double sigma, double upright) {
  const auto side = static_cast<float>(sigma), height = static_cast<float>(upright);
  if (kind == BlobKind::Card) return cardBlob(center, {side, 0, 0}, {0, 0, -side}, kPeak);
  glm::mat3 axes(0);
  axes[0][0] = axes[2][2] = side;
  axes[1][1] = height;
  return volumeBlob(center, axes, static_cast<float>(kPeak * std::min(sigma, upright) / upright));
}

}  // namespace

MadeSky::MadeSky(BlobKind kind) : frame(model.box()) {
  constexpr int kColumns = 12, kRows = 19, kClouds = kColumns * kRows;  // about square
  const Cloudy cloudy = cloudyPart(kind);
  for (std::uint32_t cell = 0; cell < model.grid().size(); ++cell) {
    const bool dense = (model.grid().column(cell) + model.grid().row(cell)) % 2 == 0;
    const double cover = dense ? 0.5 : 0.2;
    const double area = field::cellAreaSquareMeters(model.grid(), cell);
    const double sigma = std::sqrt(cover * area / (kClouds * cloudy.area));
    const float base = dense ? 1000 : 7000, depth = dense ? 800 : 500;
    const base::Genus genus = dense ? base::Genus::Cumulus : base::Genus::Cirrus;
    model.layers.push_back({.cell = cell,
                            .genus = genus,
                            .coverFraction = static_cast<float>(cover),
                            .baseMeters = base,
                            .topMeters = base + depth,
                            .opticalDepth = static_cast<float>(cloudy.opticalDepth / cloudy.area)});
    const double upright = 0.45 * depth / 1.645;  // nine tenths of a normal as of an even spread
    for (int i = 0; i < kClouds; ++i) {
      const auto place =
          field::pointIn(model.grid(), cell, (i % kColumns + 0.5) / kColumns, (i / kColumns + 0.5) / kRows);
      // Flat cards make a deep layer by standing at different heights.
      const double share = kind == BlobKind::Card ? (i * 89 % kClouds + 0.5) / kClouds : 0.5;
      const glm::vec3 center(
          frame.toScene(place.longitudeDegrees, place.latitudeDegrees, base + share * depth));
      scene.blobs.push_back(cloudAt(center, kind, sigma, upright));
      scene.clouds.push_back({{center.x, base, center.z}, genus, genus});
    }
  }
  scene.file = "made";
  scene.format = "splats";
}

Fidelity MadeSky::verified() const { return compareWithModel(scene, frame, model, nullptr, {}, {}); }

}  // namespace cloudgen::check::test
