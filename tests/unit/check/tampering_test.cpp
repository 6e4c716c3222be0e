// SPDX-License-Identifier: Apache-2.0
// In every format that is read: a sky that shows its model passes, and one that somebody changed does not.
#include <gtest/gtest.h>

#include "unit/check/made_files.hpp"

namespace cloudgen::check::test {
namespace {

struct Form {
  const char* name;
  BlobKind kind;
  WrittenScene (*throughFile)(const WrittenScene&);
};

WrittenScene throughX3d(const WrittenScene& scene) { return readX3dScene(x3dOf(scene), "made.x3d"); }
WrittenScene throughGlb(const WrittenScene& scene) { return readGlbScene(glbOf(scene), "made.glb"); }
WrittenScene throughSplats(const WrittenScene& scene) {
  WrittenScene read = readSplatScene(splatsOf(scene), "made.splats.glb");
  read.clouds = scene.clouds;  // a record beside the splats, as X3D has it
  return read;
}

class Tampering : public testing::TestWithParam<Form> {
 protected:
  Fidelity verified() const {
    MadeSky read = sky;
    read.scene = GetParam().throughFile(sky.scene);
    return read.verified();
  }
  bool breaks(const std::string& measure) const {
    const Fidelity told = verified();
    return std::any_of(told.breaches.begin(), told.breaches.end(),
                       [&](const Breach& breach) { return breach.measure == measure; });
  }

  MadeSky sky{GetParam().kind};
};

TEST_P(Tampering, TheSkyItselfPasses) {
  const Fidelity told = verified();
  for (const Breach& breach : told.breaches) ADD_FAILURE() << breach.measure << " " << breach.value;
  EXPECT_EQ(told.genus.clouds, sky.scene.clouds.size());
  EXPECT_EQ(told.populatedCover.total.columns, 24u);
}

TEST_P(Tampering, ATenthOfTheCloudsRemoved) {
  WrittenScene kept = sky.scene;
  kept.blobs.clear(), kept.clouds.clear();
  for (std::size_t i = 0; i < sky.scene.blobs.size(); ++i)
    if (i % 10 != 3) kept.blobs.push_back(sky.scene.blobs[i]), kept.clouds.push_back(sky.scene.clouds[i]);
  sky.scene = kept;
  EXPECT_TRUE(breaks("cover.total.bias"));
  EXPECT_TRUE(breaks("optical_depth.bias_relative"));
}

TEST_P(Tampering, AllMovedByHalfACell) {
  const auto half = static_cast<float>(0.5 * field::cellSidesMeters(sky.model.grid(), 8).x);
  for (Blob& blob : sky.scene.blobs) blob.center.x += half;
  EXPECT_TRUE(breaks("cover.total.rmse"));
  EXPECT_TRUE(breaks("cover.populated.total.rmse"));
  EXPECT_TRUE(breaks("optical_depth.correlation"));
}

TEST_P(Tampering, OpticalDepthDoubled) {
  for (Blob& blob : sky.scene.blobs) blob.strength *= 2;
  EXPECT_TRUE(breaks("optical_depth.bias_relative"));
}

TEST_P(Tampering, TypesSwapped) {
  const auto swapped = [](base::Genus genus) {
    return genus == base::Genus::Cumulus ? base::Genus::Cirrus : base::Genus::Cumulus;
  };
  const auto clouds = sky.scene.clouds;
  for (const bool records : {true, false}) {
    sky.scene.clouds = clouds;
    for (WrittenCloud& cloud : sky.scene.clouds) {
      auto& genus = records ? cloud.recorded : cloud.drawn;
      genus = swapped(*genus);
    }
    EXPECT_TRUE(breaks("genus.agreement")) << (records ? "records" : "sprites");
  }
}

TEST_P(Tampering, CloudsRaised) {
  for (Blob& blob : sky.scene.blobs) blob.center.y += 300;
  EXPECT_TRUE(breaks("base_m.rmse"));
  EXPECT_TRUE(breaks("top_m.rmse"));
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, Tampering,
                         testing::Values(Form{"x3d", BlobKind::Card, throughX3d},
                                         Form{"glb", BlobKind::Card, throughGlb},
                                         Form{"splats", BlobKind::Volume, throughSplats}),
                         [](const auto& form) { return form.param.name; });

}  // namespace
}  // namespace cloudgen::check::test
