// SPDX-License-Identifier: Apache-2.0
#include "cli/fidelity_maps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <optional>

#include "base/frame.hpp"
#include "image/picture.hpp"

namespace cloudgen::cli {
namespace {

constexpr int kPanelPixels = 360, kGapPixels = 6;  ///< longer side of a panel; between two
constexpr glm::vec3 kNothing(0.55f), kGap(0.2f);

using Value = std::function<std::optional<double>(const check::ComparedColumn&)>;

struct Measure {
  std::string name;
  Value model, scene;
  double greatest = 1;        ///< white
  double fullDifference = 1;  ///< full red
  double power = 1;           ///< of values, for what spans decades
};

glm::vec3 toneOf(double share) {
  const auto t = static_cast<float>(std::clamp(share, 0.0, 1.0));
  return glm::mix(glm::vec3(0.05f, 0.12f, 0.32f), glm::vec3(1), t);
}

glm::vec3 differenceTone(double share) {
  const auto t = static_cast<float>(std::clamp(share, -1.0, 1.0));
  return glm::mix(glm::vec3(1), t > 0 ? glm::vec3(0.75f, 0.05f, 0.1f) : glm::vec3(0.05f, 0.2f, 0.75f),
                  std::abs(t));
}

std::vector<Measure> measuresOf(const check::Fidelity& fidelity) {
  double deepest = 1, highest = 1000;
  for (const check::ComparedColumn& column : fidelity.columns) {
    deepest = std::max(deepest, column.model.view.opticalDepth);
    highest = std::max(highest, column.model.view.topMeters.value_or(0));
  }
  std::vector<Measure> measures{{"cover", [](const auto& c) { return c.model.view.cover; },
                                 [](const auto& c) { return c.scene.cover; }, 1, 0.5, 1}};
  const char* names[]{"cover_low", "cover_middle", "cover_high"};
  for (std::size_t range = 0; range < check::kRanges; ++range)
    measures.push_back({names[range], [range](const auto& c) { return c.model.view.coverIn[range]; },
                        [range](const auto& c) { return c.scene.coverIn[range]; }, 1, 0.5, 1});
  measures.push_back({"optical_depth", [](const auto& c) { return c.model.view.opticalDepth; },
                      [](const auto& c) { return c.scene.opticalDepth; }, deepest, 0.5 * deepest, 0.5});
  measures.push_back({"base", [](const auto& c) { return c.model.view.baseMeters; },
                      [](const auto& c) { return c.scene.baseMeters; }, highest, 1000, 1});
  measures.push_back({"top", [](const auto& c) { return c.model.view.topMeters; },
                      [](const auto& c) { return c.scene.topMeters; }, highest, 1000, 1});
  return measures;
}

/// Which compared column a pixel of a panel shows; -1: none. Row by row from the north.
struct Panel {
  int width = 0, height = 0;
  std::vector<int> columns;
};

Panel panelOf(const check::Fidelity& fidelity, const field::Grid& grid, const base::GeoBox& box) {
  std::map<std::uint32_t, int> columnOf;
  for (std::size_t i = 0; i < fidelity.columns.size(); ++i)
    columnOf[fidelity.columns[i].model.cell] = static_cast<int>(i);
  const double across = box.width() * std::cos(box.centerLatitude() * 0.017453292519943295),
               longer = std::max(across, box.height());
  Panel panel;
  const auto pixels = [&](double part) {
    return std::max(8, static_cast<int>(std::lround(kPanelPixels * part / longer)));
  };
  panel.width = pixels(across);
  panel.height = pixels(box.height());
  const field::CellFinder finder(grid);
  for (int y = 0; y < panel.height; ++y)
    for (int x = 0; x < panel.width; ++x) {
      const auto cell = finder.at({base::wrappedLongitude(box.west + (x + 0.5) / panel.width * box.width()),
                                   box.north - (y + 0.5) / panel.height * box.height()});
      const auto found = cell ? columnOf.find(*cell) : columnOf.end();
      panel.columns.push_back(found == columnOf.end() ? -1 : found->second);
    }
  return panel;
}

image::Picture drawn(const check::Fidelity& fidelity, const Panel& panel, const Measure& measure) {
  image::Picture picture(3 * panel.width + 2 * kGapPixels, panel.height);
  std::fill(picture.pixels.begin(), picture.pixels.end(), kGap);
  const auto shown = [&](const std::optional<double>& value) {
    return value ? toneOf(std::pow(std::max(0.0, *value) / measure.greatest, measure.power)) : kNothing;
  };
  for (int y = 0; y < panel.height; ++y)
    for (int x = 0; x < panel.width; ++x) {
      const int index = panel.columns[static_cast<std::size_t>(y * panel.width + x)];
      std::optional<double> model, scene;
      if (index >= 0) {
        model = measure.model(fidelity.columns[static_cast<std::size_t>(index)]);
        scene = measure.scene(fidelity.columns[static_cast<std::size_t>(index)]);
      }
      const int step = panel.width + kGapPixels;
      picture.at(x, y) = shown(model);
      picture.at(x + step, y) = shown(scene);
      picture.at(x + 2 * step, y) =
          model && scene ? differenceTone((*scene - *model) / measure.fullDifference) : kNothing;
    }
  return picture;
}

}  // namespace

std::vector<std::string> writeFidelityMaps(const check::Fidelity& fidelity, const field::Grid& grid,
                                           const base::GeoBox& box, const std::filesystem::path& folder) {
  const Panel panel = panelOf(fidelity, grid, box);
  std::vector<std::string> names;
  for (const Measure& measure : measuresOf(fidelity)) {
    names.push_back(measure.name + ".png");
    image::writePng(folder / names.back(), drawn(fidelity, panel, measure));
  }
  return names;
}

}  // namespace cloudgen::cli
