// SPDX-License-Identifier: Apache-2.0
#include "shape/generate.hpp"

#include <algorithm>
#include <numbers>

#include "shape/file_shape.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

constexpr double kFlatTower = 0.28;
constexpr std::uint16_t kEvenSection = 0;
constexpr int kPuffsForStrands = 8;

RawShape texturedShape(const Recipe& recipe, const ShapeRequest& request) {
  switch (recipe.form) {
    case Form::Heap:
      return shapeHeap(recipe, request);
    case Form::Tower:
      // So wide for its depth that it stands for many towers under one shield: heaps side by side.
      return request.depthMeters < kFlatTower * request.widthMeters ? shapeHeap(recipe, request)
                                                                    : shapeTower(recipe, request);
    case Form::Cells:
      return shapeCells(recipe, request);
    case Form::Veil:
      return shapeVeil(recipe, request);
    case Form::File:
      return shapeFromFile(recipe, request);
    case Form::Filaments:
      break;
  }
  return shapeFilaments(recipe, request);
}

void scaleExtinction(std::vector<Puff>& puffs, double factor) {
  for (Puff& puff : puffs) puff.extinctionPerMeter = static_cast<float>(puff.extinctionPerMeter * factor);
}

double totalExtinctionArea(const std::vector<Puff>& puffs) {
  double sum = 0;
  for (const Puff& puff : puffs) sum += extinctionArea(puff);
  return sum;
}

/// A soft blob as wide as an element fades out.
Puff blobOf(const Recipe& recipe, const ShapeRequest& request) {
  Puff puff;
  const auto sigma = static_cast<float>((recipe.form == Form::Cells ? 0.36 : 0.29) * request.widthMeters);
  puff.center.y = static_cast<float>(0.5 * request.depthMeters);
  puff.sigma = glm::vec3(sigma, static_cast<float>(0.27 * request.depthMeters), sigma);
  puff.extinctionPerMeter = 1;
  return puff;
}

/// Adds what is even in a cloud, so that the rest holds `textureShare` of all.
void addEven(RawShape& shape, const Recipe& recipe, const ShapeRequest& request, double textureShare) {
  std::vector<Puff> even;
  if (recipe.form == Form::Filaments && request.puffs >= kPuffsForStrands)
    addStrands(even, request, kEvenSection);
  else
    even.push_back(blobOf(recipe, request));
  if (!shape.puffs.empty()) {
    scaleExtinction(shape.puffs, textureShare / totalExtinctionArea(shape.puffs));
    scaleExtinction(even, (1 - textureShare) / totalExtinctionArea(even));
  }
  shape.puffs.insert(shape.puffs.end(), even.begin(), even.end());
}

RawShape rawShape(const Recipe& recipe, const ShapeRequest& request) {
  constexpr int kPuffsForTexture = 40;
  constexpr double kEvenTexture = 0.3, kClosedTexture = 0.75;
  RawShape shape;
  // What is even shows what is usual for the genus only if there are puffs enough for it to be seen.
  if (!request.even || request.puffs >= kPuffsForTexture) shape = texturedShape(recipe, request);
  if (request.even)
    addEven(shape, recipe, request, kEvenTexture);
  else if (request.closed)
    addEven(shape, recipe, request, kClosedTexture);
  return shape;
}

}  // namespace

/// Rain is thin beside the cloud that it falls from: few and large drops.
constexpr double kPrecipitationShare = 0.02;

double footprintSquareMeters(double widthMeters) {
  return 0.25 * std::numbers::pi * widthMeters * widthMeters;
}

CloudShape generate(const Recipe& recipe, const ShapeRequest& request) {
  RawShape raw = rawShape(recipe, request);
  const double footprint = footprintSquareMeters(request.widthMeters);
  scaleExtinction(raw.puffs, request.opticalDepth * footprint / totalExtinctionArea(raw.puffs));
  if (recipe.precipitation <= 0) raw.precipitation.clear();
  for (Puff& puff : raw.precipitation) puff.rain = true;
  if (!raw.precipitation.empty())
    scaleExtinction(raw.precipitation, recipe.precipitation * request.opticalDepth * footprint *
                                           kPrecipitationShare / totalExtinctionArea(raw.precipitation));

  CloudShape cloud{std::move(raw.puffs), {}};
  cloud.puffs.insert(cloud.puffs.end(), raw.precipitation.begin(), raw.precipitation.end());
  std::stable_sort(cloud.puffs.begin(), cloud.puffs.end(),
                   [](const Puff& a, const Puff& b) { return a.section < b.section; });
  base::RandomStream sprites(request.seed, request.variant, base::Purpose::BillboardSprite);
  int section = -1;
  std::uint16_t number = 0;
  for (std::uint32_t i = 0; i < cloud.puffs.size(); ++i) {
    Puff& puff = cloud.puffs[i];
    if (puff.section != section) {
      section = puff.section;
      number = static_cast<std::uint16_t>(cloud.sectionStart.size());
      cloud.sectionStart.push_back(i);
    }
    puff.section = number;
    puff.sprite = static_cast<std::uint16_t>(sprites.index(16));
  }
  cloud.sectionStart.push_back(static_cast<std::uint32_t>(cloud.puffs.size()));
  return cloud;
}

}  // namespace cloudgen::shape
