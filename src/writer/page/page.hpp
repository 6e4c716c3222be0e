// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/format.hpp"

namespace cloudgen::writer {

/// The largest scene.splats.glb that is put into the page; a larger one is fetched from beside it, which
/// needs a web server.
inline constexpr std::uint64_t kLargestSplatsInPage = std::uint64_t{64} << 20;

/// Writes index.html: the bundled viewer with the folder's scene.splats.glb inside, which opens by
/// double-click. Throws NotBuiltError if the viewer was not bundled at build time, OutputError if the splats
/// are not there or the page cannot be written. `largestSplatsInPage` in bytes.
void writePage(const scene::Scene& scene, const Destination& destination, std::uint64_t largestSplatsInPage);
void writePage(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
