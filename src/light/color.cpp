// SPDX-License-Identifier: Apache-2.0
#include "light/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cloudgen::light {
namespace {

constexpr int kSteps = 4096;

/// A smooth function of 0..1 as straight pieces, within some 1e-7 of it.
class Curve {
 public:
  template <class Function>
  explicit Curve(Function function) {
    for (int i = 0; i <= kSteps; ++i)
      values_[static_cast<std::size_t>(i)] = static_cast<float>(function(static_cast<double>(i) / kSteps));
    values_.back() = values_[kSteps];
  }
  float operator()(float at) const {
    const float place = at * kSteps;
    const auto step = static_cast<std::size_t>(place);
    const float share = place - static_cast<float>(step);
    return values_[step] + share * (values_[step + 1] - values_[step]);
  }

 private:
  std::array<float, kSteps + 2> values_{};
};

double encode(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
double decode(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

/// 0 of what is no number.
float unit(float value) { return std::min(1.0f, std::max(0.0f, value)); }

}  // namespace

glm::vec3 srgbFromLinear(glm::vec3 linear) {
  // By the square root, in which the curve is nearly straight.
  static const Curve kCurve([](double root) { return encode(root * root); });
  for (int c = 0; c < 3; ++c) linear[c] = kCurve(std::sqrt(unit(linear[c])));
  return linear;
}

glm::vec3 linearFromSrgb(glm::vec3 encoded) {
  static const Curve kCurve(decode);
  for (int c = 0; c < 3; ++c) encoded[c] = kCurve(unit(encoded[c]));
  return encoded;
}

}  // namespace cloudgen::light
