// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/genus_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cloudgen::check {

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
      return std::abs(layer.baseMeters - cloud.foot.y);
    };
    const auto nearest =
        std::min_element(here->second.begin(), here->second.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    if (!nearest->genus) continue;
    ++score.clouds;
    const bool recorded = !cloud.recorded || *cloud.recorded == *nearest->genus,
               drawn = !cloud.drawn || *cloud.drawn == *nearest->genus;
    if (recorded && drawn && (cloud.recorded || cloud.drawn)) ++score.agreeing;
  }
  return score;
}

}  // namespace cloudgen::check
