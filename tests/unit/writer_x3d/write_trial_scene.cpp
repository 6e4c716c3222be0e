// SPDX-License-Identifier: Apache-2.0
// Writes a scene with one cloud of each kind (heap, tower, broken sheet, veil, fibres) in every encoding of
// this room, to be looked at in viewers. CLOUDGEN_DATA names the folder with textures/.
#include <cstdio>

#include "base/error.hpp"
#include "support/small_scene.hpp"
#include "writer/x3d/x3d.hpp"

int main(int argc, char** argv) {
  using namespace cloudgen;
  if (argc < 2) {
    std::fprintf(stderr, "write_trial_scene FOLDER [CLOUDS [KINDS]], kinds as in 01234\n");
    return 2;
  }
  try {
    const std::vector<scene::Archetype> all{
        test::heap("Cu_1", base::Genus::Cumulus, 1800, 1100, 5, 220),
        test::heap("Cb_1", base::Genus::Cumulonimbus, 5000, 7000, 6, 300),
        test::sheet("Sc_1", base::Genus::Stratocumulus, 5000, 500, 120, 1, 0.6f, 4),
        test::sheet("As_1", base::Genus::Altostratus, 7000, 500, 60, 1.5f, 0.15f, 1),
        test::sheet("Ci_1", base::Genus::Cirrus, 6000, 500, 60, 5, 0.12f, 0.3f)};
    std::vector<scene::Archetype> chosen;
    for (const char kind : std::string(argc > 3 ? argv[3] : "01234"))
      chosen.push_back(all.at(static_cast<size_t>(kind - '0')));
    const scene::Scene scene = test::sceneOf(chosen, argc > 2 ? std::atoi(argv[2]) : 40);
    std::filesystem::create_directories(argv[1]);
    const writer::Destination destination{argv[1], {}};
    writer::writeX3d(scene, destination);
    writer::writeClassicVrml(scene, destination);
    writer::writeVrml97(scene, destination);
  } catch (const base::Error& error) {
    std::fprintf(stderr, "%s: %s (%s)\n", error.where().c_str(), error.problem().c_str(),
                 error.hint().c_str());
    return 1;
  }
}
