// SPDX-License-Identifier: Apache-2.0
#include "shape/file_shape.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "shape/solid.hpp"
#include "support/bodies.hpp"
#include "support/heap_recipe.hpp"

namespace cloudgen::shape {
namespace {

constexpr double kWidth = 2000, kDepth = 1500;

ShapeRequest requestOf(int puffs) {
  ShapeRequest request;
  request.widthMeters = kWidth, request.depthMeters = kDepth, request.puffs = puffs;
  request.seed = 4, request.variant = 1;
  return request;
}

std::vector<Puff> puffsOf(const FileShape& shape, int puffs) {
  return shape.shape(recipeFromJson(test::kHeapRecipe, "my.json"), requestOf(puffs)).puffs;
}

/// Extinction at a point.
double at(const std::vector<Puff>& puffs, const glm::vec3& point) {
  double sum = 0;
  for (const Puff& puff : puffs) {
    const glm::vec3 own = glm::inverse(puff.rotation) * (point - puff.center) / puff.sigma;
    sum += puff.extinctionPerMeter * std::exp(-0.5 * glm::dot(own, own));
  }
  return sum;
}

void expectFillsRequest(const std::vector<Puff>& puffs, int asked) {
  EXPECT_LE(static_cast<int>(puffs.size()), asked * 3 / 2);
  EXPECT_GE(static_cast<int>(puffs.size()), asked / 2);
  const Bounds bounds = boundsOf(puffs, 1.5f);
  EXPECT_NEAR(bounds.lower.y, 0, 0.2 * kDepth);
  EXPECT_NEAR(bounds.upper.y, kDepth, 0.2 * kDepth);
  for (const Puff& puff : puffs) {
    EXPECT_GT(puff.extinctionPerMeter, 0);
    EXPECT_TRUE(std::isfinite(puff.center.x + puff.sigma.x + puff.sigma.y + puff.sigma.z));
    EXPECT_GT(std::min({puff.sigma.x, puff.sigma.y, puff.sigma.z}), 0);
  }
}

double share(const std::vector<Puff>& puffs, const glm::vec3& point) {
  double most = 0;
  for (const Puff& puff : puffs) most = std::max(most, at(puffs, puff.center));
  return at(puffs, point) / most;
}

TEST(FileShape, RingOfPuffsHasItsHole) {
  const FileShape ring = shapeFromMesh(test::ringMesh(), "ring.obj");
  EXPECT_NEAR(ring.widthOverDepth, std::sqrt(2.7 * 0.7) / 2.7, 0.03);
  for (const int count : {100, 400, 3000}) {
    SCOPED_TRACE(count);
    const std::vector<Puff> puffs = puffsOf(ring, count);
    expectFillsRequest(puffs, count);
    const auto radius = static_cast<float>(0.5 * kDepth / 1.35);
    EXPECT_LT(share(puffs, {0, 0.5 * kDepth, 0}), 0.02) << "the hole is open";
    for (const float side : {-1.0f, 1.0f})
      EXPECT_GT(share(puffs, {0, 0.5f * static_cast<float>(kDepth) + side * radius, 0}), 0.1)
          << "the tube is full";
  }
}

TEST(FileShape, BodyOfPuffsIsAsLargeAsItsMesh) {
  const FileShape box = shapeFromMesh(test::boxMesh({2, 1.5, 2}), "box.off");
  const std::vector<Puff> puffs = puffsOf(box, 1000);
  expectFillsRequest(puffs, 1000);
  EXPECT_GT(share(puffs, {0, 750, 0}), 0.1) << "filled, not a shell";
  EXPECT_GT(share(puffs, {700, 750, 0}), 0.1);
  EXPECT_LT(share(puffs, {1200, 750, 0}), 0.05);
  EXPECT_LT(share(puffs, {0, 1750, 0}), 0.05);
}

TEST(FileShape, OpenMeshesAndThoseThatCrossThemselvesAreWrapped) {
  base::Mesh open = test::boxMesh({1, 1, 1});
  open.triangles.resize(open.triangles.size() - 2);
  base::Mesh crossing = test::boxMesh({2, 1, 1});
  const base::Mesh other = test::boxMesh({1, 2, 1}, {0.3, 0, 0.1});
  for (auto triangle : other.triangles) {
    for (std::uint32_t& corner : triangle) corner += 8;
    crossing.triangles.push_back(triangle);
  }
  crossing.points.insert(crossing.points.end(), other.points.begin(), other.points.end());
  for (const base::Mesh& mesh : {open, crossing}) {
    SCOPED_TRACE(mesh.points.size());
    const std::vector<Puff> puffs = puffsOf(shapeFromMesh(mesh, "mesh.ply"), 500);
    expectFillsRequest(puffs, 500);
    EXPECT_GT(share(puffs, {0, 0.5 * kDepth, 0}), 0.06) << "filled, not a shell";
  }
}

TEST(FileShape, MeshesThatAreNoBodyAreRefused) {
  base::Mesh flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_THROW(shapeFromMesh(flat, "flat.obj"), base::InputError);
  base::Mesh point;
  point.points = {{1, 1, 1}};
  point.triangles = {{0, 0, 0}};
  EXPECT_THROW(shapeFromMesh(point, "point.obj"), base::InputError);
}

TEST(Solid, EachLevelHasHalfOfTheTriangles) {
  const auto levels = simplifiedSolids(test::ringMesh(), 300, "ring.obj");
  ASSERT_GE(levels.size(), 3u);
  EXPECT_LE(levels.front().triangles.size(), 300u);
  for (std::size_t i = 1; i < levels.size(); ++i)
    EXPECT_LE(levels[i].triangles.size(), levels[i - 1].triangles.size() / 2 + 2);
}

TEST(FileShape, MorePuffsAreNearerToAVolume) {
  const FileShape volume = shapeFromVolume(test::twoBalls());
  EXPECT_NEAR(volume.widthOverDepth, std::sqrt(29.0 * 16) / 21, 0.1);
  std::array<double, 3> last{1, 1, 1};
  for (const int count : {8, 64, 512, 4096}) {
    const std::vector<Puff> puffs = puffsOf(volume, count);
    EXPECT_LE(static_cast<int>(puffs.size()), count);
    const auto errors = volume.opticalDepthErrors(puffs, kWidth, kDepth);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(errors[i], last[i]) << count;
      RecordProperty("error_" + std::to_string(count) + "_" + std::to_string(i), std::to_string(errors[i]));
    }
    last = errors;
  }
  for (const double error : last) EXPECT_LT(error, 0.06);
}

TEST(FileShape, TheSameRequestGivesTheSamePuffs) {
  const FileShape one = shapeFromMesh(test::ringMesh(), "a"), two = shapeFromMesh(test::ringMesh(), "b");
  const auto a = puffsOf(one, 300), b = puffsOf(two, 300);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].center, b[i].center);
    EXPECT_EQ(a[i].sigma, b[i].sigma);
  }
}

