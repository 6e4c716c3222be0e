// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/format.hpp"

namespace cloudgen::writer {

/// The largest scene.cgpack that is put into the page; a larger one is fetched from beside it, which needs a
/// web server.
inline constexpr std::uint64_t kLargestPackInPage = std::uint64_t{64} << 20;

/// Writes index.html: the bundled viewer with the folder's scene.cgpack inside, which opens by double-click.
/// Throws NotBuiltError if the viewer was not bundled at build time, OutputError if the pack
/// is not there or the page cannot be written. `largestPackInPage` in bytes.
void writePage(const scene::Scene& scene, const Destination& destination, std::uint64_t largestPackInPage);
void writePage(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
