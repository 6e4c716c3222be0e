// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/picture_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <queue>
#include <span>
#include <tuple>

#include "writer/pictures/grid_triangles.hpp"

namespace cloudgen::writer {
namespace {

/// Cells along a side of the finest grid.
constexpr int kCells = 128, kCorners = kCells + 1;
constexpr float kFinest = 0.008f;  ///< of opacity or a colour: what is less is not seen
constexpr float kSeen = kSeenAlpha / 255.0f;

std::size_t placeOf(const glm::ivec2& corner) {
  return static_cast<std::size_t>(corner.y) * kCorners + static_cast<std::size_t>(corner.x);
}

/// What a corner of the grid shows.
struct Sample {
  glm::vec4 straight{0};    ///< its colour and opacity
  glm::vec4 multiplied{0};  ///< the same with opacity multiplied into the colour
};

glm::vec4 pixelOf(const image::ByteImage& image, int x, int y) {
  const std::size_t at = 4 * (static_cast<std::size_t>(std::clamp(y, 0, image.height - 1)) *
                                  static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(std::clamp(x, 0, image.width - 1)));
  const auto byte = [&](std::size_t i) { return static_cast<float>(image.bytes[at + i]) / 255.0f; };
  return {byte(0), byte(1), byte(2), byte(3)};
}

/// From the lower left one row by row.
std::vector<Sample> sampled(const image::ByteImage& image) {
  std::vector<Sample> samples;
  for (int row = 0; row < kCorners; ++row)
    for (int column = 0; column < kCorners; ++column) {
      const float x = static_cast<float>(image.width * column) / kCells - 0.5f,
                  y = static_cast<float>(image.height * (kCells - row)) / kCells - 0.5f;
      const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
      const auto across = [&](int line) {
        return glm::mix(pixelOf(image, left, line), pixelOf(image, left + 1, line),
                        x - static_cast<float>(left));
      };
      const glm::vec4 value = glm::mix(across(top), across(top + 1), y - static_cast<float>(top));
      samples.push_back({value, {value.w * glm::vec3(value), value.w}});
    }
  return samples;
}

using Triangle = GridTriangles::Triangle;

/// What a triangle shows otherwise than the picture.
struct Miss {
  float sum = 0;          ///< of squares
  float most = 0;         ///< at its worst corner of the grid
  glm::ivec2 worst{0};
};

/// Calls with every corner of the grid in a triangle and its shares of the three corners.
template <typename Use>
void forEachWithin(const Triangle& triangle, const Use& use) {
  const auto& [a, b, c] = triangle.corners;
  const glm::ivec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  const float whole = 1.0f / static_cast<float>(doubleArea(a, b, c));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const glm::ivec2 at(x, y);
      const int ofA = doubleArea(b, c, at), ofB = doubleArea(c, a, at), ofC = doubleArea(a, b, at);
      if (ofA < 0 || ofB < 0 || ofC < 0) continue;
      use(at, whole * glm::vec3(ofA, ofB, ofC));
    }
}

/// Triangles with corners where the picture is missed most, one after another (Garland and Heckbert 1995, Fast
/// polygonal approximation of terrains), the triangle first that misses most on the whole.
class Network {
 public:
  explicit Network(const image::ByteImage& image) : samples_(sampled(image)), triangles_(kCells) { judgeFrom(0); }

  /// At most so many that are seen. Asked for more and more it goes on from what it has.
  std::vector<Triangle> atMost(std::size_t most) {
    std::vector<Triangle> best = seenOnes();
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (!triangles_.all()[static_cast<std::size_t>(next.triangle)].isThere) continue;
      const std::size_t before = triangles_.all().size();
      for (const std::int32_t gone : triangles_.insert(next.worst, next.triangle))
        seen_ -= isSeen(triangles_.all()[static_cast<std::size_t>(gone)]) ? 1 : 0;
      judgeFrom(before);
      if (seen_ > most + kSlack) break;
      if (seen_ + kSlack > most && seen_ <= most) best = seenOnes();
    }
    return seen_ <= most ? seenOnes() : best;
  }
  const Sample& sample(const glm::ivec2& corner) const { return samples_[placeOf(corner)]; }

 private:
  static constexpr std::size_t kSlack = 8;  ///< that one more corner adds, about
  struct Candidate {
    float sum;
    std::int32_t triangle;
    glm::ivec2 worst;
    bool operator<(const Candidate& other) const {
      return std::tie(sum, other.triangle) < std::tie(other.sum, triangle);
    }
  };

