// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::writer {

/// Puffs of a cloud that are drawn together. A cluster about as high as wide turns to the viewer as one
/// Billboard. A flat or long one would stand up or turn away; its puffs become crossed cards that stay where
/// they are.
struct Cluster {
  std::vector<std::uint32_t> puffs;  ///< indices, ascending
  glm::vec3 center{0};               ///< the middle of the puffs' box
  bool turns = true;                 ///< true: a Billboard, false: crossed cards
};

/// Divides a cloud into clusters: its sections, those that are no rounder than they should be split across
/// their longest side, until every part is round or `most` clusters are made. All parts that stay flat share
/// the last cluster.
std::vector<Cluster> clustersOf(std::span<const shape::Puff> puffs,
                                std::span<const std::uint32_t> sectionStart, std::size_t most);

}  // namespace cloudgen::writer
