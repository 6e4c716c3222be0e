// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/genus_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace cloudgen::check {
namespace {

/// Layers whose bases differ by less are not told apart by the foot of a cloud, metres.
constexpr double kSameBase = 50;

/// What is said of it and what is drawn is that genus, and at least one is known.
bool isOf(const WrittenCloud& cloud, const std::optional<base::Genus>& genus) {
  return (cloud.recorded || cloud.drawn) && (!cloud.recorded || cloud.recorded == genus) &&
         (!cloud.drawn || cloud.drawn == genus);
}

}  // namespace

GenusScore genusScore(std::span<const WrittenCloud> clouds, const base::LocalFrame& frame,
                      const field::Source& stating) {
  GenusScore score;
  const auto cells = field::cellsTouching(stating.grid(), frame.box());
  std::map<std::uint32_t, std::vector<field::StatedLayer>> stated;
  stating.visitLayers(cells, [&](const field::StatedLayer& layer) { stated[layer.cell].push_back(layer); });
  const field::CellFinder finder(stating.grid());
  for (const WrittenCloud& cloud : clouds) {
    const glm::dvec3 place = frame.toGeographic(glm::dvec3(cloud.foot));
    const auto cell = finder.at({place.x, place.y});
    const auto here = cell ? stated.find(*cell) : stated.end();
    if (here == stated.end()) continue;
    const auto distance = [&](const field::StatedLayer& layer) {
      return static_cast<double>(std::abs(layer.baseMeters - cloud.foot.y));
    };
    double nearest = distance(here->second.front());
    for (const field::StatedLayer& layer : here->second) nearest = std::min(nearest, distance(layer));
    bool untyped = false, agrees = false;
    for (const field::StatedLayer& layer : here->second) {
      if (distance(layer) > nearest + kSameBase) continue;
      untyped = untyped || !layer.genus;
      agrees = agrees || isOf(cloud, layer.genus);
    }
    if (untyped) continue;
    ++score.clouds;
    if (agrees) ++score.agreeing;
  }
  return score;
}

}  // namespace cloudgen::check
