// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/relief.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::writer {
namespace {

/// Where nothing is seen about a vertex it takes the place of its neighbours.
void fillGaps(Relief& relief, std::vector<bool> isKnown, float otherwise) {
  for (bool isFilled = false; !isFilled;) {
    isFilled = true;
    const std::vector<bool> before = isKnown;
    for (int row = 0; row <= relief.rows; ++row)
      for (int column = 0; column <= relief.columns; ++column) {
        const std::size_t at = relief.vertex(column, row);
        if (before[at]) continue;
        float sum = 0;
        int count = 0;
        for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          const int nextColumn = column + x, nextRow = row + y;
          if (nextColumn < 0 || nextRow < 0 || nextColumn > relief.columns || nextRow > relief.rows) continue;
          const std::size_t next = relief.vertex(nextColumn, nextRow);
          if (before[next]) sum += relief.nearness[next], ++count;
        }
        if (count == 0) continue;
        relief.nearness[at] = sum / static_cast<float>(count);
        isKnown[at] = true;
        isFilled = false;
      }
  }
  for (std::size_t at = 0; at < isKnown.size(); ++at)
    if (!isKnown[at]) relief.nearness[at] = otherwise;
}

/// Takes the mean with the neighbours: what stands before something else would hang together with it by
/// walls.
void smoothen(Relief& relief) {
  const auto blur = [&](int columnStep, int rowStep) {
    const std::vector<float> before = relief.nearness;
    const auto at = [&](int column, int row) {
      return before[relief.vertex(std::clamp(column, 0, relief.columns), std::clamp(row, 0, relief.rows))];
    };
    for (int row = 0; row <= relief.rows; ++row)
      for (int column = 0; column <= relief.columns; ++column)
        relief.nearness[relief.vertex(column, row)] = 0.5f * at(column, row) +
                                                      0.25f * at(column - columnStep, row - rowStep) +
                                                      0.25f * at(column + columnStep, row + rowStep);
  };
  blur(1, 0);
  blur(0, 1);
}

/// Of the pixels next to each vertex: means over cells would cover more ground. Cells together hold what
/// pixels do.
void takeOpticalDepths(Relief& relief, const glm::ivec2& size, const Cutting& cutting) {
  constexpr float kNext = 0.25f;  // of a cell
  const glm::vec2 cell = glm::vec2(size) / glm::vec2(relief.columns, relief.rows);
  for (int row = 0; row <= relief.rows; ++row)
    for (int column = 0; column <= relief.columns; ++column) {
      const glm::vec2 middle = cell * glm::vec2(column, row);
      const glm::ivec2 low =
                           glm::clamp(glm::ivec2(glm::round(middle - kNext * cell)), glm::ivec2(0), size - 1),
                       high = glm::clamp(glm::ivec2(glm::round(middle + kNext * cell)), low + 1, size);
      float sum = 0;
      for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) sum += cutting.at(x, y).opticalDepth;
      relief.opticalDepth.push_back(sum / static_cast<float>((high.x - low.x) * (high.y - low.y)));
    }
  double held = 0, wanted = 0;
  for (const auto& [column, row] : relief.shown)
    for (const auto& [right, down] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      held += 0.25 * static_cast<double>(cell.x * cell.y *
                                         relief.opticalDepth[relief.vertex(column + right, row + down)]);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) wanted += static_cast<double>(cutting.at(x, y).opticalDepth);
  for (float& one : relief.opticalDepth) one *= held > 0 ? static_cast<float>(wanted / held) : 0;
}

}  // namespace

Relief reliefOf(const image::ByteImage& picture, float surface, const Cutting& cutting, int cells) {
  constexpr float kLeastAlpha = 0.05f;  // mean, of what tells a place
  const glm::ivec2 size(picture.width, picture.height);
  const float step = static_cast<float>(std::max(size.x, size.y)) / static_cast<float>(cells);
  Relief relief;
  relief.columns = std::max(1, static_cast<int>(std::lround(static_cast<float>(size.x) / step)));
  relief.rows = std::max(1, static_cast<int>(std::lround(static_cast<float>(size.y) / step)));
  const glm::vec2 cell = glm::vec2(size) / glm::vec2(relief.columns, relief.rows);
  std::vector<bool> isKnown;
  for (int row = 0; row <= relief.rows; ++row)
    for (int column = 0; column <= relief.columns; ++column) {
      const glm::vec2 middle = cell * glm::vec2(column, row);
      const glm::ivec2 low = glm::max(glm::ivec2(glm::round(middle - 0.5f * cell)), 0),
                       high = glm::min(glm::ivec2(glm::round(middle + 0.5f * cell)), size);
      PaintedPixel sum;
      for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
          const PaintedPixel& pixel = cutting.at(x, y);
          sum.alpha += pixel.alpha;
          sum.nearness += pixel.nearness;
        }
      isKnown.push_back(sum.alpha > kLeastAlpha * cell.x * cell.y);
      relief.nearness.push_back(isKnown.back() ? sum.nearness / sum.alpha : 0);
    }
  fillGaps(relief, std::move(isKnown), surface);
  smoothen(relief);
  const auto isSeen = [&](int column, int row) {
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(cell * glm::vec2(column, row))) - 1, 0),
                     high = glm::min(glm::ivec2(glm::ceil(cell * glm::vec2(column + 1, row + 1))) + 1, size);
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; ++x)
        if (picture.bytes[4 * static_cast<std::size_t>(y * size.x + x) + 3] >= kSeenAlpha) return true;
    return false;
  };
  for (int row = 0; row < relief.rows; ++row)
    for (int column = 0; column < relief.columns; ++column)
      if (isSeen(column, row)) relief.shown.push_back({column, row});
  const auto nearness = [&](const std::array<int, 2>& at) {
    const std::size_t upper = relief.vertex(at[0], at[1]), lower = relief.vertex(at[0], at[1] + 1);
    return relief.nearness[upper] + relief.nearness[upper + 1] + relief.nearness[lower] +
           relief.nearness[lower + 1];
  };
  std::ranges::stable_sort(relief.shown, {}, nearness);
  takeOpticalDepths(relief, size, cutting);
  return relief;
}

}  // namespace cloudgen::writer
