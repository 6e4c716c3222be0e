// SPDX-License-Identifier: Apache-2.0
// One sky of cumulus twice: as cloudgen writes it, and as in Murphy's thesis (one Billboard with a texture of
// its own for every puff). billboard_sky BILLBOARDS FOLDER; CLOUDGEN_DATA names the folder with textures/.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "base/error.hpp"
#include "light/color.hpp"
#include "support/small_scene.hpp"
#include "writer/x3d/x3d.hpp"

namespace cloudgen {
namespace {

constexpr int kPuffsPerCloud = 40, kKinds = 8;
constexpr double kCloudsPerSquareKilometer = 1;  // the thesis: 225 over 15 km by 15 km

/// As many clouds of 40 puffs as make so many billboards (one with fewer, if they are fewer), in 8 kinds and
/// 16 headings.
scene::Scene skyOf(int billboards) {
  const int clouds = std::max(1, billboards / kPuffsPerCloud), each = std::min(billboards, kPuffsPerCloud);
  const double side = 1000 * std::sqrt(clouds / kCloudsPerSquareKilometer), degree = 111195;
  const double latitude = side / degree, longitude = latitude / std::cos(46.1 * 3.14159265 / 180);
  scene::Scene sky{base::LocalFrame({7.0, 46.0, 7.0 + longitude, 46.0 + latitude})};
  sky.validTime = base::utcFromCivil(2011, 1, 15, 12);
  sky.sun = light::sunFrom(200, 35);
  sky.sky = light::skyUnder(sky.sun);
  sky.seed = 1;
  sky.provenance = {{"bench"}, "bench", "bench", ""};
  for (int kind = 0; kind < kKinds; ++kind) {
    const float width = 600.0f + 100.0f * static_cast<float>(kind);
    sky.archetypes.push_back(test::heap("Cu_" + std::to_string(kind), base::Genus::Cumulus, width,
                                        0.6f * width, each >= 5 ? 5 : 1, each));
  }
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> litOf;
  base::RandomStream random(sky.seed, 0, base::Purpose::Test, 9);
  for (int i = 0; i < clouds; ++i) {
    const auto kind = static_cast<std::uint32_t>(random.index(kKinds));
    const int yaw = static_cast<int>(random.index(scene::kYawSteps));
    const scene::Archetype& cloud = sky.archetypes[kind];
    const auto [known, isNew] = litOf.try_emplace({kind, yaw}, static_cast<std::uint32_t>(sky.lit.size()));
    if (isNew) {
      sky.lit.push_back({kind, yaw, test::simpleLight(cloud.puffs, cloud.bounds, sky.sun, yaw),
                         test::simpleLight(cloud.farPuffs, cloud.bounds, sky.sun, yaw)});
      sky.lit.back().onePuff = test::simpleLight({cloud.onePuff}, cloud.bounds, sky.sun, yaw).front();
    }
    const glm::vec3 place(random.uniform(0, side), 1000, -random.uniform(0, side));
    sky.instances.push_back({known->second, place});
    const glm::dvec3 where = sky.frame.toGeographic(glm::dvec3(place));
    sky.clouds.push_back({static_cast<std::uint64_t>(i), base::Genus::Cumulus, "bench", 0, where.x, where.y,
                          1000, 1000 + cloud.depthMeters, cloud.opticalDepth});
  }
  return sky;
}

/// What stands before the clouds is that of `ours`, so that both have the same ground, sky and viewpoints.
void writeThesisStyle(const scene::Scene& sky, const std::filesystem::path& ours,
                      const std::filesystem::path& file) {
  std::ifstream in(ours, std::ios::binary);
  std::string head{std::istreambuf_iterator<char>(in), {}};
  const auto clouds =
      std::min({head.find("\n<ProximitySensor"), head.find("\n<LOD"), head.find("\n<Transform scale")});
  std::ofstream out(file, std::ios::binary);
  out << head.substr(0, clouds);
  for (const scene::Instance& instance : sky.instances) {
    const scene::LitArchetype& lit = sky.lit[instance.lit];
    const scene::Archetype& cloud = sky.archetypes[lit.archetype];
    for (std::size_t i = 0; i < cloud.puffs.size(); ++i) {
      const shape::Puff puff = scene::placed(sky, instance, cloud.puffs[i]);
      const glm::vec3 color = light::srgbFromLinear(lit.puffs[i].color);
      const float half = 2.4f * puff.sigma.x, transparency = std::exp(-2.0f);
      const int column = puff.sprite % 4, row = puff.sprite / 4 % 4;
      const double u = 0.25 * column, v = 0.75 - 0.25 * row;
      out << fmt::format(
          "\n<Transform translation=\"{:.1f} {:.1f} {:.1f}\"><Billboard axisOfRotation=\"0 0 "
          "0\"><Shape><Appearance>"
          "<Material diffuseColor=\"0 0 0\" emissiveColor=\"{:.3f} {:.3f} {:.3f}\" transparency=\"{:.3f}\"/>"
          "<ImageTexture url='\"textures/cumulus.png\"'/></Appearance><IndexedFaceSet solid=\"false\" "
          "coordIndex=\"0 1 2 3 -1\" texCoordIndex=\"0 1 2 3 -1\"><Coordinate point=\"{:.1f} {:.1f} 0 {:.1f} "
          "{:.1f} 0 "
          "{:.1f} {:.1f} 0 {:.1f} {:.1f} 0\"/><TextureCoordinate point=\"{} {} {} {} {} {} {} {}\"/>"
          "</IndexedFaceSet></Shape></Billboard></Transform>",
          puff.center.x, puff.center.y, puff.center.z, color.r, color.g, color.b, transparency, -half, -half,
          half, -half, half, half, -half, half, u, v, u + 0.25, v, u + 0.25, v + 0.25, u, v + 0.25);
    }
  }
  out << "\n</Scene>\n</X3D>\n";
}

}  // namespace
}  // namespace cloudgen

int main(int argc, char** argv) {
  using namespace cloudgen;
  if (argc != 3 || std::atoi(argv[1]) < 1) {
    std::fprintf(stderr, "billboard_sky BILLBOARDS FOLDER\n");
    return 2;
  }
  try {
    const scene::Scene sky = skyOf(std::atoi(argv[1]));
    const std::filesystem::path folder(argv[2]);
    std::filesystem::create_directories(folder);
    writer::writeX3d(sky, {folder, {}});
    writeThesisStyle(sky, folder / "scene.x3d", folder / "thesis.x3d");
  } catch (const base::Error& error) {
    std::fprintf(stderr, "%s: %s (%s)\n", error.where().c_str(), error.problem().c_str(),
                 error.hint().c_str());
    return 1;
  }
}
