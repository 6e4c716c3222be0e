// SPDX-License-Identifier: Apache-2.0
#include "motion/carrying.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/thread.hpp"

namespace cloudgen::motion {
namespace {

/// Reads between the values of a lattice, closed along x and z.
class Sampler {
 public:
  explicit Sampler(const Lattice& lattice)
      : values_(lattice.values.data()),
        size_(lattice.places),
        row_(size_.x),
        plane_(static_cast<std::ptrdiff_t>(size_.x) * size_.y),
        ceiling_(static_cast<float>(size_.y - 1)) {}

  /// Linear between the eight values around a place.
  float at(float x, float y, float z) const {
    float least, most;
    return at<false>(x, y, z, least, most);
  }
  /// With the bounds of those values.
  float boundedAt(float x, float y, float z, float& least, float& most) const {
    return at<true>(x, y, z, least, most);
  }

 private:
  template <bool bounds>
  float at(float x, float y, float z, float& least, float& most) const {
    int x0, x1, z0, z1;
    const float shareX = closed(x, size_.x, x0, x1), shareZ = closed(z, size_.z, z0, z1);
    y = std::min(std::max(y, 0.0f), ceiling_);
    const int y0 = std::min(static_cast<int>(y), size_.y - 2);
    const float shareY = y - static_cast<float>(y0);
    const float* const low = values_ + z0 * plane_ + y0 * row_;
    const float* const high = values_ + z1 * plane_ + y0 * row_;
    const float a = low[x0], b = low[x1], c = low[row_ + x0], d = low[row_ + x1];
    const float e = high[x0], f = high[x1], g = high[row_ + x0], h = high[row_ + x1];
    if constexpr (bounds) {
      least = std::min(std::min(std::min(a, b), std::min(c, d)), std::min(std::min(e, f), std::min(g, h)));
      most = std::max(std::max(std::max(a, b), std::max(c, d)), std::max(std::max(e, f), std::max(g, h)));
    }
    const float ab = a + shareX * (b - a), cd = c + shareX * (d - c), ef = e + shareX * (f - e),
                gh = g + shareX * (h - g);
    const float back = ab + shareY * (cd - ab), front = ef + shareY * (gh - ef);
    return back + shareZ * (front - back);
  }
  /// The places before and after on a row that closes on itself; returns how far between them.
  static float closed(float place, int size, int& before, int& after) {
    const auto length = static_cast<float>(size);
    if (place < 0 || place >= length) place -= std::floor(place / length) * length;
    before = static_cast<int>(place);
    const float share = place - static_cast<float>(before);
    if (before >= size) before = 0;
    after = before + 1 == size ? 0 : before + 1;
    return share;
  }

  const float* values_;
  glm::ivec3 size_;
  std::ptrdiff_t row_, plane_;
  float ceiling_;
};

/// How far the flow goes in a step at the values of a row, in cells.
struct RowOfWays {
  std::vector<float> x, y, z;
  explicit RowOfWays(int count)
      : x(static_cast<std::size_t>(count)), y(static_cast<std::size_t>(count)), z(static_cast<std::size_t>(count)) {}
};

/// The flow at the values of a lattice: means of the faces around them.
class Ways {
 public:
  Ways(const Flow& flow, Stand stand) : faces_(flow.faces), steps_(flow.stepsPerVelocity), stand_(stand), size_(faces_[0].places) {}

