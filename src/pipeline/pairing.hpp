// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "field/cloud_table.hpp"
#include "field/source.hpp"

namespace cloudgen::pipeline {

/// What joining a cloud typing with a moisture model did, for the report. Covers are areas in square metres,
/// summed over layers.
struct Pairing {
  std::uint64_t typedColumns = 0;     ///< columns with a typed layer of known genus
  std::uint64_t agreeingColumns = 0;  ///< of these: the genera built are the genera typed
  std::uint64_t matchedLayers = 0;    ///< typed layers whose amount the model gives
  std::uint64_t typingAlone = 0;      ///< typed layers where the model has no cloud: the typing's own amount
  std::uint64_t modelAlone = 0;       ///< layers of the model that no typing speaks of: typed by rule
  double modelCover = 0;              ///< what the model has
  double keptCover = 0;               ///< what stands for it in the layers: equal, or as much as fits
  double addedCover = 0;              ///< of the typing alone
};

/// Layers of both on one grid, cell by cell, upwards.
struct PairedLayers {
  std::vector<field::Layer> layers;
  Pairing pairing;
};

/// How two grids lie to each other in a box, by a lattice of 32 x 32 places where the model has a cell.
struct Overlay {
  double typedShare = 0;     ///< of these places lie in a cell of the typing
  bool typingFiner = false;  ///< its cells are smaller there, on the mean

  /// Layers stand in the typing's cells where they are finer and all there; else in the model's, so that no
  /// cloud of the model is lost where the typing has nothing.
  bool standOnTyping() const { return typingFiner && typedShare == 1; }
};
Overlay overlayOf(const field::Grid& model, const field::Grid& typing, const base::GeoBox& box);

/// The box grown by the larger of both grids' cells, so that what happens at its border does not depend on
/// the crop; at most the whole Earth.
base::GeoBox grownBox(const field::Grid& model, const field::Grid& typing, const base::GeoBox& box);

/// Joins the thesis's pair: the typing decides genus and method, the model amount, density and fine
/// structure. A typed layer and a layer of the model are one cloud where they overlap in height or come
/// within 1000 m.
/// - Typing finer: each layer of a model cell gives its cover to the typed layers it meets there, in
///   proportion to theirs (none over 1), the rest to clear cells (or,
/// where none is clear, to cells typed otherwise); each keeps the typing's heights and takes
///   the model's optical depth. So cover and water of a model cell are conserved.
/// - Model finer: each of its layers takes the genus of the typed layer it meets; its amount stays.
/// - A typed layer that meets none keeps the typing's own amount; a layer of the model that meets none keeps
///   its own and is typed by rule, unless its column is typed: then by the nearest typed layer.
/// `modelLayers` are the layers of the model's cells, `typedLayers` those of the typing's; the grids' cells
/// are matched by their centres.
PairedLayers pairLayers(const field::Grid& model, const std::vector<field::Layer>& modelLayers,
                        const field::Grid& typing, const std::vector<field::Layer>& typedLayers,
                        bool typingFiner, const std::vector<std::uint32_t>& fineCells);

}  // namespace cloudgen::pipeline
