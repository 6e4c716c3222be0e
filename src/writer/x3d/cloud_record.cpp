// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_record.hpp"

#include <array>

#include "base/text.hpp"

namespace cloudgen::writer {

void writeRecord(NodeWriter& nodes, const scene::CloudRecord& cloud) {
  const std::string genus(base::abbreviation(cloud.genus)), id = std::to_string(cloud.id);
  const std::array<float, 3> measures{cloud.baseMeters, cloud.topMeters, cloud.opticalDepth};
  if (nodes.encoding() == Encoding::Vrml97) {
    std::string numbers = "base_m ";
    base::appendFixed(numbers, measures[0], 0);
    numbers += " top_m ";
    base::appendFixed(numbers, measures[1], 0);
    numbers += " optical_depth ";
    base::appendFixed(numbers, measures[2], 2);
    nodes.open("WorldInfo");
    nodes.strings("info", std::vector<std::string>{"id " + id, "genus " + genus, "rule " + cloud.rule,
                                                    "cell " + std::to_string(cloud.cell), numbers});
    nodes.string("title", "cloud");
    nodes.close();
    return;
  }
  nodes.open("MetadataSet", "metadata");
  nodes.string("name", "cloud");
  nodes.open("MetadataString", "value");
  nodes.string("name", "id genus rule");
  nodes.strings("value", std::vector<std::string>{id, genus, cloud.rule});
  nodes.close();
  nodes.open("MetadataInteger", "value");
  nodes.string("name", "cell");
  nodes.integers("value", std::array{static_cast<std::int32_t>(cloud.cell)});
  nodes.close();
  nodes.open("MetadataFloat", "value");
  nodes.string("name", "base_m top_m optical_depth");
  nodes.numbers("value", measures, 1, 2);
  nodes.close();
  nodes.close();
}

}  // namespace cloudgen::writer