TEST(FileShape, SectionsAreSmallPartsOfTheForm) {
  Recipe recipe = recipeFromJson(test::kHeapRecipe, "my.json");
  recipe.form = Form::File;
  recipe.fileShape = std::make_shared<const FileShape>(shapeFromMesh(test::ringMesh(), "ring.obj"));
  const RawShape shape = shapeFromFile(recipe, requestOf(600));
  std::map<int, std::vector<Puff>> sections;
  for (const Puff& puff : shape.puffs) sections[puff.section].push_back(puff);
  EXPECT_EQ(sections.size(), 20u);
  const Bounds whole = boundsOf(shape.puffs, 0);
  for (const auto& [number, puffs] : sections) {
    const Bounds box = boundsOf(puffs, 0);
    EXPECT_LT(glm::distance(box.lower, box.upper), 0.4f * glm::distance(whole.lower, whole.upper)) << number;
  }
}

TEST(FileShape, AFlatBaseIsFlat) {
  std::vector<Puff> puffs = puffsOf(shapeFromMesh(test::ringMesh(), "ring.obj"), 400);
  double before = 0, after = 0;
  for (const Puff& puff : puffs) before += extinctionArea(puff);
  flattenBase(puffs, kDepth);
  for (const Puff& puff : puffs) after += extinctionArea(puff);
  EXPECT_NEAR(after / before, 1, 1e-3);
  for (const Puff& puff : puffs) EXPECT_GE(puff.center.y, kDepth / 12 - 1);
}

}  // namespace
}  // namespace cloudgen::shape
