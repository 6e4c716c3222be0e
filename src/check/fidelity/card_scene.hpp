// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "check/fidelity/written_scene.hpp"

namespace cloudgen::check {

/// A textured rectangle of a cloud, in the coordinates of its Shape.
struct Card {
  glm::vec3 center{0}, right{0}, up{0};  ///< half-sides; its front looks along right x up
  float opticalDepth = 0;                ///< of the centre
  float narrowing = 1;                   ///< Blob::narrowing
  bool front = false, back = false;      ///< which faces are drawn
};

enum class CardNodeKind { Group, Transform, FirstLevel, Choice, Billboard, Shape };

/// What matters of a node of the scene graph; children are indices, and may have several parents (USE).
struct CardNode {
  CardNodeKind kind = CardNodeKind::Group;
  glm::mat4 matrix{1};  ///< of a Transform
  std::vector<std::uint32_t> children;
  std::vector<Card> cards;              ///< of a Shape
  std::optional<base::Genus> drawn;     ///< of a Shape: whose sprites
  std::optional<base::Genus> recorded;  ///< of a Transform that is a cloud
  std::int64_t choice = 0;              ///< of a Choice: index of the child that is drawn, or none
  bool isFile = false;                  ///< the Group of an Inline, or one that holds such
  bool isCloud = false;
  int depth = 1;  ///< of the graph below it
};

/// Optical depth of the centre of a card; infinite where its alpha is 1. Where alpha is nearly 1, what is
/// stated beside it counts, unless that is another alpha.
float opticalDepthOf(float alpha, float stated = 0);

/// Counts the cards whose alpha is 1 and gives them the optical depth that they have at least: that of
/// `mostOpaque`, the largest alpha that may have been rounded to 1, or that of the most opaque other card.
void boundSaturated(WrittenScene& scene, float mostOpaque);

/// Walks the graph from the first node down and adds the cards and clouds that are drawn. Throws InputError,
/// naming `where`, if the scene draws more than can be held.
void flatten(const std::vector<CardNode>& nodes, const std::string& where, WrittenScene& scene);

}  // namespace cloudgen::check
