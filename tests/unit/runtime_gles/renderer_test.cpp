// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/renderer.hpp"

#include <cstdlib>

#include "support/gles_picture.hpp"
#include "support/made_pack.hpp"
#include "support/similarity.hpp"

namespace cloudgen::runtime::gles {
namespace {

constexpr int kWidth = 320, kHeight = 180;

/// Ten heaps under the sky.
const scene::Scene& heaps() {
  static const scene::Scene scene = [] {
    scene::Scene made = test::wideSky(4, 60, 10, 9000);
    for (scene::Instance& cloud : made.instances) cloud.position.y = 900;
    return made;
  }();
  return scene;
}

Camera fromTheGround() {
  Camera camera;
  camera.eye = {4500, 60, 6000};
  camera.forward = {0, 0.13f, -1};
  camera.widthPixels = kWidth;
  camera.heightPixels = kHeight;
  return camera;
}

/// A context, or a test that is skipped where the machine has no driver.
class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const Status opened = context_.open(); !opened) GTEST_SKIP() << opened.problem;
    bytes_ = writer::packBytes(heaps(), writer::packed::picturesOf(heaps()));
    ASSERT_TRUE(sky_.open(test::bytesOf(bytes_)));
  }
  image::Picture drawn(Renderer& renderer, const Camera& camera) {
    const test::Canvas canvas(camera.widthPixels, camera.heightPixels);
    renderer.draw(sky_.update(camera), camera, canvas.target.id());
    if (const char* folder = std::getenv("CLOUDGEN_PICTURES"))
      image::writePng(std::filesystem::path(folder) / (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".png"),
                      canvas.picture());
    return canvas.picture();
  }

  // What is drawn goes before the context that draws it.
  HeadlessContext context_;
  std::string bytes_;
  Runtime sky_;
};

TEST_F(RendererTest, DrawsWhatThePreviewDraws) {
  Renderer renderer;
  const Status made = renderer.make(sky_, test::decodePng, kWidth, kHeight, {});
  ASSERT_TRUE(made) << made.problem;
  const Camera camera = fromTheGround();
  const image::Picture ours = drawn(renderer, camera), theirs = test::preview(heaps(), camera, false);
  if (const char* folder = std::getenv("CLOUDGEN_PICTURES")) image::writePng(std::filesystem::path(folder) / "preview.png", theirs);
  const double similarity = test::ssim(ours, theirs);
  RecordProperty("ssim", std::to_string(similarity));
  EXPECT_GT(similarity, 0.8);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(RendererTest, FarCloudsAsPicturesLookTheSame) {
  Camera camera = fromTheGround();
  camera.eye.z = 30'000;
  camera.forward = {0, 0.03f, -1};
  camera.verticalFieldRadians = 0.2f;
  Renderer puffs, pictures;
  ASSERT_TRUE(puffs.make(sky_, test::decodePng, kWidth, kHeight, {}));
  const image::Picture wanted = drawn(puffs, camera);
  RuntimeOptions options;
  options.detail.impostorPixels = 64;
  ASSERT_TRUE(sky_.open(test::bytesOf(bytes_), options));
  ASSERT_TRUE(pictures.make(sky_, test::decodePng, kWidth, kHeight, {}));
  const Frame frame = sky_.update(camera);
  EXPECT_TRUE(std::any_of(frame.puffs.begin(), frame.puffs.end(), [](const DrawPuff& puff) { return puff.puff == kImpostor; }));
  EXPECT_GT(test::ssim(drawn(pictures, camera), wanted), 0.9);
}

TEST_F(RendererTest, VolumesAreWhatThePreviewDraws) {
  RuntimeOptions options;
  options.detail.impostorPixels = 1e9f;
  ASSERT_TRUE(sky_.open(test::bytesOf(bytes_), options));
  Renderer renderer;
  const Status made = renderer.make(sky_, test::decodePng, kWidth, kHeight, {.volumes = true});
  ASSERT_TRUE(made) << made.problem;
  const Camera camera = fromTheGround();
  const double similarity = test::ssim(drawn(renderer, camera), test::preview(heaps(), camera, false));
  RecordProperty("ssim", std::to_string(similarity));
  EXPECT_GT(similarity, 0.9);
}

TEST_F(RendererTest, TheSunMovesOverTheClouds) {
  Renderer renderer;
  ASSERT_TRUE(renderer.make(sky_, test::decodePng, kWidth, kHeight, {}));
  sky_.setSun({90, 25});
  renderer.setLight();
  const image::Picture morning = drawn(renderer, fromTheGround());
  sky_.setSun({270, 25});
  renderer.setLight();
  const image::Picture evening = drawn(renderer, fromTheGround());
  EXPECT_LT(test::ssim(morning, evening), 0.97);
}

TEST_F(RendererTest, TheSameFrameHasTheSamePixels) {
  Renderer renderer;
  ASSERT_TRUE(renderer.make(sky_, test::decodePng, kWidth, kHeight, {}));
  EXPECT_EQ(drawn(renderer, fromTheGround()).pixels, drawn(renderer, fromTheGround()).pixels);
}

TEST_F(RendererTest, SlowFramesAreDrawnCoarserAndFastOnesFineAgain) {
  Renderer renderer;
  ASSERT_TRUE(renderer.make(sky_, test::decodePng, kWidth, kHeight, {.targetMilliseconds = 40}));
  const test::Canvas canvas(kWidth, kHeight);
  const Camera camera = fromTheGround();
  const image::Picture fine = drawn(renderer, camera);
  for (int i = 0; i < 4; ++i) renderer.draw(sky_.update(camera), camera, canvas.target.id(), 100);
  EXPECT_LE(renderer.scale(), 0.5f);
  EXPECT_GT(test::ssim(canvas.picture(), fine), 0.85) << "it is the same picture";
  for (int i = 0; i < 200; ++i) renderer.draw(sky_.update(camera), camera, canvas.target.id(), 5);
  EXPECT_EQ(renderer.scale(), 1.0f);
}

}  // namespace
}  // namespace cloudgen::runtime::gles
