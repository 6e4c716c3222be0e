// SPDX-License-Identifier: Apache-2.0
#include "input/described/described.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "input/described/json_place.hpp"

namespace cloudgen::input {
namespace {

constexpr int kVersion = 1, kMostColumns = 2000;
constexpr std::size_t kMostLayers = 1000, kMostLayerCells = std::size_t{1} << 22;
constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;

/// A layer over some cells, or over all of them.
struct DescribedLayer {
  field::StatedLayer layer;
  bool everywhere = true;
  std::vector<std::uint32_t> cells;  ///< ascending

  bool covers(std::uint32_t cell) const {
    return everywhere || std::binary_search(cells.begin(), cells.end(), cell);
  }
};

struct Sky {
  field::SourceInfo info;
  field::Grid grid;
  std::optional<float> surfaceMeters;
  std::vector<DescribedLayer> layers;  ///< the lowest first
};

base::GeoBox boxOf(const JsonPlace& place) {
  place.count(4, 4);
  base::GeoBox box;
  box.west = place.element(0).number(-360, 360);
  box.south = place.element(1).number(-90, 90);
  box.east = place.element(2).number(-360, 360);
  box.north = place.element(3).number(-90, 90);
  const std::string order = "give [west, south, east, north] in degrees";
  if (box.south >= box.north) place.fail("has its south at or above its north", order);
  if (box.east - box.west >= 360) return {-180, box.south, 180, box.north};
  box.west = base::wrappedLongitude(box.west);
  box.east = base::wrappedLongitude(box.east);
  if (box.east == -180) box.east = 180;
  if (box.west == box.east) place.fail("has west and east on the same meridian", order);
  if (box.width() < 1e-6 || box.height() < 1e-6) place.fail("is smaller than a metre", order);
  return box;
}

/// Columns run east and rows run north, from the south-west corner.
field::Grid gridOf(const base::GeoBox& box, const std::optional<JsonPlace>& place) {
  field::Grid grid;
  grid.columns = grid.rows = 1;
  if (place) {
    place->onlyKeys({"columns", "rows"});
    grid.columns = place->at("columns").integer(1, kMostColumns);
    grid.rows = place->at("rows").integer(1, kMostColumns);
  }
  grid.stepX = box.width() / grid.columns;
  grid.stepY = box.height() / grid.rows;
  grid.firstX = box.west + 0.5 * grid.stepX;
  grid.firstY = box.south + 0.5 * grid.stepY;
  grid.wrapsLongitude = box.width() == 360;
  return grid;
}

std::pair<float, float> pairOf(const std::optional<JsonPlace>& place, double most) {
  if (!place) return {0.0f, 0.0f};
  place->count(2, 2);
  return {static_cast<float>(place->element(0).number(-most, most)),
          static_cast<float>(place->element(1).number(-most, most))};
}

std::vector<std::uint32_t> cellsOf(const JsonPlace& place, const field::Grid& grid) {
  std::vector<std::uint32_t> cells(place.count(1, grid.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const JsonPlace cell = place.element(i);
    cell.count(2, 2);
    cells[i] =
        grid.index(cell.element(0).integer(0, grid.columns - 1), cell.element(1).integer(0, grid.rows - 1));
  }
  std::sort(cells.begin(), cells.end());
  if (std::adjacent_find(cells.begin(), cells.end()) != cells.end())
    place.fail("names a cell twice", "name each cell once");
  return cells;
}

DescribedLayer layerOf(const JsonPlace& place, const field::Grid& grid) {
  place.onlyKeys({"genus", "cover", "base_m", "top_m", "optical_depth", "wind", "shear", "cells"});
  DescribedLayer described;
  field::StatedLayer& layer = described.layer;
  const JsonPlace genus = place.at("genus");
  const auto known = base::genusFromName(genus.text(32));
  if (!known) genus.fail("is no cloud genus", "give one of Ci, Cc, Cs, Ac, As, Ns, Sc, St, Cu, Cb, Fog");
  layer.genus = *known;
  layer.coverFraction = static_cast<float>(place.at("cover").number(0, 1));
  layer.baseMeters = static_cast<float>(place.at("base_m").number(-500, 25000));
  layer.topMeters = static_cast<float>(place.at("top_m").number(-500, 25000));
  if (layer.topMeters - layer.baseMeters < 1)
    place.at("top_m").fail("is not above base_m", "give a layer at least one metre deep");
  layer.opticalDepth = static_cast<float>(place.at("optical_depth").number(0.001, 1000));
  std::tie(layer.windEast, layer.windNorth) = pairOf(place.ifAny("wind"), 150);
  std::tie(layer.shearEast, layer.shearNorth) = pairOf(place.ifAny("shear"), 150);
  if (const auto cells = place.ifAny("cells")) {
    described.everywhere = false;
    described.cells = cellsOf(*cells, grid);
  }
  return described;
}

Sky skyOf(const JsonPlace& root, const std::string& where) {
  root.onlyKeys({"$schema", "cloudgen_sky", "title", "valid_time", "bbox", "grid", "surface_m", "layers"});
  root.at("cloudgen_sky").integer(kVersion, kVersion);
  Sky sky;
  sky.info.files = {where};
  sky.info.format = "described sky";
  const auto title = root.ifAny("title");
  sky.info.model = title ? title->text(200) : "described sky";
  const JsonPlace time = root.at("valid_time");
  const auto validTime = base::utcFromIso(time.text(40));
  if (!validTime) time.fail("is not a time", "give UTC as 2011-01-15T12:00:00Z");
  sky.info.validTime = *validTime;
  sky.info.validTimes = {*validTime};
  sky.grid = gridOf(boxOf(root.at("bbox")), root.ifAny("grid"));
  if (const auto surface = root.ifAny("surface_m"))
    sky.surfaceMeters = static_cast<float>(surface->number(-500, 9000));

  const JsonPlace layers = root.at("layers");
  const std::size_t count = layers.count(0, kMostLayers);
  std::size_t layerCells = 0;
  for (std::size_t i = 0; i < count; ++i) {
    DescribedLayer layer = layerOf(layers.element(i), sky.grid);
    layerCells += layer.everywhere ? sky.grid.size() : layer.cells.size();
    if (layerCells > kMostLayerCells)
      layers.fail(fmt::format("cover more than {} cells in all", kMostLayerCells),
                  "take a coarser grid or fewer layers");
    sky.info.fields.push_back(
        fmt::format("layer {}: {}, cover {:g}, {:g} to {:g} m, optical depth {:g}, {} of {} cells", i,
                    base::abbreviation(*layer.layer.genus), layer.layer.coverFraction, layer.layer.baseMeters,
                    layer.layer.topMeters, layer.layer.opticalDepth,
                    layer.everywhere ? sky.grid.size() : layer.cells.size(), sky.grid.size()));
    if (sky.surfaceMeters && layer.layer.baseMeters < *sky.surfaceMeters)
      layers.element(i).at("base_m").fail("lies below surface_m",
                                          "heights are above mean sea level, not above ground");
    sky.layers.push_back(std::move(layer));
  }
  std::stable_sort(sky.layers.begin(), sky.layers.end(),
                   [](const DescribedLayer& a, const DescribedLayer& b) {
                     return a.layer.baseMeters < b.layer.baseMeters;
                   });
  return sky;
}

class DescribedSource : public field::Source {
 public:
  explicit DescribedSource(Sky sky) : sky_(std::move(sky)) {}

  const field::SourceInfo& info() const override { return sky_.info; }
  const field::Grid& grid() const override { return sky_.grid; }
  field::Telling telling() const override { return field::Telling::Layers; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const field::Level&)>&) const override {}

  field::Surface surface(std::span<const std::uint32_t> cells) const override {
    if (!sky_.surfaceMeters) return {};
    field::Surface surface;
    surface.heightMeters.assign(cells.size(), *sky_.surfaceMeters);
    return surface;
  }

  void visitLayers(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::StatedLayer&)>& visit) const override {
    for (const std::uint32_t cell : cells)
      for (const DescribedLayer& described : sky_.layers)
        if (described.layer.coverFraction > 0 && described.covers(cell)) {
          field::StatedLayer layer = described.layer;
          layer.cell = cell;
          visit(layer);
        }
  }

 private:
  Sky sky_;
};

}  // namespace

bool isDescribedSky(std::string_view firstBytes) {
  const std::size_t first = firstBytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && firstBytes[first] == '{' &&
         firstBytes.find("\"cloudgen_sky\"") != std::string_view::npos;
}

std::unique_ptr<field::Source> readDescribedSky(std::string_view text, const std::string& where) {
  const nlohmann::json document = parseJson(text, where);
  return std::make_unique<DescribedSource>(skyOf(JsonPlace(document, where), where));
}

std::unique_ptr<field::Source> openDescribedSky(const std::vector<std::filesystem::path>& files,
                                                const OpenOptions&) {
  if (files.size() != 1)
    throw base::InputError(files.back().string(), "is a second described sky", "give one at a time");
  return readDescribedSky(base::readFile(files.front(), kMostBytes), files.front().string());
}

}  // namespace cloudgen::input
