// SPDX-License-Identifier: Apache-2.0
#include <openvdb/openvdb.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "input/volume/coarse_volume.hpp"
#include "input/volume/volume_file.hpp"
#include "support/made_netcdf.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {
namespace {

using test::Scratch;

double sumOf(const base::Volume& volume) {
  double sum = 0;
  for (const float value : volume.extinction) sum += value;
  return sum;
}

TEST(CoarseVolume, KeepsTheIntegral) {
  CoarseVolume coarse({100, 50, 200}, {0.1, 5, 2});
  coarse.add({10, 0, 20}, {30.3, 7, 21}, 3);
  const base::Volume volume = std::move(coarse).volume();
  EXPECT_EQ(volume.size, glm::ivec3(64, 10, 64));
  EXPECT_NEAR(sumOf(volume) * volume.spacing.x * volume.spacing.y * volume.spacing.z, 3 * 20.3 * 7 * 1, 1e-3);
}

/// A file of one grid: a box of 4 x 6 x 10 voxels of 20 m, its upper (last) y half twice as dense.
std::string vdbFile(const Scratch& folder, const std::string& name) {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(0);
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(20));
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 10; ++z) grid->tree().setValue({x - 100, y + 7, z}, y < 3 ? 1.0f : 2.0f);
  const std::string file = folder.path() / "cloud.vdb";
  openvdb::io::File(file).write({grid});
  return file;
}

TEST(Volume, OpenVdb) {
  Scratch folder;
  const std::string file = vdbFile(folder, "smoke");
  EXPECT_TRUE(isVolumeFile(file));
  for (const char* name : {"", "smoke"}) {
    const base::Volume volume = readVolume(file, name, false);
    ASSERT_EQ(volume.size, glm::ivec3(4, 6, 10));
    EXPECT_NEAR(volume.spacing.y, 20, 1e-6);
    EXPECT_FLOAT_EQ(volume.extinction[volume.at({0, 0, 0})], 1);
    EXPECT_FLOAT_EQ(volume.extinction[volume.at({3, 5, 9})], 2);
  }
  const base::Volume upright = readVolume(file, "", true);
  ASSERT_EQ(upright.size, glm::ivec3(4, 10, 6));
  EXPECT_FLOAT_EQ(upright.extinction[upright.at({0, 0, 0})], 2) << "the file's last y is north, -z";
  EXPECT_THROW(readVolume(file, "fire", false), base::InputError);
}

TEST(Volume, DamagedOpenVdbIsRefused) {
  Scratch folder;
  EXPECT_THROW(readVolume(folder.write("words.vdb", "these are words"), "", false), base::InputError);
  const std::string whole = base::readFile(vdbFile(folder, "smoke"));
  EXPECT_THROW(readVolume(folder.write("cut.vdb", whole.substr(0, whole.size() / 2)), "", false),
               base::InputError);
  EXPECT_THROW(readVolume(folder.path() / "none.vdb", "", false), base::InputError);
}

TEST(Volume, BoxOfALargeEddySimulation) {
  test::NetcdfFile box;
  box.dimensions = {{"time", 2}, {"z", 3}, {"y", 2}, {"x", 4}};
  std::vector<double> water(48, 0.0);
  water[0] = 1e-3;          // the first level's south-west corner
  water[8 * 2 + 4] = 8e-3;  // the third level's north-west corner
  box.variables = {{"z", {"z"}, {{"units", "km"}}, {0.5, 0.6, 0.8}},
                   {"x", {"x"}, {{"units", "m"}}, {0, 50, 100, 150}},
                   {"T",
                    {"time", "z", "y", "x"},
                    {{"standard_name", "air_temperature"}, {"units", "K"}},
                    std::vector<double>(48, 280.0)},
                   {"QC",
                    {"time", "z", "y", "x"},
                    {{"standard_name", "mass_fraction_of_cloud_liquid_water_in_air"}, {"units", "kg kg-1"}},
                    water}};
  Scratch folder;
  const std::string file = folder.path() / "les.nc";
  test::writeNetcdf(file, box);
  const base::Volume volume = readVolume(file, "", false);
  EXPECT_EQ(volume.size, glm::ivec3(4, 4, 2)) << "levels of 100, 150 and 150 m in cells of 100 m";
  EXPECT_NEAR(volume.spacing.x, 50, 1e-6);
  const float low = volume.extinction[volume.at({0, 0, 1})], high = volume.extinction[volume.at({0, 3, 0})];
  EXPECT_GT(low, 0) << "south is +z";
  EXPECT_NEAR(high / low, 4, 1e-3) << "extinction ~ water^(2/3)";
  EXPECT_THROW(readVolume(file, "QR", false), base::InputError);
  EXPECT_NO_THROW(readVolume(file, "T", false));
}

}  // namespace
}  // namespace cloudgen::input
