// SPDX-License-Identifier: Apache-2.0
#include "motion/fluid.hpp"

#include <cassert>
#include <cmath>

#include "base/thread.hpp"
#include "motion/carrying.hpp"
#include "motion/diffusion.hpp"

namespace cloudgen::motion {
namespace {

template <class Work>
void forEachRow(const glm::ivec3& size, const Work& work) {
  base::parallelFor(static_cast<std::size_t>(size.z), [&](std::size_t plane) {
    for (int y = 0; y < size.y; ++y) work(y, static_cast<int>(plane));
  });
}

/// The sums of planes, then their sum: the same for any number of threads.
double sumOf(const Lattice& lattice) {
  std::vector<double> planes(static_cast<std::size_t>(lattice.places.z));
  const std::size_t size = lattice.values.size() / planes.size();
  base::parallelFor(planes.size(), [&](std::size_t plane) {
    for (std::size_t i = plane * size; i < (plane + 1) * size; ++i) planes[plane] += lattice.values[i];
  });
  double sum = 0;
  for (const double plane : planes) sum += plane;
  return sum;
}

double meanOfLevel(const Lattice& lattice, int y) {
  double sum = 0;
  for (int z = 0; z < lattice.places.z; ++z)
    for (int x = 0; x < lattice.places.x; ++x) sum += lattice.at(x, y, z);
  return sum / (static_cast<double>(lattice.places.x) * lattice.places.z);
}

void addToLevel(Lattice& lattice, int y, float value) {
  for (int z = 0; z < lattice.places.z; ++z)
    for (int x = 0; x < lattice.places.x; ++x) lattice.at(x, y, z) += value;
}

}  // namespace

Fluid::Fluid(const glm::ivec3& cells, float cellMeters)
    : cells_(cells),
      cellMeters_(cellMeters),
      velocity_{Lattice(cells), Lattice(cells + glm::ivec3(0, 1, 0)), Lattice(cells)},
      buoyancy_(cells),
      smoke_(cells),
      poisson_(cells),
      pressure_(cells) {
  assert(cells.x >= 2 && cells.y >= 2 && cells.z >= 2 && cellMeters > 0);
}

void Fluid::step(float seconds, const Forcing& forcing) {
  carryVelocity(velocity_, 0.5f * seconds);
  force(seconds, forcing);
  if (forcing.viscosity > 0) spread(seconds, forcing.viscosity);
  const std::array<Lattice, 3> before = velocity_;
  project();
  const std::array<Lattice, 3> middle = velocity_;
  reflect(before);
  carryVelocity(middle, 0.5f * seconds);
  carryContents(middle, seconds);
  project();
}

void Fluid::carryVelocity(const std::array<Lattice, 3>& wind, float seconds) {
  const Flow flow{wind.data(), seconds / cellMeters_};
  Lattice u = carried(velocity_[0], Stand::FaceX, flow), v = carried(velocity_[1], Stand::FaceY, flow),
          w = carried(velocity_[2], Stand::FaceZ, flow);
  velocity_ = {std::move(u), std::move(v), std::move(w)};
}

void Fluid::reflect(const std::array<Lattice, 3>& before) {
  for (const std::size_t axis : {0, 1, 2}) {
    std::vector<float>& velocity = velocity_[axis].values;
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = 2 * velocity[i] - before[axis].values[i];
  }
}

void Fluid::carryContents(const std::array<Lattice, 3>& wind, float seconds) {
  const Flow flow{wind.data(), seconds / cellMeters_};
  buoyancy_ = carried(buoyancy_, Stand::Middle, flow);
  const double smokeBefore = sumOf(smoke_);
  if (!(smokeBefore > 0)) return;
  smoke_ = carried(smoke_, Stand::Middle, flow);
  // Going back along the flow gains and loses a little: what is lost is given back in proportion.
  const double smokeAfter = sumOf(smoke_);
  if (!(smokeAfter > 0)) return;
  const auto share = static_cast<float>(smokeBefore / smokeAfter);
  for (float& value : smoke_.values) value *= share;
}

void Fluid::force(float seconds, const Forcing& forcing) {
  if (!forcing.wind.empty()) {
    assert(static_cast<int>(forcing.wind.size()) == cells_.y);
    const float share = 1 - std::exp(-seconds / forcing.windSeconds);
    base::parallelFor(forcing.wind.size(), [&](std::size_t level) {
      const int y = static_cast<int>(level);
      for (const std::size_t axis : {0, 2}) {
        const float wanted = axis == 0 ? forcing.wind[level].x : forcing.wind[level].y;
        Lattice& velocity = velocity_[axis];
        addToLevel(velocity, y, share * (wanted - static_cast<float>(meanOfLevel(velocity, y))));
      }
    });
  }
  if (!forcing.heating.empty()) {
    assert(forcing.heating.size() == buoyancy_.values.size());
    for (std::size_t i = 0; i < forcing.heating.size(); ++i) buoyancy_.values[i] += seconds * forcing.heating[i];
  }
  // Rising air gives its buoyancy to the stable air around it, both at the end of the step (implicit Euler), or
  // long steps would swing up.
  Lattice& rise = velocity_[1];
  const float answer = 1 / (1 + seconds * seconds * forcing.stability);
  forEachRow({cells_.x, cells_.y - 1, cells_.z}, [&](int row, int z) {
    const std::size_t here = rise.index(0, row + 1, z), above = buoyancy_.index(0, row + 1, z),
                      below = buoyancy_.index(0, row, z);
    for (std::size_t x = 0; x < static_cast<std::size_t>(cells_.x); ++x)
      rise.values[here + x] = answer * (rise.values[here + x] +
                                        0.5f * seconds * (buoyancy_.values[above + x] + buoyancy_.values[below + x]));
  });
  const float loss = 0.5f * seconds * forcing.stability;
  if (loss > 0)
    forEachRow(cells_, [&](int y, int z) {
      const std::size_t here = buoyancy_.index(0, y, z), floor = rise.index(0, y, z), lid = rise.index(0, y + 1, z);
      for (std::size_t x = 0; x < static_cast<std::size_t>(cells_.x); ++x)
        buoyancy_.values[here + x] -= loss * (rise.values[floor + x] + rise.values[lid + x]);
    });
}

void Fluid::spread(float seconds, float viscosity) {
  const float number = viscosity * seconds / (cellMeters_ * cellMeters_);
  for (const std::size_t axis : {0, 1, 2}) diffuse(velocity_[axis], axis == 1 ? Rim::Zero : Rim::Closed, number);
  diffuse(buoyancy_, Rim::Closed, number);
  diffuse(smoke_, Rim::Closed, number);
}

void Fluid::project() {
  Lattice &u = velocity_[0], &v = velocity_[1], &w = velocity_[2];
  forEachRow(cells_, [&](int y, int z) {
    const int front = z + 1 == cells_.z ? 0 : z + 1;
    const std::size_t here = u.index(0, y, z), floor = v.index(0, y, z), lid = v.index(0, y + 1, z),
                      ahead = w.index(0, y, front), last = static_cast<std::size_t>(cells_.x) - 1;
    float* const out = &pressure_.values[here];
    for (std::size_t x = 0; x <= last; ++x)
      out[x] = v.values[lid + x] - v.values[floor + x] + w.values[ahead + x] - w.values[here + x] - u.values[here + x];
    for (std::size_t x = 0; x < last; ++x) out[x] += u.values[here + x + 1];
    out[last] += u.values[here];
  });
  poisson_.solve(pressure_);
  forEachRow(cells_, [&](int y, int z) {
    const int back = z == 0 ? cells_.z - 1 : z - 1;
    const std::size_t here = u.index(0, y, z), floor = v.index(0, y, z), behind = u.index(0, y, back),
                      count = static_cast<std::size_t>(cells_.x);
    const float* const pressure = pressure_.values.data();
    u.values[here] -= pressure[here] - pressure[here + count - 1];
    for (std::size_t x = 1; x < count; ++x) u.values[here + x] -= pressure[here + x] - pressure[here + x - 1];
    for (std::size_t x = 0; x < count; ++x) w.values[here + x] -= pressure[here + x] - pressure[behind + x];
    if (y == 0) return;
    for (std::size_t x = 0; x < count; ++x) v.values[floor + x] -= pressure[here + x] - pressure[here + x - count];
  });
}

glm::vec3 Fluid::velocityAt(const glm::vec3& place) const {
  const glm::vec3 at = place / cellMeters_;
  return {valueAt(velocity_[0], at.x, at.y - 0.5f, at.z - 0.5f),
          valueAt(velocity_[1], at.x - 0.5f, at.y, at.z - 0.5f),
          valueAt(velocity_[2], at.x - 0.5f, at.y - 0.5f, at.z)};
}

float Fluid::divergence(int x, int y, int z) const {
  const int right = x + 1 == cells_.x ? 0 : x + 1, front = z + 1 == cells_.z ? 0 : z + 1;
  return (velocity_[0].at(right, y, z) - velocity_[0].at(x, y, z) + velocity_[1].at(x, y + 1, z) -
          velocity_[1].at(x, y, z) + velocity_[2].at(x, y, front) - velocity_[2].at(x, y, z)) /
         cellMeters_;
}

}  // namespace cloudgen::motion
