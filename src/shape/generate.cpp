// SPDX-License-Identifier: Apache-2.0
#include "shape/generate.hpp"

#include <algorithm>
#include <numbers>

#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

RawShape rawShape(const Recipe& recipe, const ShapeRequest& request) {
  switch (recipe.form) {
    case Form::Heap:
      return shapeHeap(recipe, request);
    case Form::Tower:
      return shapeTower(recipe, request);
    case Form::Cells:
      return shapeCells(recipe, request);
    case Form::Veil:
      return shapeVeil(recipe, request);
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

}  // namespace

double footprintSquareMeters(double widthMeters) {
  return 0.25 * std::numbers::pi * widthMeters * widthMeters;
}

CloudShape generate(const Recipe& recipe, const ShapeRequest& request) {
  RawShape raw = rawShape(recipe, request);
  const double footprint = footprintSquareMeters(request.widthMeters);
  scaleExtinction(raw.puffs, request.opticalDepth * footprint / totalExtinctionArea(raw.puffs));
  if (recipe.precipitation <= 0) raw.precipitation.clear();
  if (!raw.precipitation.empty())
    scaleExtinction(raw.precipitation, recipe.precipitation * request.opticalDepth * footprint * 0.05 /
                                           totalExtinctionArea(raw.precipitation));

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
