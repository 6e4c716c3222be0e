// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/picture_cards.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
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

}  // namespace

void addCardsOf(const PictureMesh& mesh, std::vector<Card>& cards) {
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
