// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::test {

/// Stable fluids as they are written down first, on one thread: velocities in the middle of the cells, walls all
/// around that hold no air, linear steps back along the flow, Jacobi iterations for spreading and for the pressure.
class PlainFluid {
 public:
  explicit PlainFluid(const glm::ivec3& cells) : cells_(cells) {
    for (auto* field : {&u, &v, &w, &smoke, &pressure_, &divergence_, &spare_})
      field->assign(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(cells.z), 0.0f);
  }

  /// Steps and cells of length 1. `iterations` of Jacobi each time; with `share` > 0 for the pressure as many as
  /// bring its equation to that share of the divergence.
  void step(float viscosity, int iterations, float share) {
    for (auto* field : {&u, &v, &w, &smoke}) spread(*field, viscosity, iterations);
    project(iterations, share);
    const std::vector<float> windU = u, windV = v, windW = w;
    for (auto* field : {&u, &v, &w, &smoke}) carry(*field, windU, windV, windW);
    project(iterations, share);
  }

  std::vector<float> u, v, w, smoke;
  int pressureIterations = 0;  ///< of the last projection

 private:
  int at(int x, int y, int z) const {
    x = std::clamp(x, 0, cells_.x - 1), y = std::clamp(y, 0, cells_.y - 1), z = std::clamp(z, 0, cells_.z - 1);
    return (z * cells_.y + y) * cells_.x + x;
  }
  template <class Work>
  void each(const Work& work) const {
    for (int z = 0; z < cells_.z; ++z)
      for (int y = 0; y < cells_.y; ++y)
        for (int x = 0; x < cells_.x; ++x) work(x, y, z);
  }
  float around(const std::vector<float>& field, int x, int y, int z) const {
    return field[at(x - 1, y, z)] + field[at(x + 1, y, z)] + field[at(x, y - 1, z)] + field[at(x, y + 1, z)] +
           field[at(x, y, z - 1)] + field[at(x, y, z + 1)];
  }
  void spread(std::vector<float>& field, float number, int iterations) {
    const std::vector<float> before = field;
    for (int i = 0; i < iterations; ++i) {
      each([&](int x, int y, int z) {
        spare_[at(x, y, z)] = (before[at(x, y, z)] + number * around(field, x, y, z)) / (1 + 6 * number);
      });
      field.swap(spare_);
    }
  }
  void project(int iterations, float share) {
    double size = 0;
    each([&](int x, int y, int z) {
      const float d = 0.5f * (u[at(x + 1, y, z)] - u[at(x - 1, y, z)] + v[at(x, y + 1, z)] - v[at(x, y - 1, z)] +
                              w[at(x, y, z + 1)] - w[at(x, y, z - 1)]);
      divergence_[at(x, y, z)] = d, pressure_[at(x, y, z)] = 0;
      size += static_cast<double>(d) * d;
    });
    const double mean = meanOf(divergence_);
    for (float& d : divergence_) d -= static_cast<float>(mean);
    for (pressureIterations = 0; pressureIterations < 100'000; ++pressureIterations) {
      if (share > 0 ? pressureIterations % 50 == 0 && residual() <= share * share * size : pressureIterations >= iterations)
        break;
      each([&](int x, int y, int z) {
        spare_[at(x, y, z)] = (around(pressure_, x, y, z) - divergence_[at(x, y, z)]) / 6;
      });
      pressure_.swap(spare_);
    }
    each([&](int x, int y, int z) {
      u[at(x, y, z)] -= 0.5f * (pressure_[at(x + 1, y, z)] - pressure_[at(x - 1, y, z)]);
      v[at(x, y, z)] -= 0.5f * (pressure_[at(x, y + 1, z)] - pressure_[at(x, y - 1, z)]);
      w[at(x, y, z)] -= 0.5f * (pressure_[at(x, y, z + 1)] - pressure_[at(x, y, z - 1)]);
    });
  }
  double meanOf(const std::vector<float>& field) const {
    double sum = 0;
    for (const float value : field) sum += value;
    return sum / static_cast<double>(field.size());
  }
  double residual() const {
    double sum = 0;
    each([&](int x, int y, int z) {
      const double left = around(pressure_, x, y, z) - 6 * pressure_[at(x, y, z)] - divergence_[at(x, y, z)];
      sum += left * left;
    });
    return sum;
  }
  void carry(std::vector<float>& field, const std::vector<float>& windU, const std::vector<float>& windV,
             const std::vector<float>& windW) {
    each([&](int x, int y, int z) {
      const int here = at(x, y, z);
      const auto bounded = [](float place, int size) { return std::clamp(place, 0.0f, static_cast<float>(size - 1)); };
      const float px = bounded(static_cast<float>(x) - windU[here], cells_.x),
                  py = bounded(static_cast<float>(y) - windV[here], cells_.y),
                  pz = bounded(static_cast<float>(z) - windW[here], cells_.z);
      const int x0 = static_cast<int>(px), y0 = static_cast<int>(py), z0 = static_cast<int>(pz);
      const float a = px - static_cast<float>(x0), b = py - static_cast<float>(y0), c = pz - static_cast<float>(z0);
      const auto row = [&](int dy, int dz) {
        return (1 - a) * field[at(x0, y0 + dy, z0 + dz)] + a * field[at(x0 + 1, y0 + dy, z0 + dz)];
      };
      spare_[here] = (1 - c) * ((1 - b) * row(0, 0) + b * row(1, 0)) + c * ((1 - b) * row(0, 1) + b * row(1, 1));
    });
    field.swap(spare_);
  }

  glm::ivec3 cells_;
  std::vector<float> pressure_, divergence_, spare_;
};

}  // namespace cloudgen::test
