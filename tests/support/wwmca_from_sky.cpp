// SPDX-License-Identifier: Apache-2.0
// Writes a described sky as the cloud analysis that WWMCA would hold, both hemispheres:
//   wwmca_from_sky SKY.sky.json OUTDIR [--grib|--raw] [--little-endian]
#include <cstdio>
#include <exception>

#include "base/file.hpp"
#include "input/described/described.hpp"
#include "support/made_wwmca.hpp"

int main(int count, char** arguments) {
  using namespace cloudgen;
  bool raw = false, littleEndian = false, understood = count >= 3;
  for (int i = 3; i < count; ++i) {
    const std::string option = arguments[i];
    if (option == "--raw")
      raw = true;
    else if (option == "--little-endian")
      littleEndian = true;
    else if (option != "--grib")
      understood = false;
  }
  if (!understood) {
    std::fprintf(stderr, "usage: %s SKY.sky.json OUTDIR [--grib|--raw] [--little-endian]\n", arguments[0]);
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[2];
    std::filesystem::create_directories(folder);
    const auto sky = input::readDescribedSky(base::readFile(arguments[1]), arguments[1]);
    for (const bool south : {false, true}) {
      const test::MadeAnalysis analysis = test::sampled(*sky, south);
      if (raw)
        test::writeWwmcaRaw(analysis, folder, littleEndian ? std::endian::little : std::endian::big);
      else
        test::writeWwmcaGrib(analysis, folder);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
