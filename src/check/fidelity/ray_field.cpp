// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/ray_field.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "check/fidelity/model_columns.hpp"

namespace cloudgen::check {
namespace {

constexpr double kRaysABin = 4;

int binAlong(float distance, float size, int bins) {
  return static_cast<int>(std::clamp(std::floor(distance / size), 0.0f, static_cast<float>(bins - 1)));
}

}  // namespace

RayField::RayField(std::vector<glm::vec2> places) : opticalDepths_(places.size(), 0.0) {
  bins_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(places.size()) / kRaysABin)));
  start_.assign(static_cast<std::size_t>(bins_) * static_cast<std::size_t>(bins_) + 1, 0);
  if (places.empty()) return;
  glm::vec2 upper = lower_ = places.front();
  for (const glm::vec2& place : places) lower_ = glm::min(lower_, place), upper = glm::max(upper, place);
  binSize_ = glm::max((upper - lower_) / static_cast<float>(bins_), glm::vec2(1e-6f));
  const auto binOf = [&](const glm::vec2& place) {
    return static_cast<std::size_t>(binAlong(place.y - lower_.y, binSize_.y, bins_)) *
               static_cast<std::size_t>(bins_) +
           static_cast<std::size_t>(binAlong(place.x - lower_.x, binSize_.x, bins_));
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](const glm::vec2& a, const glm::vec2& b) { return binOf(a) < binOf(b); });
  for (const glm::vec2& place : places) ++start_[binOf(place) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  places_ = std::move(places);
}

void RayField::add(const Footprint& footprint, const glm::vec2& center, float metersPerUnit) {
  const glm::vec2 half = footprint.halfSides() / metersPerUnit, low = center - half - lower_,
                  high = center + half - lower_, size = binSize_ * static_cast<float>(bins_);
  if (!(high.x >= 0 && high.y >= 0 && low.x <= size.x && low.y <= size.y)) return;
  const int left = binAlong(low.x, binSize_.x, bins_), right = binAlong(high.x, binSize_.x, bins_);
  for (int row = binAlong(low.y, binSize_.y, bins_), last = binAlong(high.y, binSize_.y, bins_); row <= last;
       ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(bins_);
    const std::uint32_t from = start_[first + static_cast<std::size_t>(left)],
                        to = start_[first + static_cast<std::size_t>(right) + 1];
    for (std::uint32_t ray = from; ray < to; ++ray)
      opticalDepths_[ray] += footprint.opticalDepthAt((places_[ray] - center) * metersPerUnit);
  }
}

double RayField::cover() const {
  if (places_.empty()) return 0;
  const auto cloudy = std::count_if(opticalDepths_.begin(), opticalDepths_.end(),
                                    [](double depth) { return depth > kCloudyOpticalDepth; });
  return static_cast<double>(cloudy) / static_cast<double>(places_.size());
}

double RayField::meanOpticalDepth() const {
  if (places_.empty()) return 0;
  return std::accumulate(opticalDepths_.begin(), opticalDepths_.end(), 0.0) /
         static_cast<double>(places_.size());
}

double RayField::opticalDepthError() const {
  const double mean = meanOpticalDepth();
  double squares = 0;
  for (const double depth : opticalDepths_) squares += (depth - mean) * (depth - mean);
  return std::sqrt(squares) / static_cast<double>(std::max<std::size_t>(1, opticalDepths_.size()));
}

}  // namespace cloudgen::check
