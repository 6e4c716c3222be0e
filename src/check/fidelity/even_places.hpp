// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/vec2.hpp>

namespace cloudgen::check {

/// The place of a number, from 0 on, in the unit square: places follow each other evenly and repeat no
/// lattice of clouds (the additive recurrence of the plastic number, Roberts 2018).
inline glm::dvec2 evenPlace(int number) {
  constexpr double kPlastic = 1.32471795724474602596;
  const auto wrapped = [](double value) { return value - std::floor(value); };
  return {wrapped(0.5 + (number + 1) / kPlastic), wrapped(0.5 + (number + 1) / (kPlastic * kPlastic))};
}

}  // namespace cloudgen::check
