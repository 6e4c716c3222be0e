// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/picture_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::writer {
namespace {

/// Cells along a side of the finest grid.
constexpr int kCells = 128, kCorners = kCells + 1;
constexpr float kFinest = 0.008f;  ///< of opacity or a colour: what is less is not seen
constexpr float kSeen = kSeenAlpha / 255.0f;

std::size_t placeOf(const glm::ivec2& corner) {
  return static_cast<std::size_t>(corner.y) * kCorners + static_cast<std::size_t>(corner.x);
}

glm::vec4 pixelOf(const image::ByteImage& image, int x, int y) {
  const std::size_t at = 4 * (static_cast<std::size_t>(std::clamp(y, 0, image.height - 1)) *
                                  static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(std::clamp(x, 0, image.width - 1)));
  const auto byte = [&](std::size_t i) { return static_cast<float>(image.bytes[at + i]) / 255.0f; };
  return {byte(0), byte(1), byte(2), byte(3)};
}

/// From the lower left one row by row.
std::vector<glm::vec4> sampled(const image::ByteImage& image) {
  std::vector<glm::vec4> samples;
  for (int row = 0; row < kCorners; ++row)
    for (int column = 0; column < kCorners; ++column) {
      const float x = static_cast<float>(image.width * column) / kCells - 0.5f,
                  y = static_cast<float>(image.height * (kCells - row)) / kCells - 0.5f;
      const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
      const auto across = [&](int line) {
        return glm::mix(pixelOf(image, left, line), pixelOf(image, left + 1, line),
                        x - static_cast<float>(left));
      };
      samples.push_back(glm::mix(across(top), across(top + 1), y - static_cast<float>(top)));
    }
  return samples;
}

/// With opacity multiplied into the colour: what of it is seen.
std::vector<glm::vec4> multiplied(const std::vector<glm::vec4>& samples) {
  std::vector<glm::vec4> out;
  for (const glm::vec4& one : samples) out.push_back({one.w * glm::vec3(one), one.w});
  return out;
}

/// A right triangle of the grid: its longest side from a to b, its right angle at c.
struct Triangle {
  glm::ivec2 a{0}, b{0}, c{0};

  glm::ivec2 middle() const { return (a + b) / 2; }
  bool canSplit() const { return std::abs(a.x - c.x) + std::abs(a.y - c.y) > 1; }
  Triangle left() const { return {c, a, middle()}; }
  Triangle right() const { return {b, c, middle()}; }
};

constexpr std::array<Triangle, 2> kHalves{
    {{{0, 0}, {kCells, kCells}, {kCells, 0}}, {{kCells, kCells}, {0, 0}, {0, kCells}}}};

/// A triangle that can be halved: places of its middle, of the ends of its longest side and of the middles of
/// its halves (its own where they cannot be halved).
struct Halving {
  std::uint32_t middle, a, b, left, right;
};

/// All of them, the small ones first.
std::vector<Halving> allHalvings() {
  std::vector<Triangle> all(kHalves.begin(), kHalves.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const Triangle one = all[i]; one.left().canSplit()) {
      all.push_back(one.left());
      all.push_back(one.right());
    }
  std::vector<Halving> halvings;
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    const auto place = [](const glm::ivec2& corner) { return static_cast<std::uint32_t>(placeOf(corner)); };
    const auto middleOf = [&](const Triangle& half) {
      return place(half.canSplit() ? half.middle() : one->middle());
    };
    halvings.push_back({place(one->middle()), place(one->a), place(one->b), middleOf(one->left()),
                        middleOf(one->right())});
  }
  return halvings;
}

/// Right triangles that are halved where their straight edges miss what is between (Evans et al. 2001,
/// Right-triangulated irregular networks): a corner that one needs misses as much as all below it on either
/// side, so that no edge meets the middle of another.
class Network {
 public:
  explicit Network(const image::ByteImage& image) : samples_(sampled(image)), misses_(samples_.size(), 0) {
    static const std::vector<Halving> kAll = allHalvings();
    const std::vector<glm::vec4> seen = multiplied(samples_);
    for (const Halving& one : kAll) {
      const glm::vec4 away = glm::abs(seen[one.middle] - 0.5f * (seen[one.a] + seen[one.b]));
      misses_[one.middle] = std::max({misses_[one.middle], away.x, away.y, away.z, away.w, misses_[one.left],
                                      misses_[one.right]});
    }
  }

