// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/card_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "base/error.hpp"

namespace cloudgen::check {
namespace {

constexpr std::size_t kMostCards = 10'000'000, kMostVisits = 20'000'000;

/// Where a subtree stands in the scene; below a Billboard, from its pivot.
struct Pose {
  glm::mat4 matrix{1};
  std::optional<std::uint32_t> pivot;
};

glm::vec3 pointOf(const glm::mat4& matrix, const glm::vec3& point) {
  return glm::vec3(matrix * glm::vec4(point, 1));
}
glm::vec3 vectorOf(const glm::mat4& matrix, const glm::vec3& vector) {
  return glm::vec3(matrix * glm::vec4(vector, 0));
}

class Walk {
 public:
  Walk(const std::vector<CardNode>& nodes, const std::string& where, WrittenScene& scene)
      : nodes_(nodes), where_(where), scene_(scene) {}

  void visit(std::uint32_t index, Pose pose, WrittenCloud* cloud) {
    if (++visits_ > kMostVisits || scene_.blobs.size() > kMostCards)
      throw base::InputError(where_, "draws more cards than can be read", "is it a scene of cloudgen?");
    const CardNode& node = nodes_[index];
    if (node.kind == CardNodeKind::Transform) pose.matrix = pose.matrix * node.matrix;
    if (node.kind == CardNodeKind::Billboard) pose = turning(pose);
    for (const Card& card : node.cards) add(card, pose);
    if (node.kind == CardNodeKind::Shape && cloud && !cloud->drawn) cloud->drawn = node.drawn;

    WrittenCloud own;
    if (node.isCloud) {
      own.foot = pose.pivot ? scene_.pivots[*pose.pivot].place : glm::vec3(pose.matrix[3]);
      own.recorded = node.recorded;
      cloud = &own;
    }
    for (const std::uint32_t child : drawnOf(node)) visit(child, pose, cloud);
    if (node.isCloud) scene_.clouds.push_back(own);
  }

 private:
  static std::span<const std::uint32_t> drawnOf(const CardNode& node) {
    const std::span<const std::uint32_t> all(node.children);
    if (node.kind == CardNodeKind::FirstLevel) return all.first(std::min<std::size_t>(1, all.size()));
    if (node.kind != CardNodeKind::Choice) return all;
    const bool isThere = node.choice >= 0 && node.choice < std::ssize(all);
    return isThere ? all.subspan(static_cast<std::size_t>(node.choice), 1) : all.first(0);
  }

  /// A Billboard that turns about every axis. One within another keeps facing as that does.
  Pose turning(const Pose& pose) {
    const float scale = glm::length(glm::vec3(pose.matrix[0]));
    Pose out;
    out.pivot = pose.pivot;
    if (pose.pivot) {
      out.matrix = glm::mat4(glm::mat3(scale));
      out.matrix[3] = pose.matrix[3];
      return out;
    }
    out.pivot = static_cast<std::uint32_t>(scene_.pivots.size());
    scene_.pivots.push_back({glm::vec3(pose.matrix[3]), scale});
    return out;
  }

  void add(const Card& card, const Pose& pose) {
    Blob blob = cardBlob(pointOf(pose.matrix, card.center), vectorOf(pose.matrix, card.right) / kCardReach,
                         vectorOf(pose.matrix, card.up) / kCardReach, card.opticalDepth);
    blob.narrowing = card.narrowing;
    blob.front = card.front;
    blob.back = card.back;
    if (pose.pivot) {
      blob.kind = BlobKind::Turning;
      blob.pivot = *pose.pivot;
    }
    scene_.blobs.push_back(blob);
  }

  const std::vector<CardNode>& nodes_;
  const std::string& where_;
  WrittenScene& scene_;
  std::size_t visits_ = 0;
};

}  // namespace

float opticalDepthOf(float alpha, float stated) {
  constexpr float kAgreeing = 1e-3f;
  if (stated > 0 && std::isfinite(stated) && std::abs(-std::expm1(-stated) - alpha) < kAgreeing)
    return stated;
  return -std::log1p(-std::clamp(alpha, 0.0f, 1.0f));
}

void boundSaturated(WrittenScene& scene, float mostOpaque) {
  float least = opticalDepthOf(mostOpaque);
  for (const Blob& blob : scene.blobs)
    if (std::isfinite(blob.strength)) least = std::max(least, blob.strength);
  for (Blob& blob : scene.blobs) {
    if (blob.strength != std::numeric_limits<float>::infinity()) continue;
    blob.strength = least;
    ++scene.saturated;
  }
}

void flatten(const std::vector<CardNode>& nodes, const std::string& where, WrittenScene& scene) {
  if (!nodes.empty()) Walk(nodes, where, scene).visit(0, {}, nullptr);
}

}  // namespace cloudgen::check
