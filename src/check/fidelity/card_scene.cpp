// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/card_scene.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"

namespace cloudgen::check {
namespace {

constexpr std::size_t kMostCards = 10'000'000, kMostVisits = 20'000'000;
/// Alpha is written with three decimals: what is above may be any optical depth from 7.6 on.
constexpr float kMostOpaque = 0.9995f;

/// Where a subtree stands, and how high it stands for a viewer beside it.
struct Pose {
  glm::mat4 fromAbove{1}, fromBeside{1};
  bool turned = false;  ///< below a Billboard: the two are not the same
};

glm::vec3 pointOf(const glm::mat4& pose, const glm::vec3& point) {
  return glm::vec3(pose * glm::vec4(point, 1));
}
glm::vec3 vectorOf(const glm::mat4& pose, const glm::vec3& vector) {
  return glm::vec3(pose * glm::vec4(vector, 0));
}

/// A Billboard that turns about every axis: its z axis points to the viewer, its y axis to where the viewer
/// has up, which is north for one who looks down. Seen from beside its y axis stands upright.
Pose turnedToViewer(const Pose& pose) {
  const glm::vec4 pivot = pose.fromAbove[3];
  const float scale = glm::length(glm::vec3(pose.fromAbove[0]));
  Pose out;
  out.turned = true;
  out.fromAbove = {glm::vec4(scale, 0, 0, 0), glm::vec4(0, 0, -scale, 0), glm::vec4(0, scale, 0, 0), pivot};
  out.fromBeside = {glm::vec4(scale, 0, 0, 0), glm::vec4(0, scale, 0, 0), glm::vec4(0, 0, scale, 0), pivot};
  return out;
}

class Walk {
 public:
  Walk(const std::vector<CardNode>& nodes, const std::string& where, WrittenScene& scene)
      : nodes_(nodes), where_(where), scene_(scene) {}

  void visit(std::uint32_t index, Pose pose, WrittenCloud* cloud) {
    if (++visits_ > kMostVisits || scene_.footprints.size() > kMostCards)
      throw base::InputError(where_, "draws more cards than can be read", "is it a scene of cloudgen?");
    const CardNode& node = nodes_[index];
    if (node.kind == CardNodeKind::Transform) {
      pose.fromAbove = pose.fromAbove * node.matrix;
      pose.fromBeside = pose.fromBeside * node.matrix;
    }
    if (node.kind == CardNodeKind::Billboard) pose = turnedToViewer(pose);
    for (const Card& card : node.cards) add(card, pose);
    if (node.kind == CardNodeKind::Shape && cloud && !cloud->drawn) cloud->drawn = node.drawn;

    WrittenCloud own;
    if (node.isCloud) {
      own.foot = glm::vec3(pose.fromAbove[3]);
      own.recorded = node.recorded;
      cloud = &own;
    }
    const std::size_t shown = node.kind == CardNodeKind::FirstLevel
                                  ? std::min<std::size_t>(1, node.children.size())
                                  : node.children.size();
    for (std::size_t i = 0; i < shown; ++i) visit(node.children[i], pose, cloud);
    if (node.isCloud) scene_.clouds.push_back(own);
  }

 private:
  void add(const Card& card, const Pose& pose) {
    const glm::vec3 right = vectorOf(pose.fromAbove, card.right), up = vectorOf(pose.fromAbove, card.up);
    const float facing = glm::cross(right, up).y;
    if (!(facing > 0 ? card.front : card.back)) return;
    if (card.alpha >= kMostOpaque) ++scene_.saturated;
    const float depth = -std::log1p(-std::min(card.alpha, kMostOpaque));
    Footprint footprint = footprintOfCard(pointOf(pose.fromAbove, card.center),
                                          {right / kCardReach, up / kCardReach}, kCardReach, depth);
    if (pose.turned) {
      const float rise = vectorOf(pose.fromBeside, card.right).y,
                  stand = vectorOf(pose.fromBeside, card.up).y;
      footprint.height = pointOf(pose.fromBeside, card.center).y;
      footprint.heightSlope = glm::vec2(0);
      footprint.heightDeviation = std::hypot(rise, stand) / kCardReach;
    }
    if (isSeen(footprint)) scene_.footprints.push_back(footprint);
  }

  const std::vector<CardNode>& nodes_;
  const std::string& where_;
  WrittenScene& scene_;
  std::size_t visits_ = 0;
};

}  // namespace

void flatten(const std::vector<CardNode>& nodes, const std::string& where, WrittenScene& scene) {
  if (!nodes.empty()) Walk(nodes, where, scene).visit(0, {}, nullptr);
}

}  // namespace cloudgen::check
