// SPDX-License-Identifier: Apache-2.0
// Pictures of what was written.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/read_png.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;

class Look : public ::testing::Test {
 protected:
  /// Mean luminance (Rec. 709 weights of the display-encoded values) of a gallery sky, 0..1.
  double luminance(const std::string& name, const std::string& view, int puffs) const {
    const std::string scene = folder.path() / "scene", picture = folder.path() / "picture.png";
    const Ran built = runCloudgen({"build", CLOUDGEN_SOURCE_DIR "/examples/gallery/" + name + ".sky.json", "-o", scene,
                                   "--formats", "splats", "--sun", "235,38", "--max-puffs", std::to_string(puffs), "--overwrite"});
    EXPECT_EQ(built.exitCode, 0) << built.err;
    const Ran seen = runCloudgen({"preview", scene, "-o", picture, "--size", "96x54", "--view=" + view, "--draft"});
    EXPECT_EQ(seen.exitCode, 0) << seen.err;
    const auto image = readPng(picture);
    double sum = 0;
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i + 2 < image.bytes.size(); i += channels)
      sum += 0.2126 * image.bytes[i] + 0.7152 * image.bytes[i + 1] + 0.0722 * image.bytes[i + 2];
    return sum * static_cast<double>(channels) / (255.0 * static_cast<double>(image.bytes.size()));
  }

  Scratch folder;
};

// The budget decides how sharp a cloud is, not how bright.
TEST_F(Look, TwiceOrHalfThePuffsAreAsBright) {
  const std::pair<const char*, const char*> views[] = {
      {"cumulus", "-122.0,36.70,1600:-122.0,36.84,1700"},
      {"stratocumulus", "-122.0,36.66,4200:-122.0,36.85,1000"},
      {"cirrus", "-122.0,36.72,20:-122.0,36.84,7500"},
      {"cumulonimbus", "-122.0,36.62,30:-121.99,36.80,6500"}};
  for (const auto& [name, view] : views) {
    const double usual = luminance(name, view, 20000);
    EXPECT_NEAR(luminance(name, view, 10000) / usual, 1, 0.05) << name;
    EXPECT_NEAR(luminance(name, view, 40000) / usual, 1, 0.05) << name;
  }
}

}  // namespace
