// SPDX-License-Identifier: Apache-2.0
#include "base/random.hpp"

#include <Random123/philox.h>

#include <cassert>
#include <cmath>
#include <numbers>

namespace cloudgen::base {

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t cell, Purpose purpose, std::uint64_t item)
    : seed_(seed), cell_(cell), purpose_(static_cast<std::uint64_t>(purpose)), item_(item) {}

std::uint64_t RandomStream::bits() {
  if (used_ == 4) {
    const auto block = r123::Philox4x64{}({{block_++, item_, cell_, purpose_}}, {{seed_, 0}});
    for (int i = 0; i < 4; ++i) values_[i] = block[i];
    used_ = 0;
  }
  return values_[used_++];
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double RandomStream::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

glm::dvec3 RandomStream::direction() {
  const double y = uniform(-1.0, 1.0);
  const double angle = 2.0 * std::numbers::pi * uniform();
  const double r = std::sqrt(1.0 - y * y);
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

int RandomStream::index(int count) {
  assert(count > 0);
  return static_cast<int>(uniform() * count);
}

}  // namespace cloudgen::base
