// SPDX-License-Identifier: Apache-2.0
// Files that lie: errors that name the file, no crash, no flood of memory.
#include <cmath>
#include <fstream>
#include <iterator>

#include "input/catalogue.hpp"
#include "input/trial.hpp"
#include "netcdf_cases.hpp"

namespace cloudgen {
namespace {

using test::contentsOf;
using test::NetcdfFile;
using test::plainFile;

std::string bytesOf(const NetcdfFile& file) {
  const test::Scratch scratch;
  test::writeNetcdf(scratch.path() / "made.nc", file);
  std::ifstream stream(scratch.path() / "made.nc", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(NetcdfHostile, RecognisedByContent) {
  const test::Scratch scratch;
  EXPECT_TRUE(input::isNetcdf(bytesOf(plainFile())));
  EXPECT_FALSE(input::isNetcdf("CDF"));
  EXPECT_FALSE(input::isNetcdf("GRIB"));
  // The word GRIB stands in the headers of files made by cfgrib.
  NetcdfFile file = plainFile();
  file.texts["history"] = "GRIB to CDM+CF via cfgrib";
  file.format = 0;
  test::writeNetcdf(scratch.path() / "made.nc", file);
  EXPECT_TRUE(input::open({scratch.path() / "made.nc"})->info().format.starts_with("NetCDF"));
}

TEST(NetcdfHostile, CutShortAnywhere) {
  const test::Scratch scratch;
  NetcdfFile file = plainFile();
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
    file.format = format;
    const std::string bytes = bytesOf(file);
    // The last variable is aligned to 8 bytes already: every byte is needed.
    for (std::size_t length = 4; length < bytes.size(); length += 7) {
      const auto cut = scratch.write("cut.nc", std::string_view(bytes).substr(0, length));
      ASSERT_THROW(input::openNetcdf({cut}, {}), base::InputError) << format << " at " << length;
    }
  }
}

TEST(NetcdfHostile, EveryByteFlippedIsReadOrRefused) {
  const test::Scratch scratch;
  for (const int format : {0, NC_NETCDF4}) {
    NetcdfFile file = plainFile();
    file.format = format;
    const std::string bytes = bytesOf(file);
    const std::size_t step = format == 0 ? 3 : 197;
    for (std::size_t place = 4; place < bytes.size(); place += step) {
      std::string broken = bytes;
      broken[place] = static_cast<char>(~broken[place]);
      const auto path = scratch.write("broken.nc", broken);
      try {
        const auto source = input::openNetcdf({path}, {});
        if (source->grid().size() < 1000)
          source->visitLevels(field::everyCell(source->grid()), [](const field::Level&) {});
      } catch (const base::InputError&) {
      }
    }
  }
}

TEST(NetcdfHostile, ANameBeyondItsLimitIsRefused) {
  const test::Scratch scratch;
  NetcdfFile file = plainFile();
  file.format = 0;
  std::string bytes = bytesOf(file);
  // The length of the first dimension's name follows the magic, the records and the list's head.
  ASSERT_EQ(bytes.substr(16, 8), std::string("\0\0\0\4time", 8));
  bytes.replace(16, 8, std::string("\0\0\1\x20", 4) + std::string(0x120, 'a'));
  EXPECT_THROW(input::openNetcdf({scratch.write("long.nc", bytes)}, {}), base::InputError);
}

TEST(NetcdfHostile, AbsurdSizesCostNothing) {
  NetcdfFile file = plainFile();
  file.dimensions.push_back({"huge", 1'000'000'000'000});
  file.dimensions.push_back({"vast", 1'000'000'000});
  file.variables.push_back({"qi", {"time", "level", "huge", "vast"}, {{"units", "1"}}, {}});
  file.variables.push_back({"huge", {"huge"}, {{"units", "degrees_north"}}, {}});
  file.variables.push_back({"vast", {"vast"}, {{"units", "degrees_east"}}, {}});
  for (const char* name : {"qi", "huge", "vast"}) file.variable(name).chunked = true;
  const auto contents = contentsOf(file);
  EXPECT_EQ(test::fieldsOf(contents, field::Quantity::CloudLiquid).size(), 4u);
  for (const auto* field : test::fieldsOf(contents, field::Quantity::CloudIce))
    EXPECT_THROW(contents.grids.at(field->grid)(), base::InputError);
}

TEST(NetcdfHostile, CoordinatesThatNameEachOther) {
  NetcdfFile file = plainFile();
  file.variable("lat").texts["bounds"] = "lat";
  file.variable("lon").texts["bounds"] = "lat";
  file.variable("lat").texts["coordinates"] = "lon clwc";
  file.variable("lon").texts["coordinates"] = "lat";
  file.variable("clwc").texts["coordinates"] = "clwc level lat lon";
  file.variable("clwc").texts["grid_mapping"] = "clwc";
  file.variable("level").texts["formula_terms"] = "a: level b: level ps: level p0: level";
  EXPECT_EQ(test::fieldsOf(contentsOf(file), field::Quantity::CloudLiquid).size(), 4u);
}

TEST(NetcdfHostile, CoordinatesThatMakeNoSenseAreRefused) {
  const auto refused = [](const std::string& name, std::vector<double> values) {
    NetcdfFile file = plainFile();
    file.variable(name).values = std::move(values);
    const auto contents = contentsOf(file);
    EXPECT_THROW(contents.grids.at(0)(), base::InputError) << name;
  };
  refused("lat", {50, 50, 46});
  refused("lat", {50, 46, 48});
  refused("lat", {150, 148, 146});
  refused("lon", {10, 12, std::nan(""), 16});
  refused("lon", {1e300, 12, 14, 16});
}

TEST(NetcdfHostile, NothingAboutCloudsIsSaid) {
  const test::Scratch scratch;
  NetcdfFile file = plainFile();
  file.variable("clwc").name = "sst";
  test::writeNetcdf(scratch.path() / "made.nc", file);
  EXPECT_THROW(input::openNetcdf({scratch.path() / "made.nc"}, {}), base::InputError);
}

TEST(NetcdfHostile, ACrashOfTheLibraryIsAnError) {
  EXPECT_NO_THROW(input::tryInChild("a.nc", "HDF5", [] {}));
  EXPECT_NO_THROW(input::tryInChild("a.nc", "HDF5", [] { throw 1; }));
  EXPECT_THROW(input::tryInChild("a.nc", "HDF5", [] { std::abort(); }), base::InputError);
}

}  // namespace
}  // namespace cloudgen
