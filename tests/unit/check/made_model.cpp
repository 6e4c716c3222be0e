// SPDX-License-Identifier: Apache-2.0
#include "made_model.hpp"

#include <cmath>
#include <numbers>

namespace cloudgen::check::test {

double cloudyRadius() { return std::sqrt(2 * std::log(kPeak / kCloudyOpticalDepth)); }

MadeSky::MadeSky() : frame(model.box()) {
  constexpr int kColumns = 12, kRows = 19;  // about square
  for (std::uint32_t cell = 0; cell < model.grid().size(); ++cell) {
    const bool dense = (model.grid().column(cell) + model.grid().row(cell)) % 2 == 0;
    const double cover = dense ? 0.5 : 0.2;
    const double area = field::cellAreaSquareMeters(model.grid(), cell);
    const double sigma = std::sqrt(cover * area / (kColumns * kRows * std::numbers::pi)) / cloudyRadius();
    // 2 pi sigma^2 times the peak, over what is cloudy.
    const double meanDepth = 2 * kPeak / (cloudyRadius() * cloudyRadius());
    const float base = dense ? 1000 : 7000, depth = dense ? 800 : 500;
    const base::Genus genus = dense ? base::Genus::Cumulus : base::Genus::Cirrus;
    model.layers.push_back({.cell = cell,
                            .genus = genus,
                            .coverFraction = static_cast<float>(cover),
                            .baseMeters = base,
                            .topMeters = base + depth,
                            .opticalDepth = static_cast<float>(meanDepth)});
    const double upright = 0.45 * depth / 1.645;  // nine tenths of a normal as of an even spread
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const auto place = field::pointIn(model.grid(), cell, (column + 0.5) / kColumns, (row + 0.5) / kRows);
        const glm::vec3 center(
            frame.toScene(place.longitudeDegrees, place.latitudeDegrees, base + 0.5 * depth));
        glm::mat3 axes(0);
        axes[0][0] = axes[2][2] = static_cast<float>(sigma);
        axes[1][1] = static_cast<float>(upright);
        const double shortest = std::min(sigma, upright);
        scene.blobs.push_back(volumeBlob(center, axes, static_cast<float>(kPeak * shortest / upright)));
        scene.clouds.push_back({{center.x, base, center.z}, genus, genus});
      }
  }
  scene.file = "made";
  scene.format = "splats";
}

Fidelity MadeSky::verified() const { return compareWithModel(scene, frame, model, nullptr, {}, {}); }

}  // namespace cloudgen::check::test
