// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "writer/film/film.hpp"
#include "writer/x3d/node_writer.hpp"

namespace cloudgen::writer {

/// Plays a sky that moves in one file of a scene: Transforms that follow clouds, and Switches that leave out those
/// whose time it is not. Of a sky that stands still it writes nothing.
class FilmNodes {
 public:
  FilmNodes(NodeWriter& nodes, const Film& film) : nodes_(nodes), film_(film) {}

  /// Opens the Transform of a cloud as it stands when the film begins; it follows the cloud from then on.
  void openFollower(std::uint32_t instance, const scene::Instance& still);
  /// Opens what holds clouds that are there at the same time as this one. VRML97 has nothing that could leave them
  /// out: they stay, a thousandth as large.
  void openWhileThere(std::uint32_t instance);
  void closeWhileThere();
  /// Whether two clouds may be held together.
  bool areThereTogether(std::uint32_t a, std::uint32_t b) const {
    return !film_.moves() || spanOf(a) == spanOf(b);
  }
  /// At the root, after all clouds: the clock, what moves them, and the ROUTEs. The clocks of all files of a scene go
  /// alike: they count from the same second.
  void finish();

 private:
  /// The first and last key at which clouds are there.
  using Span = std::pair<std::uint32_t, std::uint32_t>;
  Span spanOf(std::uint32_t instance) const;
  bool hasSwitches() const { return film_.moves() && nodes_.encoding() != Encoding::Vrml97; }
  void interpolators(std::uint32_t instance);
  void interpolator(const std::string& def, std::span<const float> keys, std::span<const float> values, int decimals);
  void sequencer(const std::string& def, const Span& span);

  NodeWriter& nodes_;
  const Film& film_;
  std::map<std::uint32_t, std::vector<std::string>> followers_;  ///< DEFs of Transforms, by instance
  std::map<Span, std::vector<std::string>> switches_;            ///< DEFs
};

}  // namespace cloudgen::writer
