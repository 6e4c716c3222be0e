// SPDX-License-Identifier: Apache-2.0
#include "motion/diffusion.hpp"

namespace cloudgen::motion {

RowDiffusion::RowDiffusion(int places, Rim rim, float number) : places_(places), rim_(rim) {
  const auto count = static_cast<std::size_t>(places);
  if (places < 3 && rim == Rim::Periodic) rim_ = Rim::Closed, number *= 2;  // both neighbours are the same one
  std::vector<float> diagonal(count, 1 + 2 * number), upper(count, -number);
  lower_.assign(count, -number);
  if (rim_ == Rim::Closed) diagonal.front() -= number, diagonal.back() -= number;
  if (rim_ == Rim::Zero) {
    diagonal.front() = diagonal.back() = 1;
    upper.front() = lower_.back() = 0;
  }
  // The corners of a closed row as a product of two vectors: (g, 0 .. 0, -number) and (1, 0 .. 0, -number / g).
  const float g = -diagonal.front();
  if (rim_ == Rim::Periodic) {
    diagonal.front() -= g;
    diagonal.back() -= number * number / g;
    corner_ = -number / g;
  }
  over_.resize(count), inverse_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    inverse_[i] = 1 / (diagonal[i] - (i > 0 ? lower_[i] * over_[i - 1] : 0));
    over_[i] = upper[i] * inverse_[i];
  }
  if (rim_ != Rim::Periodic) return;
  correction_.assign(count, 0.0f);
  correction_.front() = g, correction_.back() = -number;
  eliminate(correction_.data(), 1);
  correctionShare_ = 1 / (1 + correction_.front() + corner_ * correction_.back());
}

void RowDiffusion::eliminate(float* rows, int lanes) const {
  for (int i = 0; i < places_; ++i) {
    float* const here = rows + i * lanes;
    const float* const before = i > 0 ? here - lanes : here;
    const float lower = i > 0 ? lower_[static_cast<std::size_t>(i)] : 0,
                inverse = inverse_[static_cast<std::size_t>(i)];
    for (int lane = 0; lane < lanes; ++lane) here[lane] = (here[lane] - lower * before[lane]) * inverse;
  }
  for (int i = places_ - 2; i >= 0; --i) {
    float* const here = rows + i * lanes;
    const float over = over_[static_cast<std::size_t>(i)];
    for (int lane = 0; lane < lanes; ++lane) here[lane] -= over * here[lane + lanes];
  }
}

void RowDiffusion::step(float* rows) const {
  eliminate(rows, kLanes);
  if (rim_ != Rim::Periodic) return;
  const float* const last = rows + (places_ - 1) * kLanes;
  float share[kLanes];
  for (int lane = 0; lane < kLanes; ++lane)
    share[lane] = (rows[lane] + corner_ * last[lane]) * correctionShare_;
  for (int i = 0; i < places_; ++i)
    for (int lane = 0; lane < kLanes; ++lane)
      rows[i * kLanes + lane] -= share[lane] * correction_[static_cast<std::size_t>(i)];
}

void diffuse(Lattice& lattice, Rim vertical, float number) {
  for (int axis = 0; axis < 3; ++axis) {
    const RowDiffusion rows(lattice.places[axis], axis == 1 ? vertical : Rim::Periodic, number);
    alongLines(lattice, axis, [&](float* values, const glm::ivec3&) { rows.step(values); });
  }
}

}  // namespace cloudgen::motion
