// SPDX-License-Identifier: Apache-2.0
// Packs that were written once and must be read for ever (tests/fuzz/seeds/pack): of version 1, and one of a later
// schema of the same version, with fields that are not known here.
#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/pack/validate_pack.hpp"
#include "runtime/runtime.hpp"
#include "support/made_pack.hpp"

namespace cloudgen::writer {
namespace {

void expectTheFrozenScene(const std::string& bytes, const char* name) {
  for (const check::Finding& finding : check::validatePack(bytes, name).findings) ADD_FAILURE() << check::text(finding);
  const check::WrittenScene written = check::readPackScene(bytes, name);
  ASSERT_EQ(written.clouds.size(), 20u);
  EXPECT_EQ(written.clouds[0].recorded, base::Genus::Cumulus);
  runtime::Runtime runtime;
  ASSERT_TRUE(runtime.open(test::bytesOf(bytes)));
  EXPECT_EQ(runtime.pack().root().provenance()->valid_time()->str(), "2011-01-15T12:00:00Z");
  EXPECT_EQ(runtime.pack().root().provenance()->seed(), 7u);
  EXPECT_EQ(runtime.pack().archetypes()[0].count[0], 60u);
  EXPECT_EQ(runtime.pack().root().archetypes()->Get(1)->name()->str(), "Ci_1");
  EXPECT_NEAR(runtime.pack().root().sun()->elevation_degrees(), 35, 1e-4f);
  runtime::Camera camera;
  camera.eye = {10'000, 2000, 20'000};
  EXPECT_GT(runtime.update(camera).puffs.size(), 20u);
}

const std::filesystem::path kFrozen = std::filesystem::path(CLOUDGEN_SOURCE_DIR) / "tests/fuzz/seeds/pack";

TEST(FrozenPack, OfVersionOneIsRead) {
  expectTheFrozenScene(base::readFile(kFrozen / "version_1.cgpack"), "version_1.cgpack");
}

TEST(FrozenPack, WithFieldsOfALaterSchemaIsRead) {
  expectTheFrozenScene(base::readFile(kFrozen / "later_fields.cgpack"), "later_fields.cgpack");
}

}  // namespace
}  // namespace cloudgen::writer
