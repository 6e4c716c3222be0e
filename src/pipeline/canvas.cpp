// SPDX-License-Identifier: Apache-2.0
#include "pipeline/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::pipeline {
namespace {

constexpr int kFewestPixels = 4, kMostPixels = 512;

int pixelsAlong(double meters, double pixelMeters) {
  return static_cast<int>(std::clamp<double>(std::ceil(meters / pixelMeters), kFewestPixels, kMostPixels));
}

int around(int i, int count) { return (i % count + count) % count; }

/// The pixel that lies in for one beyond a mirror.
int folded(int i, int count) {
  const int period = 2 * count, within = (i % period + period) % period;
  return within < count ? within : period - 1 - within;
}

}  // namespace

Canvas::Canvas(const glm::dvec2& sizeMeters, double pixelMeters, bool mirrors)
    : size_(sizeMeters),
      mirrors_(mirrors),
      columns_(pixelsAlong(sizeMeters.x, pixelMeters)),
      rows_(pixelsAlong(sizeMeters.y, pixelMeters)),
      values_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0f) {
  pixel_ = {size_.x / columns_, size_.y / rows_};
}

int Canvas::rowOf(int row) const { return mirrors_ ? folded(row, rows_) : around(row, rows_); }

void Canvas::add(const PaintedCloud& cloud, double opticalDepth) {
  const double reach = cloud.footprint->reach() * cloud.widthMeters;
  const double right = std::cos(cloud.turnRadians) / cloud.widthMeters,
               up = std::sin(cloud.turnRadians) / cloud.widthMeters;
  const auto first = [&](double place, double pixel) {
    return static_cast<int>(std::floor((place - reach) / pixel));
  };
  const auto last = [&](double place, double pixel) {
    return static_cast<int>(std::floor((place + reach) / pixel));
  };
  const int firstColumn = first(cloud.place.x, pixel_.x), lastColumn = last(cloud.place.x, pixel_.x);
  for (int row = first(cloud.place.y, pixel_.y); row <= last(cloud.place.y, pixel_.y); ++row) {
    float* const line =
        values_.data() + static_cast<std::size_t>(rowOf(row)) * static_cast<std::size_t>(columns_);
    const double away = (row + 0.5) * pixel_.y - cloud.place.y;
    const double south = cloud.mirrored ? -away : away;
    int column = around(firstColumn, columns_);
    for (int i = firstColumn; i <= lastColumn; ++i) {
      const double east = (i + 0.5) * pixel_.x - cloud.place.x;
      line[column] += static_cast<float>(opticalDepth) *
                      cloud.footprint->at(right * east - up * south, up * east + right * south);
      if (++column == columns_) column = 0;
    }
  }
}

double Canvas::cover(double opticalDepth) const {
  const auto threshold = static_cast<float>(opticalDepth);
  std::size_t covered = 0;
  for (const float value : values_) covered += value > threshold ? 1 : 0;
  return static_cast<double>(covered) / static_cast<double>(values_.size());
}

float Canvas::at(const glm::dvec2& place) const {
  const int column = around(static_cast<int>(std::floor(place.x / pixel_.x)), columns_),
            row = rowOf(static_cast<int>(std::floor(place.y / pixel_.y)));
  return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)];
}

}  // namespace cloudgen::pipeline