  bool isSeen(const Triangle& one) const {
    return std::ranges::any_of(one.corners, [&](const glm::ivec2& corner) { return sample(corner).straight.w >= kSeen; });
  }
  std::vector<Triangle> seenOnes() const {
    std::vector<Triangle> seen;
    for (const Triangle& one : triangles_.all())
      if (one.isThere && isSeen(one)) seen.push_back(one);
    return seen;
  }
  void judgeFrom(std::size_t first) {
    for (std::size_t i = first; i < triangles_.all().size(); ++i) {
      const Triangle& one = triangles_.all()[i];
      seen_ += isSeen(one) ? 1 : 0;
      const Miss miss = missOf(one);
      if (miss.most > kFinest) queue_.push({miss.sum, static_cast<std::int32_t>(i), miss.worst});
    }
  }
  Miss missOf(const Triangle& one) const {
    Miss miss;
    const auto shown = [&](std::size_t i) { return sample(one.corners[i]).multiplied; };
    const glm::vec4 a = shown(0), b = shown(1), c = shown(2);
    forEachWithin(one, [&](const glm::ivec2& at, const glm::vec3& shares) {
      const glm::vec4 away = shares.x * a + shares.y * b + shares.z * c - sample(at).multiplied;
      const float square = glm::dot(away, away);
      miss.sum += square;
      if (square > miss.most * miss.most) miss.most = std::sqrt(square), miss.worst = at;
    });
    return miss;
  }

  std::vector<Sample> samples_;
  GridTriangles triangles_;
  std::priority_queue<Candidate> queue_;
  std::size_t seen_ = 0;
};

/// Values at the corners of triangles that, straight from one to the next, miss least what is given within (least
/// squares with weights; conjugate gradients).
class Fit {
 public:
  /// `values` by corner are where it begins; it stays near them where little weighs.
  Fit(std::span<const std::uint32_t> indices, std::span<const Triangle> triangles, std::vector<glm::vec3> values)
      : indices_(indices), values_(std::move(values)), local_(triangles.size()), right_(values_.size(), glm::vec3(0)) {
    for (const glm::vec3& value : values_) right_[static_cast<std::size_t>(&value - values_.data())] = kStay * value;
  }

  void add(std::size_t triangle, const glm::vec3& shares, float weight, const glm::vec3& wanted) {
    for (int i = 0; i < 3; ++i) right_[corner(triangle, i)] += weight * shares[i] * wanted;
    local_[triangle] += weight * glm::outerProduct(shares, shares);
  }

  std::vector<glm::vec3> solved() {
    constexpr int kTimes = 20;
    std::vector<glm::vec3> residual = right_, direction;
    const std::vector<glm::vec3> start = product(values_);
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= start[i];
    direction = residual;
    glm::vec3 square = squareOf(residual);
    for (int time = 0; time < kTimes; ++time) {
      const std::vector<glm::vec3> along = product(direction);
      glm::vec3 curvature(0);
      for (std::size_t i = 0; i < along.size(); ++i) curvature += direction[i] * along[i];
      const glm::vec3 step = square / glm::max(curvature, 1e-20f);
      for (std::size_t i = 0; i < along.size(); ++i) values_[i] += step * direction[i], residual[i] -= step * along[i];
      const glm::vec3 next = squareOf(residual), share = next / glm::max(square, 1e-20f);
      for (std::size_t i = 0; i < along.size(); ++i) direction[i] = residual[i] + share * direction[i];
      square = next;
    }
    return values_;
  }

 private:
  static constexpr float kStay = 0.05f;
  std::size_t corner(std::size_t triangle, int i) const { return indices_[3 * triangle + static_cast<std::size_t>(i)]; }
  static glm::vec3 squareOf(const std::vector<glm::vec3>& values) {
    glm::vec3 sum(0);
    for (const glm::vec3& value : values) sum += value * value;
    return sum;
  }
  std::vector<glm::vec3> product(const std::vector<glm::vec3>& of) const {
    std::vector<glm::vec3> out;
    for (const glm::vec3& value : of) out.push_back(kStay * value);
    for (std::size_t t = 0; t < local_.size(); ++t)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[corner(t, i)] += local_[t][i][j] * of[corner(t, j)];
    return out;
  }

  std::span<const std::uint32_t> indices_;
  std::vector<glm::vec3> values_;
  std::vector<glm::mat3> local_;
  std::vector<glm::vec3> right_;
};

/// Opacities and colours that miss the picture least between the corners, too. What is opaque stays so.
void fit(PictureMesh& mesh, const std::vector<Triangle>& triangles, const Network& network) {
  constexpr float kSolid = 0.97f;
  std::vector<glm::vec3> colors, opacities;
  for (const glm::vec4& color : mesh.colors) colors.emplace_back(color), opacities.emplace_back(color.w);
  Fit color(mesh.indices, triangles, std::move(colors)), opacity(mesh.indices, triangles, std::move(opacities));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    forEachWithin(triangles[t], [&](const glm::ivec2& at, const glm::vec3& shares) {
      const glm::vec4 seen = network.sample(at).straight;
      color.add(t, shares, seen.w * seen.w, glm::vec3(seen));
      opacity.add(t, shares, 1, glm::vec3(seen.w));
    });
  colors = color.solved(), opacities = opacity.solved();
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    const float before = mesh.colors[i].w;
    mesh.colors[i] = glm::clamp(glm::vec4(colors[i], before > kSolid ? before : opacities[i].x), 0.0f, 1.0f);
  }
}

