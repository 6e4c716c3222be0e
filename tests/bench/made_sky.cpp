// SPDX-License-Identifier: Apache-2.0
// Writes the pack and the page of a made sky, for page.mjs: made_sky DIR CLOUDS PUFFS_A_CLOUD ARCHETYPES SIDE_KM
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "support/pack_scene.hpp"
#include "writer/page/page.hpp"

int main(int count, char** arguments) {
  using namespace cloudgen;
  if (count != 6) {
    std::fputs("usage: made_sky DIR CLOUDS PUFFS_A_CLOUD ARCHETYPES SIDE_KM\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    scene::Scene scene = test::wideSky(std::atoi(arguments[4]), std::atoi(arguments[3]), std::atoi(arguments[2]),
                                       1000 * static_cast<float>(std::atof(arguments[5])));
    // As many degrees as the sky is wide; the ground is at sea level.
    const double degrees = std::atof(arguments[5]) / 111;
    scene.frame = base::LocalFrame({-30, 0, -30 + degrees, degrees});
    scene.groundHeightMeters = 0;
    writer::writePack(scene, {folder, {}});
    writer::writePage(scene, {folder, {}});
  } catch (const base::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
