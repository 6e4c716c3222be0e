// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/frame.hpp"
#include "base/genus.hpp"
#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/footprint.hpp"
#include "shape/blending.hpp"

namespace cloudgen::pipeline {

using shape::kCoveringOpticalDepth;

/// A cloud as it is painted.
struct Stamp {
  ArchetypeKey key;
  glm::dvec2 place{0};  ///< x and z of the scene
  double widthMeters = 0, depthMeters = 0, yawRadians = 0;
  double extinctionArea = 0;  ///< integral of extinction over space, m2
  float baseMeters = 0, topMeters = 0;
  const Footprint* footprint = nullptr;  ///< of the key
};

/// A layer of a cell on the canvas: what it should show and what it shows, in pixels.
struct PaintedLayer {
  std::uint32_t layer = 0;  ///< index in the table
  float baseMeters = 0, topMeters = 0;
  float zoneLowerMeters = 0, zoneUpperMeters = 0;  ///< a little further, at most half-way to the next
  bool covers = true;                              ///< false for layers too thin to cover anything
  double wantedCover = 0, wantedOpticalDepth = 0;
  int covered = 0;
  double opticalDepth = 0;
};

/// A model cell on the canvas. Its layers are layers()[firstLayer .. + layerCount); one more stands after
/// them for what strays in at heights where the cell has no cloud: it should show nothing.
struct PaintedCell {
  std::uint32_t cell = 0;         ///< grid index
  int pixels = 0;                 ///< inside the box
  int covered = 0;                ///< by any layer
  double wantedOpticalDepth = 0;  ///< of all layers together, as theirs
  std::uint32_t firstLayer = 0, layerCount = 0;
  std::uint32_t firstPixel = 0;  ///< in the canvas' list by cell
  glm::dvec2 middle{0};          ///< of what of it is inside the box
};

/// What one stamp would change.
struct Stroke {
  struct Dab {
    std::size_t value;  ///< index of the value of a plane at a pixel
    std::uint32_t pixel;
    float opticalDepth;
  };
  struct Touched {        ///< those of one cell one after the other
    std::uint32_t cell;   ///< index in Canvas::cells()
    std::uint32_t layer;  ///< index in Canvas::layers()
    std::uint32_t part;   ///< index in parts; in its cell's first
    float share;          ///< of the stamp's optical depth
    int coveredChange;
    int coveredByAnyChange;  ///< of the cell; in its first
    double opticalDepth;
  };
  struct Part {          ///< what of the stamp lies over one cell
    std::uint32_t cell;  ///< index in Canvas::cells()
    double opticalDepth = 0;
    double mean = 0, square = 0;  ///< of heights above its base, in its widths, and of their squares
  };
  base::Genus genus = base::Genus::Cumulus;  ///< of the stamp
  float baseMeters = 0;                      ///< of the stamp
  double widthMeters = 0;                    ///< of the stamp
  std::vector<Dab> dabs;
  std::vector<Touched> touched;
  std::vector<Part> parts;
};

/// The whole scene seen from above on a raster: the optical depth of each layer of each cell, and what of it
/// is covered. A cloud that reaches into the next cell counts there for the layers at its own heights, or
/// astray, each with the part of it that is there.
class Canvas {
 public:
  /// `cells`: those of the box, ascending; `layers` of them. pixelMeters is made larger where the box would
  /// take more than four million pixels (fewer where cells have many layers).
  Canvas(const field::Grid& grid, const base::LocalFrame& frame, std::span<const std::uint32_t> cells,
         std::span<const field::Layer> layers, double pixelMeters);

  double pixelSquareMeters() const { return pixelMeters_ * pixelMeters_; }
  const std::vector<PaintedCell>& cells() const { return cells_; }
  const std::vector<PaintedLayer>& layers() const { return layers_; }
  /// Index in cells() of a grid cell.
  std::uint32_t indexOf(std::uint32_t cell) const;

  /// The stroke of a stamp: where it lies, and what adding it (sign 1) or taking it away (-1) changes.
  void brush(const Stamp& stamp, float sign, Stroke& stroke);
  void paint(const Stroke& stroke);
  /// As if nothing had been painted.
  void clear();
  /// Middles of the pixels of a cell, row by row: all; those that one of its layers does not cover.
  std::vector<glm::dvec2> placesIn(const PaintedCell& cell) const;
  std::vector<glm::dvec2> gapsOf(const PaintedCell& cell, const PaintedLayer& layer) const;
  /// True if a layer other than this covers the place.
  bool coveredByOthers(const glm::dvec2& place, const PaintedLayer& layer) const;

 private:
  void assignPixels(const field::Grid& grid, const base::LocalFrame& frame);
  void gatherLayers(std::span<const field::Layer> layers);
  std::span<const std::uint32_t> pixelsOf(const PaintedCell& cell) const {
    return std::span(pixelsByCell_).subspan(cell.firstPixel, static_cast<std::size_t>(cell.pixels));
  }
  glm::dvec2 middleOf(std::uint32_t pixel) const;
  void divideHeights(const PaintedCell& cell);
  /// Adds what a stamp touches of a cell.
  void touch(std::uint32_t cell, const Stamp& stamp, std::vector<Stroke::Touched>& touched) const;

  glm::dvec2 lower_{0};
  double pixelMeters_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<PaintedCell> cells_;
  std::vector<PaintedLayer> layers_;
  std::vector<std::int32_t> cellOf_;           ///< a pixel's, -1 outside the box
  std::vector<std::uint32_t> pixelsByCell_;    ///< those of a cell one after the other
  std::vector<std::uint16_t> coveringPlanes_;  ///< of a pixel
  std::vector<std::uint32_t>
      touchedAs_;  ///< of a cell: its place in the stroke that was brushed last, if it is there
  std::size_t planes_ = 1;
  std::vector<float> values_;  ///< plane by plane
  struct Sample {
    std::uint32_t pixel = 0;
    float share = 0;
    HeightMoments heights;
  };
  /// What the samples of a stamp depend on.
  struct Lie {
    double x, z, widthMeters, yawRadians;
    const Footprint* footprint;
    bool operator==(const Lie&) const = default;
  };
  struct HashOfLie {
    std::size_t operator()(const Lie& lie) const;
  };
  struct Kept {
    std::size_t first = 0, count = 0;
  };
  /// The pixels that a stamp meets, and the share of it that each gets. Where pixels are coarse their middles
  /// meet a cloud by chance: all of them together get all of it, those beyond the canvas included.
  void sample(const Stamp& stamp);
  /// The same, looked up where the stamp was brushed before. Valid until the next call.
  std::span<const Sample> samplesOf(const Stamp& stamp);
  std::vector<Sample> samples_;
  std::vector<Sample> kept_;  ///< of stamps that were brushed, as many as are worth the memory
  std::unordered_map<Lie, Kept, HashOfLie> keptOf_;
};

}  // namespace cloudgen::pipeline
