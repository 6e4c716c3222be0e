// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace cloudgen::check {

/// Where the optical depth of a column lies: a histogram over height in steps of 25 m, from 500 m below the
/// sea to 22 km.
class HeightProfile {
 public:
  HeightProfile();
  /// Spread evenly between two heights.
  void addUniform(double baseMeters, double topMeters, double opticalDepth);
  /// Spread as a Gaussian.
  void addGaussian(double meanMeters, double deviationMeters, double opticalDepth);
  /// The height below which `share` of what lies between two heights lies; nothing if nothing does.
  std::optional<double> heightAt(double share, double lowestMeters, double highestMeters) const;
  /// What lies between two heights.
  double between(double lowestMeters, double highestMeters) const;

 private:
  void add(double height, double opticalDepth);

  std::vector<double> bins_;
};

}  // namespace cloudgen::check
