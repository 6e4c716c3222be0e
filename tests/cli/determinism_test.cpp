// SPDX-License-Identifier: Apache-2.0
// The same command, the same bytes: twice, with any number of threads, and on another processor.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using Words = std::vector<std::string>;

class Determinism : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!forecast) GTEST_SKIP() << "the GFS forecast of python-grib-doc is not there";
  }

  /// What a build of one bay of the forecast writes.
  std::map<std::string, std::string> built(const std::string& name, const Words& more = {},
                                           const RunOptions& options = {}) const {
    Words words{"build",       *forecast, "--bbox", "-122.6,36.2,-121.2,37.2",
                "--max-puffs", "5000",    "-o",     folder.path() / name};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = runCloudgen(words, options);
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    return contentOf(folder.path() / name);
  }

  /// A build that all compare with.
  const std::map<std::string, std::string>& once() const {
    static const std::map<std::string, std::string> content = built("once");
    return content;
  }

  Scratch folder;
  std::optional<std::string> forecast = gfsForecast();
};

TEST_F(Determinism, TwiceTheSame) {
  ASSERT_GE(once().size(), 5u);
  EXPECT_EQ(differences(once(), built("again")), Words{});
}

TEST_F(Determinism, AnyNumberOfThreads) {
  EXPECT_EQ(differences(once(), built("one", {"--threads", "1"})), Words{});
  EXPECT_EQ(differences(once(), built("seven", {"--threads", "7"})), Words{});
}

TEST_F(Determinism, AnotherSeedIsAnotherSky) {
  const auto second = built("second", {"--seed", "2", "--formats", "splats"});
  EXPECT_NE(second.at("scene.splats.glb"), once().at("scene.splats.glb"));
}

// The C library has other versions of sin, exp and pow for processors without fused multiply-add, whose last
// bit may differ.
TEST_F(Determinism, AProcessorWithoutFusedMultiplyAdd) {
  const auto gallery = [&](const std::string& name, const RunOptions& options) {
    const Ran ran = runCloudgen({"build", CLOUDGEN_SOURCE_DIR "/examples/gallery/all.sky.json", "--max-puffs",
                                 "8000", "-o", folder.path() / name},
                                options);
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    return contentOf(folder.path() / name);
  };
  RunOptions older;  // the names of the features changed with glibc 2.33
  older.environment["GLIBC_TUNABLES"] =
      "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable,-FMA4_Usable";
  EXPECT_EQ(differences(once(), built("older", {}, older)), Words{});
  EXPECT_EQ(differences(gallery("gallery_here", {}), gallery("gallery_older", older)), Words{});
}

}  // namespace