  std::vector<Triangle> within(float miss) const {
    std::vector<Triangle> out;
    for (const Triangle& half : kHalves) collect(half, miss, out);
    return out;
  }
  const glm::vec4& sample(const glm::ivec2& corner) const { return samples_[placeOf(corner)]; }

 private:
  void collect(const Triangle& one, float miss, std::vector<Triangle>& out) const {
    if (one.canSplit() && misses_[placeOf(one.middle())] > miss) {
      collect(one.left(), miss, out);
      collect(one.right(), miss, out);
    } else if (std::max({alpha(one.a), alpha(one.b), alpha(one.c)}) >= kSeen) {
      out.push_back(one);
    }
  }
  float alpha(const glm::ivec2& corner) const { return sample(corner).w; }

  std::vector<glm::vec4> samples_;  ///< straight colour and opacity
  std::vector<float> misses_;  ///< of a corner in the middle of a longest side, and of all below it
};

/// As few misses as so many triangles allow.
std::vector<Triangle> fewTriangles(const Network& network, std::size_t most) {
  constexpr int kSteps = 10;
  std::vector<Triangle> best = network.within(kFinest);
  if (best.size() <= most) return best;
  float low = kFinest, high = 1;
  best = network.within(high);
  for (int i = 0; i < kSteps; ++i) {
    const float middle = std::sqrt(low * high);
    std::vector<Triangle> tried = network.within(middle);
    const bool isFew = tried.size() <= most;
    (isFew ? high : low) = middle;
    if (isFew) best = std::move(tried);
  }
  return best;
}

double coverOf(const PuffPicture& picture) {
  const glm::dvec2 sides(picture.upper - picture.lower);
  double sum = 0;
  for (std::size_t i = 3; i < picture.image.bytes.size(); i += 4) sum += picture.image.bytes[i];
  return sum / 255 * sides.x * sides.y / (picture.image.width * picture.image.height);
}

double coverOf(const PictureMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto at = [&](std::size_t i) { return mesh.indices[t + i]; };
    const glm::dvec2 one(mesh.points[at(1)] - mesh.points[at(0)]),
        other(mesh.points[at(2)] - mesh.points[at(0)]);
    const double opacity = mesh.colors[at(0)].w + mesh.colors[at(1)].w + mesh.colors[at(2)].w;
    sum += opacity / 6 * (one.x * other.y - one.y * other.x);
  }
  return sum;
}

/// Straight edges cut domes off and fill valleys: with these opacities the mesh covers as much as its
/// picture.
void keepCover(PictureMesh& mesh, double wanted) {
  constexpr int kTimes = 4;  // what is opaque already takes no more
  for (int i = 0; i < kTimes; ++i) {
    const auto share = static_cast<float>(wanted / std::max(coverOf(mesh), 1e-6));
    for (glm::vec4& color : mesh.colors) color.w = std::min(share * color.w, 1.0f);
  }
}

PictureMesh meshOf(const PuffPicture& picture, const Network& network, std::size_t mostTriangles) {
  PictureMesh mesh;
  const glm::vec2 step = (picture.upper - picture.lower) / static_cast<float>(kCells);
  std::vector<std::int64_t> places(static_cast<std::size_t>(kCorners) * kCorners, -1);
  for (const Triangle& one : fewTriangles(network, mostTriangles))
    for (const glm::ivec2& corner : {one.a, one.c, one.b}) {
      std::int64_t& place = places[placeOf(corner)];
      if (place < 0) {
        place = std::ssize(mesh.points);
        mesh.points.push_back(picture.lower + step * glm::vec2(corner));
        mesh.colors.push_back(network.sample(corner));
      }
      mesh.indices.push_back(static_cast<std::uint32_t>(place));
    }
  keepCover(mesh, coverOf(picture));
  return mesh;
}

}  // namespace

std::vector<PictureMesh> meshesOf(const PuffPicture& picture, std::span<const std::size_t> mostTriangles) {
  std::vector<PictureMesh> meshes(mostTriangles.size());
  if (picture.image.bytes.empty()) return meshes;
  const Network network(picture.image);
  for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i] = meshOf(picture, network, mostTriangles[i]);
  return meshes;
}

}  // namespace cloudgen::writer
