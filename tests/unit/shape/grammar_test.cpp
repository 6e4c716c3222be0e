// SPDX-License-Identifier: Apache-2.0
#include "shape/grammar.hpp"

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "shape/file_shape.hpp"
#include "support/heap_recipe.hpp"

namespace cloudgen::shape {
namespace {

std::string text(const std::string& axiom, const std::string& productions, int depth = 3) {
  return R"({"cloudgen_lsystem": 1, "axiom": ")" + axiom + R"(", "productions": )" + productions +
         R"(, "ground": {"P": {"radius": 0.5}, "Q": {"radius": 2}}, "depth": )" + std::to_string(depth) +
         R"(, "angle_degrees": 90, "shrink": 0.5})";
}

std::vector<GrownBall> grown(const std::string& grammar, std::uint64_t seed = 1) {
  return grow(grammarFromJson(grammar, "my.lsystem.json"), seed, 0);
}

void expectNear(const glm::dvec3& is, const glm::dvec3& should) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(is[i], should[i], 1e-9);
}

TEST(Grammar, TheTurtleDrawsWhatItIsTold) {
  const auto balls = grown(text("PF[+FP]>F&FQ", "{}"));
  ASSERT_EQ(balls.size(), 3u);
  expectNear(balls[0].center, {0, 0, 0});
  expectNear(balls[1].center, {-1, 1, 0});  // + turns left, seen from +z
  expectNear(balls[2].center, {0, 1.5, 0.5});
  EXPECT_DOUBLE_EQ(balls[2].radius, 1);  // half of 2
}

TEST(Grammar, SymbolsAreRewrittenAsOftenAsTheDepthSays) {
  for (const int depth : {0, 1, 4})
    EXPECT_EQ(grown(text("PA", R"({"A": "FPA"})", depth)).size(), static_cast<std::size_t>(depth + 1));
}

TEST(Grammar, ChanceFollowsTheWeights) {
  const std::string grammar =
      text("PA", R"({"A": [{"weight": 3, "to": "FP"}, {"weight": 1, "to": "FPFP"}]})");
  int longer = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) longer += grown(grammar, seed).size() == 3 ? 1 : 0;
  EXPECT_NEAR(longer, 100, 30);
  EXPECT_EQ(grown(grammar, 7).size(), grown(grammar, 7).size());
}

TEST(Grammar, ABranchDoesNotDependOnItsNeighbours) {
  // The second branch chooses by its own address, however long the first one is.
  const auto last = [](const std::string& first) {
    std::vector<std::size_t> sizes;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const auto balls = grown(text("P[B][~~FQ]", R"({"B": ")" + first + R"("})"), seed);
      sizes.push_back(static_cast<std::size_t>(balls.back().center.x * 1e6));
    }
    return sizes;
  };
  EXPECT_EQ(last("FP"), last("F~P~F~P"));
}

void expectRefused(const std::string& grammar, const std::string& saying) {
  try {
    grammarFromJson(grammar, "my.lsystem.json");
    ADD_FAILURE() << "accepted, should say " << saying;
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.where(), "my.lsystem.json");
    EXPECT_NE(error.problem().find(saying), std::string::npos) << error.problem();
    EXPECT_FALSE(error.hint().empty());
  }
}

TEST(Grammar, WhatIsWrongIsNamed) {
  expectRefused("", "is not an L-system");
  expectRefused("[]", "is not an L-system");
  expectRefused(text("P[", "{}"), "brackets");
  expectRefused(text("P]P[", "{}"), "brackets");
  expectRefused(text("P?", "{}"), "\"?\"");
  expectRefused(text("A", R"({"A": "A[B"})"), "brackets");
  expectRefused(text("A", R"({"AB": "P"})"), "AB");
  expectRefused(text("A", R"({"A": []})"), "empty");
  expectRefused(text("A", R"({"A": "AA"})"), "draws nothing");
  expectRefused(text("|FP", "{}"), "draws nothing");
  expectRefused(text("P", "{}", 33), "depth");
  expectRefused(text("PA", R"({"A": "PAAAA"})", 20), "symbols");
}

TEST(Grammar, CloudsStandOnTheStart) {
  const std::string grammar =
      base::readFile(base::dataDir() / "examples" / "shapes" / "congestus.lsystem.json");
  const FileShape shape = shapeFromGrammar(grammar, "congestus.lsystem.json");
  EXPECT_GT(shape.widthOverDepth, 0.4);
  EXPECT_LT(shape.widthOverDepth, 2);
  const Recipe recipe = recipeFromJson(test::kHeapRecipe, "my.json");
  ShapeRequest request;
  request.widthMeters = 2000, request.depthMeters = 2000;
  for (const int puffs : {12, 200, 3000})
    for (request.variant = 0; request.variant < 3; ++request.variant) {
      request.puffs = puffs;
      const std::vector<Puff> made = shape.shape(recipe, request).puffs;
      EXPECT_LE(static_cast<int>(made.size()), puffs * 3 / 2);
      EXPECT_GE(static_cast<int>(made.size()), puffs / 2);
      for (const Puff& puff : made) EXPECT_GE(puff.center.y - 1.2f * puff.sigma.y, -1);
      EXPECT_NEAR(boundsOf(made, 1.5f).upper.y, 2000, 400);
    }
}

}  // namespace
}  // namespace cloudgen::shape
