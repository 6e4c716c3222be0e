// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/picture_cards.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <span>

namespace cloudgen::check {
namespace {

/// Vertices that triangles join are of one card. Gives each vertex the first vertex of its card.
std::vector<std::uint32_t> firstOfCard(const PictureMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.vertices());
  std::iota(first.begin(), first.end(), 0u);
  const auto find = [&](std::uint32_t vertex) {
    while (first[vertex] != vertex) vertex = first[vertex] = first[first[vertex]];
    return vertex;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t a = find(mesh.triangles[t - t % 3]), b = find(mesh.triangles[t]);
    first[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t vertex = 0; vertex < first.size(); ++vertex) first[vertex] = find(vertex);
  return first;
}

/// The card of some vertices, by the corners of their texture; its alpha is their mean.
Card cardOf(const PictureMesh& mesh, std::span<const std::uint32_t> vertices) {
  // The vertex that lies farthest to a corner: the sum of u and v with a sign each.
  const auto corner = [&](float alongU, float alongV) {
    const auto farness = [&](std::uint32_t v) {
      return alongU * mesh.places[2 * v] + alongV * mesh.places[2 * v + 1];
    };
    return mesh.point(*std::ranges::max_element(vertices, {}, farness));
  };
  const glm::vec3 lowerLeft = corner(-1, 1), lowerRight = corner(1, 1), upperLeft = corner(-1, -1);
  Card card;
  card.center = 0.5f * (lowerRight + upperLeft);
  card.right = 0.5f * (lowerRight - lowerLeft);
  card.up = 0.5f * (upperLeft - lowerLeft);
  float alpha = 0, stated = 0;
  for (const std::uint32_t vertex : vertices) {
    alpha += mesh.colors[4 * vertex + 3] / static_cast<float>(vertices.size());
    if (!mesh.opticalDepths.empty())
      stated += mesh.opticalDepths[vertex] / static_cast<float>(vertices.size());
  }
  card.opticalDepth = opticalDepthOf(alpha, stated);
  return card;
}

/// The cells of a relief in which a column meets something, each as a sprite that spreads it over the cell.
void addCellsOf(const PictureMesh& mesh, std::vector<Card>& cards) {
  constexpr float kDeviation = 0.33f;  // in sides of the cell: smooth across cells, and hardly beyond the outmost
  constexpr float kCentralShare =
      1 / (2 * std::numbers::pi_v<float> * kDeviation * kDeviation * kWithinCard);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 6) {
    const std::array<std::uint32_t, 4> corners{mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2],
                                               mesh.triangles[t + 5]};
    float opticalDepth = 0;
    for (const std::uint32_t corner : corners) opticalDepth += 0.25f * mesh.verticalOpticalDepths[corner];
    if (!(opticalDepth > 0)) continue;
    const glm::vec3 a = mesh.point(corners[0]), b = mesh.point(corners[1]), c = mesh.point(corners[2]),
                    d = mesh.point(corners[3]);
    Card card;
    card.center = 0.25f * (a + b + c + d);
    card.right = 0.5f * kDeviation * kCardReach * (b + c - a - d);
    card.up = 0.5f * kDeviation * kCardReach * (c + d - a - b);
    card.opticalDepth = kCentralShare * opticalDepth;
    card.front = card.back = true;
    cards.push_back(card);
  }
}

}  // namespace

void addCardsOf(const PictureMesh& mesh, std::vector<Card>& cards) {
  if (!mesh.verticalOpticalDepths.empty()) return addCellsOf(mesh, cards);
  const auto first = firstOfCard(mesh);
  std::vector<std::uint32_t> order(first.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t vertex) { return first[vertex]; });
  std::vector<std::size_t> cardAt(first.size(), 0);
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() && first[order[to]] == first[order[from]]) ++to;
    cardAt[first[order[from]]] = cards.size();
    cards.push_back(cardOf(mesh, std::span(order).subspan(from, to - from)));
    cards.back().front = cards.back().back = mesh.doubleSided;
  }
  for (std::size_t t = 0; !mesh.doubleSided && t < mesh.triangles.size(); t += 3) {
    Card& card = cards[cardAt[first[mesh.triangles[t]]]];
    const glm::vec3 corner = mesh.point(mesh.triangles[t]);
    const glm::vec3 normal =
        glm::cross(mesh.point(mesh.triangles[t + 1]) - corner, mesh.point(mesh.triangles[t + 2]) - corner);
    (glm::dot(normal, glm::cross(card.right, card.up)) > 0 ? card.front : card.back) = true;
  }
}

}  // namespace cloudgen::check
