// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "base/thread.hpp"
#include "motion/wind_field.hpp"

namespace cloudgen::motion {
namespace {

/// Heights that tell where a storm is: where its wind is strong and its eye upright.
constexpr double kHeights[] = {1000, 3000, 6000, 10'000};

/// Winds that differ by less are one, m2/s2.
constexpr double kAlike = 1;

using Squares = std::pair<int, int>;

/// Mean square of what the winds differ by once the pattern of the earlier time is moved by so many squares.
class Misfit {
 public:
  Misfit(const WindField& before, const WindField& after)
      : columns_(before.columns()), rows_(before.rows()), before_(windsOf(before)), after_(windsOf(after)) {}

  double operator()(const Squares& moved) const {
    const auto [right, down] = moved;
    double sum = 0, count = 0;
    for (int row = std::max(0, -down); row < std::min(rows_, rows_ - down); ++row)
      for (int column = std::max(0, -right); column < std::min(columns_, columns_ - right); ++column)
        for (std::size_t k = 0; k < std::size(kHeights); ++k, count += 1) {
          const glm::vec2 apart = after_[at(column + right, row + down, k)] - before_[at(column, row, k)];
          sum += glm::dot(apart, apart);
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::max();
  }

 private:
  std::size_t at(int column, int row, std::size_t height) const {
    return static_cast<std::size_t>(row * columns_ + column) * std::size(kHeights) + height;
  }
  static std::vector<glm::vec2> windsOf(const WindField& wind) {
    std::vector<glm::vec2> winds;
    for (int row = 0; row < wind.rows(); ++row)
      for (int column = 0; column < wind.columns(); ++column)
        for (const double height : kHeights)
          winds.push_back(wind.at(wind.lower() + wind.squareMeters() * glm::dvec2(column + 0.5, row + 0.5), height));
    return winds;
  }

  int columns_, rows_;
  std::vector<glm::vec2> before_, after_;
};

/// The best of the shifts around one, so many squares apart; of equal ones the first.
Squares bestAround(const Misfit& misfit, const Squares& middle, int reach, int step) {
  std::vector<Squares> all;
  for (int down = -reach; down <= reach; down += step)
    for (int right = -reach; right <= reach; right += step) all.emplace_back(middle.first + right, middle.second + down);
  std::vector<double> misfits(all.size());
  base::parallelFor(all.size(), [&](std::size_t i) { misfits[i] = misfit(all[i]); });
  return all[static_cast<std::size_t>(std::min_element(misfits.begin(), misfits.end()) - misfits.begin())];
}

/// Where a parabola through three misfits is least, from the middle one on, in squares.
double between(double before, double here, double after) {
  const double bend = before + after - 2 * here;
  return bend > 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

}  // namespace

glm::dvec2 wayOfPattern(const WindField& before, const WindField& after) {
  if (before.columns() != after.columns() || before.rows() != after.rows()) return glm::dvec2(0);
  const Misfit misfit(before, after);
  const int reach = std::min(before.columns(), before.rows()) / 4 / 4 * 4;
  const Squares coarse = bestAround(misfit, {0, 0}, reach, 4), best = bestAround(misfit, coarse, 3, 1);
  const double here = misfit(best);
  const double unmoved = misfit({0, 0});
  if (unmoved < kAlike || here > kMovedMisfit * unmoved) return glm::dvec2(0);
  const auto [right, down] = best;
  return before.squareMeters() *
         glm::dvec2(right + between(misfit({right - 1, down}), here, misfit({right + 1, down})),
                    down + between(misfit({right, down - 1}), here, misfit({right, down + 1})));
}

}  // namespace cloudgen::motion
