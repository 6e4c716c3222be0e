// SPDX-License-Identifier: Apache-2.0
#include "motion/wind_field.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::motion {
namespace {

constexpr int kSquaresAcross = 96, kLevels = 20;
constexpr double kLevelMeters = 1000;

}  // namespace

WindField::WindField(const glm::dvec2& lower, const glm::dvec2& upper, std::span<const WindSample> samples)
    : lower_(lower), levels_(kLevels) {
  const glm::dvec2 size = upper - lower;
  const double square = std::max({size.x, size.y, 1.0}) / kSquaresAcross;
  columns_ = std::max(1, static_cast<int>(std::ceil(size.x / square)));
  rows_ = std::max(1, static_cast<int>(std::ceil(size.y / square)));
  perSquare_ = glm::dvec2(1 / square);
  const std::size_t squares = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  std::vector<std::vector<Known>> known(kLevels, std::vector<Known>(squares));
  for (const WindSample& sample : samples) {
    if (!std::isfinite(sample.wind.x) || !std::isfinite(sample.wind.y)) continue;
    const glm::dvec2 at = (sample.place - lower_) * perSquare_;
    const int column = std::clamp(static_cast<int>(at.x), 0, columns_ - 1),
              row = std::clamp(static_cast<int>(at.y), 0, rows_ - 1),
              level = std::clamp(static_cast<int>(std::lround(sample.heightMeters / kLevelMeters)), 0, kLevels - 1);
    Known& here = known[static_cast<std::size_t>(level)][static_cast<std::size_t>(row * columns_ + column)];
    here.wind += sample.wind, here.weight += 1;
  }
  std::vector<int> levelsKnown;
  for (int level = 0; level < kLevels; ++level) {
    auto& here = known[static_cast<std::size_t>(level)];
    if (std::none_of(here.begin(), here.end(), [](const Known& one) { return one.weight > 0; })) continue;
    for (Known& one : here)
      if (one.weight > 0) one = {one.wind / one.weight, 1};
    fill(here, columns_, rows_);
    levelsKnown.push_back(level);
  }
  winds_.assign(squares * kLevels, glm::vec2(0));
  if (levelsKnown.empty()) return;
  for (int level = 0; level < kLevels; ++level) {
    // Between the known levels around; beyond them as on the outermost.
    const int held = std::clamp(level, levelsKnown.front(), levelsKnown.back());
    const auto above = std::lower_bound(levelsKnown.begin(), levelsKnown.end(), held);
    const int upperLevel = *above, lowerLevel = upperLevel == held ? held : *(above - 1);
    const float share =
        upperLevel == lowerLevel ? 0.0f : static_cast<float>(held - lowerLevel) / static_cast<float>(upperLevel - lowerLevel);
    for (std::size_t i = 0; i < squares; ++i)
      winds_[static_cast<std::size_t>(level) * squares + i] =
          (1 - share) * known[static_cast<std::size_t>(lowerLevel)][i].wind +
          share * known[static_cast<std::size_t>(upperLevel)][i].wind;
  }
}

/// What is not known is the mean of the four squares that hold it one step coarser.
void WindField::fill(std::vector<Known>& level, int columns, int rows) {
  if (columns == 1 && rows == 1) return;
  const int halfColumns = (columns + 1) / 2, halfRows = (rows + 1) / 2;
  std::vector<Known> coarse(static_cast<std::size_t>(halfColumns) * static_cast<std::size_t>(halfRows));
  const auto coarseAt = [&](int column, int row) -> Known& {
    return coarse[static_cast<std::size_t>(std::clamp(row, 0, halfRows - 1) * halfColumns + std::clamp(column, 0, halfColumns - 1))];
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Known& here = level[static_cast<std::size_t>(row * columns + column)];
      Known& there = coarseAt(column / 2, row / 2);
      there.wind += here.weight * here.wind, there.weight += here.weight;
    }
  for (Known& one : coarse)
    if (one.weight > 0) one = {one.wind / one.weight, 1};
  fill(coarse, halfColumns, halfRows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      Known& here = level[static_cast<std::size_t>(row * columns + column)];
      if (here.weight > 0) continue;
      const int beside = column % 2 == 0 ? column / 2 - 1 : column / 2 + 1,
                over = row % 2 == 0 ? row / 2 - 1 : row / 2 + 1;
      here.wind = 0.5625f * coarseAt(column / 2, row / 2).wind + 0.1875f * coarseAt(beside, row / 2).wind +
                  0.1875f * coarseAt(column / 2, over).wind + 0.0625f * coarseAt(beside, over).wind;
    }
  for (Known& one : level) one.weight = 1;
}

glm::vec2 WindField::onLevel(int level, double column, double row) const {
  column = std::clamp(column, 0.0, static_cast<double>(columns_ - 1));
  row = std::clamp(row, 0.0, static_cast<double>(rows_ - 1));
  const int left = std::min(static_cast<int>(column), std::max(columns_ - 2, 0)), right = std::min(left + 1, columns_ - 1),
            top = std::min(static_cast<int>(row), std::max(rows_ - 2, 0)), bottom = std::min(top + 1, rows_ - 1);
  const auto a = static_cast<float>(column - left), b = static_cast<float>(row - top);
  const auto value = [&](int c, int r) {
    return winds_[(static_cast<std::size_t>(level) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(r)) *
                      static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(c)];
  };
  return (1 - b) * ((1 - a) * value(left, top) + a * value(right, top)) +
         b * ((1 - a) * value(left, bottom) + a * value(right, bottom));
}

glm::vec2 WindField::at(const glm::dvec2& place, double heightMeters) const {
  if (winds_.empty()) return glm::vec2(0);
  const glm::dvec2 square = (place - lower_) * perSquare_ - 0.5;
  const double height = std::clamp(heightMeters / kLevelMeters, 0.0, static_cast<double>(levels_ - 1));
  const int below = std::min(static_cast<int>(height), levels_ - 2);
  const auto share = static_cast<float>(height - below);
  return (1 - share) * onLevel(below, square.x, square.y) + share * onLevel(below + 1, square.x, square.y);
}

glm::dvec2 WindBetween::at(const glm::dvec2& place, double heightMeters, double share) const {
  return (1 - share) * glm::dvec2(before.at(place - share * way, heightMeters)) +
         share * glm::dvec2(after.at(place + (1 - share) * way, heightMeters));
}

std::vector<glm::dvec2> pathOf(const WindBetween& wind, const glm::dvec2& place, double heightMeters, int intervals,
                               bool backwards, const Stretch& stretch) {
  constexpr int kSteps = 4;
  const double span = stretch.to - stretch.from, start = backwards ? stretch.to : stretch.from;
  const double direction = backwards ? -1 : 1, step = span * wind.seconds / (intervals * kSteps);
  const auto windAt = [&](const glm::dvec2& where, double seconds) {
    const double share = wind.seconds > 0 ? start + direction * seconds / wind.seconds : start;
    return direction * wind.at(where, heightMeters, share);
  };
  std::vector<glm::dvec2> path{place};
  glm::dvec2 here = place;
  double seconds = 0;
  for (int i = 0; i < intervals; ++i) {
    for (int k = 0; k < kSteps; ++k, seconds += step) {
      const glm::dvec2 a = windAt(here, seconds), b = windAt(here + 0.5 * step * a, seconds + 0.5 * step),
                       c = windAt(here + 0.5 * step * b, seconds + 0.5 * step), d = windAt(here + step * c, seconds + step);
      here += step / 6 * (a + 2.0 * b + 2.0 * c + d);
    }
    path.push_back(here);
  }
  return path;
}

}  // namespace cloudgen::motion