  void fill(int y, int z, RowOfWays& row) const {
    const int back = z == 0 ? size_.z - 1 : z - 1, front = z + 1 == size_.z ? 0 : z + 1;
    const int below = std::max(y - 1, 0), here = std::min(y, size_.y - 1);
    const Lattice &u = faces_[0], &v = faces_[1], &w = faces_[2];
    const auto rowOf = [](const Lattice& lattice, int level, int plane) {
      return lattice.values.data() + lattice.index(0, level, plane);
    };
    switch (stand_) {
      case Stand::FaceX:
        alone(row.x, rowOf(u, y, z));
        withLeft(row.y, rowOf(v, y, z), rowOf(v, y + 1, z));
        withLeft(row.z, rowOf(w, y, z), rowOf(w, y, front));
        break;
      case Stand::FaceY:
        withRight(row.x, rowOf(u, below, z), rowOf(u, here, z));
        alone(row.y, rowOf(v, y, z));
        meanOf(row.z, {rowOf(w, below, z), rowOf(w, below, front), rowOf(w, here, z), rowOf(w, here, front)});
        break;
      case Stand::FaceZ:
        withRight(row.x, rowOf(u, y, back), rowOf(u, y, z));
        meanOf(row.y, {rowOf(v, y, back), rowOf(v, y + 1, back), rowOf(v, y, z), rowOf(v, y + 1, z)});
        alone(row.z, rowOf(w, y, z));
        break;
      case Stand::Middle:
        withRight(row.x, rowOf(u, y, z), rowOf(u, y, z));
        meanOf(row.y, {rowOf(v, y, z), rowOf(v, y + 1, z), rowOf(v, y, z), rowOf(v, y + 1, z)});
        meanOf(row.z, {rowOf(w, y, z), rowOf(w, y, front), rowOf(w, y, z), rowOf(w, y, front)});
        break;
    }
  }

 private:
  void alone(std::vector<float>& out, const float* a) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = steps_ * a[i];
  }
  void meanOf(std::vector<float>& out, const std::array<const float*, 4>& rows) const {
    const float quarter = 0.25f * steps_;
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = quarter * ((rows[0][i] + rows[1][i]) + (rows[2][i] + rows[3][i]));
  }
  void withLeft(std::vector<float>& out, const float* a, const float* b) const {
    const float quarter = 0.25f * steps_;
    const std::size_t last = out.size() - 1;
    out[0] = quarter * ((a[last] + a[0]) + (b[last] + b[0]));
    for (std::size_t i = 1; i <= last; ++i) out[i] = quarter * ((a[i - 1] + a[i]) + (b[i - 1] + b[i]));
  }
  void withRight(std::vector<float>& out, const float* a, const float* b) const {
    const float quarter = 0.25f * steps_;
    const std::size_t last = out.size() - 1;
    for (std::size_t i = 0; i < last; ++i) out[i] = quarter * ((a[i] + a[i + 1]) + (b[i] + b[i + 1]));
    out[last] = quarter * ((a[last] + a[0]) + (b[last] + b[0]));
  }

  const Lattice* faces_;
  float steps_;
  Stand stand_;
  glm::ivec3 size_;
};

/// Calls work(y, z, ways) for each row of a lattice.
template <class Work>
void forEachRow(const glm::ivec3& size, const Ways& ways, const Work& work) {
  base::parallelFor(static_cast<std::size_t>(size.z), [&](std::size_t plane) {
    RowOfWays row(size.x);
    for (int y = 0; y < size.y; ++y) {
      ways.fill(y, static_cast<int>(plane), row);
      work(y, static_cast<int>(plane), row);
    }
  });
}

}  // namespace

Lattice carried(const Lattice& lattice, Stand stand, const Flow& flow) {
  const Ways ways(flow, stand);
  const Sampler before(lattice);
  const glm::ivec3& size = lattice.places;
  Lattice arrived(size), least(size), most(size), out(size);
  forEachRow(size, ways, [&](int y, int z, const RowOfWays& way) {
    const std::size_t row = lattice.index(0, y, z);
    for (std::size_t x = 0; x < way.x.size(); ++x)
      arrived.values[row + x] =
          before.boundedAt(static_cast<float>(x) - way.x[x], static_cast<float>(y) - way.y[x],
                           static_cast<float>(z) - way.z[x], least.values[row + x], most.values[row + x]);
  });
  const Sampler after(arrived);
  forEachRow(size, ways, [&](int y, int z, const RowOfWays& way) {
    const std::size_t row = lattice.index(0, y, z);
    for (std::size_t x = 0; x < way.x.size(); ++x) {
      const float returned = after.at(static_cast<float>(x) + way.x[x], static_cast<float>(y) + way.y[x],
                                      static_cast<float>(z) + way.z[x]);
      const float corrected = arrived.values[row + x] + 0.5f * (lattice.values[row + x] - returned);
      out.values[row + x] = std::min(std::max(corrected, least.values[row + x]), most.values[row + x]);
    }
  });
  return out;
}

float valueAt(const Lattice& lattice, float x, float y, float z) { return Sampler(lattice).at(x, y, z); }

}  // namespace cloudgen::motion
