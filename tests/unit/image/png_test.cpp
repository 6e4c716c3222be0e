// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/file.hpp"
#include "image/picture.hpp"
#include "support/read_png.hpp"
#include "support/scratch.hpp"

namespace cloudgen::image {
namespace {

TEST(Png, ReadsBackAsItWasWritten) {
  const test::Scratch folder;
  for (const int channels : {3, 4}) {
    ByteImage image{5, 3, channels, {}};
    for (int i = 0; i < 15 * channels; ++i) image.bytes.push_back(static_cast<unsigned char>(i * 37));
    writePng(folder.path() / "a.png", image);
    const ByteImage back = test::readPng(folder.path() / "a.png");
    EXPECT_EQ(back.width, 5);
    EXPECT_EQ(back.height, 3);
    EXPECT_EQ(back.channels, channels);
    EXPECT_EQ(back.bytes, image.bytes);
  }
}

TEST(Png, PictureIsRoundedToBytesAndClamped) {
  const test::Scratch folder;
  Picture picture(2, 1);
  picture.at(0, 0) = {0.5f, -1, 2};
  picture.at(1, 0) = {1, 0.2f, 0};
  writePng(folder.path() / "p.png", picture);
  EXPECT_EQ(test::readPng(folder.path() / "p.png").bytes,
            (std::vector<unsigned char>{128, 0, 255, 255, 51, 0}));
}

TEST(Png, SamePictureSameBytesAndNothingBeside) {
  const test::Scratch folder;
  Picture picture(40, 30);
  for (int i = 0; i < 40; ++i) picture.at(i, i % 30) = glm::vec3(0.02f * static_cast<float>(i));
  writePng(folder.path() / "a.png", picture);
  writePng(folder.path() / "b.png", picture);
  EXPECT_EQ(base::readFile(folder.path() / "a.png"), base::readFile(folder.path() / "b.png"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Png, FolderThatIsNotThereIsAnOutputError) {
  const test::Scratch folder;
  EXPECT_THROW(writePng(folder.path() / "none" / "a.png", Picture(2, 2)), base::OutputError);
}

}  // namespace
}  // namespace cloudgen::image
