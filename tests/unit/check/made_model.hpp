// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "check/fidelity/fidelity.hpp"
#include "field/source.hpp"

namespace cloudgen::check::test {

/// A model that states one layer or more a cell of a latitude-longitude grid of 6 x 4 cells of 0.5 degrees.
class MadeModel : public field::Source {
 public:
  MadeModel() {
    grid_.columns = 6, grid_.rows = 4;
    grid_.stepX = grid_.stepY = 0.5;
    grid_.firstX = 10.25, grid_.firstY = 50.25;
    info_.files = {"made"};
  }
  base::GeoBox box() const { return {10, 50, 13, 52}; }
  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return grid_; }
  field::Telling telling() const override { return field::Telling::Layers; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const field::Level&)>&) const override {}
  void visitLayers(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::StatedLayer&)>& visit) const override {
    for (const std::uint32_t cell : cells)
      for (const field::StatedLayer& layer : layers)
        if (layer.cell == cell) visit(layer);
  }

  std::vector<field::StatedLayer> layers;

 private:
  field::SourceInfo info_;
  field::Grid grid_;
};

/// What a cloud of the made scene is: a round Gaussian blob, or a level square card, whose column integral is
/// kPeak at its middle.
inline constexpr double kPeak = 6;

/// A model whose cells have cover by turns 0.5 and 0.2, with optical depths, bases, depths and genera that
/// differ, and a scene of 12 x 19 clouds a cell that shows just that; the clouds of a cell lie on a lattice
/// and do not overlap.
struct MadeSky {
  MadeModel model;
  base::LocalFrame frame;
  WrittenScene scene;

  explicit MadeSky(BlobKind kind = BlobKind::Volume);
  Fidelity verified() const;
};

}  // namespace cloudgen::check::test
