// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity.hpp"

#include "base/thread.hpp"
#include "pipeline/blocks.hpp"
#include "pipeline/counted.hpp"
#include "pipeline/group_clouds.hpp"

namespace cloudgen::pipeline {

void placeClouds(const field::Grid& grid, const Options& options, const Generalisation& general,
                 const base::GeoBox& box, field::CloudTable& table) {
  const auto keep = [&](const std::vector<field::Cloud>& clouds) {
    for (const field::Cloud& cloud : clouds)
      if (box.contains(cloud.longitudeDegrees, cloud.latitudeDegrees)) table.clouds.push_back(cloud);
  };
  for (std::uint32_t index = 0; index < table.layers.size(); ++index)
    if (table.layers[index].cloudCount > 0) keep(countedClouds(grid, options, table.layers[index], index));

  const std::vector<LayerGroup> groups = groupLayers(grid, general, table.layers);
  const Surroundings surroundings(grid, table.layers);
  FootprintBook footprints(options, general);
  const GroupContext context{grid, options, general, table.layers, surroundings, footprints};
  std::vector<std::vector<field::Cloud>> clouds(groups.size());
  base::parallelFor(groups.size(), [&](std::size_t i) { clouds[i] = groupClouds(context, groups[i]); });
  for (const std::vector<field::Cloud>& of : clouds) keep(of);
}

}  // namespace cloudgen::pipeline