/// Colours times opacity, and opacity, times the area that they are on.
glm::dvec4 shownBy(const PuffPicture& picture) {
  const glm::dvec2 sides(picture.upper - picture.lower);
  glm::dvec4 sum(0);
  for (int y = 0; y < picture.image.height; ++y)
    for (int x = 0; x < picture.image.width; ++x) {
      const glm::dvec4 pixel(pixelOf(picture.image, x, y));
      sum += pixel.w * glm::dvec4(glm::dvec3(pixel), 1);
    }
  return sum * (sides.x * sides.y / (picture.image.width * picture.image.height));
}

glm::dvec4 shownBy(const PictureMesh& mesh) {
  glm::dvec4 sum(0);
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto at = [&](std::size_t i) { return mesh.indices[t + i]; };
    const glm::dvec2 one(mesh.points[at(1)] - mesh.points[at(0)]), other(mesh.points[at(2)] - mesh.points[at(0)]);
    // The integral of a product of two that go straight from corner to corner.
    glm::dvec3 colors(0), products(0);
    double opacities = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec4 color(mesh.colors[at(i)]);
      colors += glm::dvec3(color), products += color.w * glm::dvec3(color), opacities += color.w;
    }
    sum += 0.5 * (one.x * other.y - one.y * other.x) * glm::dvec4((opacities * colors + products) / 12.0, opacities / 3);
  }
  return sum;
}

/// Straight edges cut domes off and fill valleys: with these opacities and colours the mesh covers as much as its
/// picture and is as bright.
void keepShown(PictureMesh& mesh, const glm::dvec4& wanted) {
  constexpr int kTimes = 4;  // what is opaque already takes no more
  for (int i = 0; i < kTimes; ++i) {
    const auto share = static_cast<float>(wanted.w / std::max(shownBy(mesh).w, 1e-6));
    for (glm::vec4& color : mesh.colors) color.w = std::min(share * color.w, 1.0f);
    const glm::vec4 shares(glm::vec3(wanted / glm::max(shownBy(mesh), 1e-6)), 1);
    for (glm::vec4& color : mesh.colors) color = glm::min(shares * color, 1.0f);
  }
}

float missOf(const PictureMesh& mesh, const std::vector<Triangle>& triangles, const Network& network,
             const glm::vec2& sides) {
  const auto shownAt = [&](std::size_t corner) {
    const glm::vec4& color = mesh.colors[mesh.indices[corner]];
    return glm::vec4(color.w * glm::vec3(color), color.w);
  };
  double missed = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array shown{shownAt(3 * t), shownAt(3 * t + 1), shownAt(3 * t + 2)};
    forEachWithin(triangles[t], [&](const glm::ivec2& at, const glm::vec3& shares) {
      const glm::vec4 away = shares.x * shown[0] + shares.y * shown[1] + shares.z * shown[2] - network.sample(at).multiplied;
      missed += 0.5f * glm::length(away);
    });
  }
  const float cell = sides.x * sides.y / (kCells * kCells);
  return cell * static_cast<float>(missed) / (2 * (sides.x + sides.y));
}

PictureMesh meshOf(const PuffPicture& picture, Network& network, const glm::dvec4& shown, std::size_t mostTriangles) {
  PictureMesh mesh;
  const glm::vec2 step = (picture.upper - picture.lower) / static_cast<float>(kCells);
  std::vector<std::int64_t> places(static_cast<std::size_t>(kCorners) * kCorners, -1);
  const std::vector<Triangle> triangles = network.atMost(mostTriangles);
  for (const Triangle& one : triangles)
    for (const glm::ivec2& corner : one.corners) {
      std::int64_t& place = places[placeOf(corner)];
      if (place < 0) {
        place = std::ssize(mesh.points);
        mesh.points.push_back(picture.lower + step * glm::vec2(corner));
        mesh.colors.push_back(network.sample(corner).straight);
      }
      mesh.indices.push_back(static_cast<std::uint32_t>(place));
    }
  fit(mesh, triangles, network);
  keepShown(mesh, shown);
  mesh.missMeters = missOf(mesh, triangles, network, picture.upper - picture.lower);
  return mesh;
}

}  // namespace

std::vector<PictureMesh> meshesOf(const PuffPicture& picture, std::span<const std::size_t> mostTriangles) {
  std::vector<PictureMesh> meshes(mostTriangles.size());
  if (picture.image.bytes.empty()) return meshes;
  Network network(picture.image);
  const glm::dvec4 shown = shownBy(picture);
  for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i] = meshOf(picture, network, shown, mostTriangles[i]);
  return meshes;
}

}  // namespace cloudgen::writer
