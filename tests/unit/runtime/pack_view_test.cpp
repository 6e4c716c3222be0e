// SPDX-License-Identifier: Apache-2.0
#include "runtime/pack_view.hpp"

#include <glm/gtc/packing.hpp>

#include "support/made_pack.hpp"
#include "support/scratch.hpp"

namespace cloudgen::runtime {
namespace {

std::string problemOf(const std::string& bytes) {
  PackView view;
  const Status status = view.open(test::bytesOf(bytes));
  EXPECT_EQ(view.empty(), !status);
  return status ? "" : status.problem;
}

TEST(PackView, OpensWhatTheWriterWrites) {
  const scene::Scene scene = test::packScene();
  const test::Scratch folder;
  PackView view;
  const Status status = view.open(folder.write("scene.cgpack", test::packOf(scene)).c_str());
  ASSERT_TRUE(status) << status.problem;
  EXPECT_EQ(view.instances().size(), scene.instances.size());
  EXPECT_EQ(view.archetypes().size(), scene.archetypes.size());
  for (std::size_t a = 0; a < scene.archetypes.size(); ++a) {
    const ArchetypeInfo& info = view.archetypes()[a];
    ASSERT_EQ(info.count[0], scene.archetypes[a].puffs.size());
    for (std::uint32_t p = 0; p < info.count[0]; ++p) {
      const glm::vec3 wanted = scene.archetypes[a].puffs[p].center;
      const Vec3 found = view.centers()[info.first[0] + p];
      EXPECT_LT(length(found - Vec3{wanted.x, wanted.y, wanted.z}), 0.2f);
    }
  }
}

TEST(PackView, RefusesWhatIsNoFileOrCutShort) {
  PackView view;
  EXPECT_FALSE(view.open("/nowhere/scene.cgpack"));
  const std::string whole = test::packOf(test::packScene());
  EXPECT_EQ(problemOf(whole), "");
  for (std::size_t part = 0; part < 100; ++part)
    EXPECT_NE(problemOf(whole.substr(0, whole.size() * part / 100)), "") << part;
  EXPECT_NE(problemOf("CGPK and some text that is no pack"), "");
}

TEST(PackView, RefusesWhatItCouldNotWalk) {
  using pack::RuntimePackT;
  const std::vector<std::pair<const char*, void (*)(RuntimePackT&)>> breaks{
      {"version", [](RuntimePackT& p) { p.version = kPackVersion + 1; }},
      {"no puffs", [](RuntimePackT& p) { p.puffs.clear(); }},
      {"no tone", [](RuntimePackT& p) { p.tone.reset(); }},
      {"archetype", [](RuntimePackT& p) { p.instances[3] = test::changed(p.instances[3], 99, 1.0f); }},
      {"scale", [](RuntimePackT& p) { p.instances[3] = test::changed(p.instances[3], 0, NAN); }},
      {"atlas", [](RuntimePackT& p) { p.archetypes[0]->atlas = 9; }},
      {"height", [](RuntimePackT& p) { p.archetypes[0]->sun_height = 9; }},
      {"levels", [](RuntimePackT& p) { p.archetypes[0]->levels[1] = pack::Level(0xfffffff0u, 0x20, 1); }},
      {"shared", [](RuntimePackT& p) { p.archetypes[1]->levels = p.archetypes[0]->levels; p.archetypes.push_back(std::make_unique<pack::ArchetypeT>(*p.archetypes[0])); }},
      {"scales", [](RuntimePackT& p) { p.archetypes[0]->sun_scale.resize(3); }},
      {"loop", [](RuntimePackT& p) { p.tiles[0] = test::withChildren(p.tiles[0], 0, 1); }},
      {"tiles", [](RuntimePackT& p) { p.tiles.clear(); }},
      {"daylight", [](RuntimePackT& p) { p.daylight.resize(1); }},
      {"colours", [](RuntimePackT& p) { p.sun_colors.pop_back(); }},
      {"keyframe", [](RuntimePackT& p) {
         p.keyframes.push_back(std::make_unique<pack::KeyframeT>());
         p.keyframes[0]->motions.emplace_back(pack::Vec3(0, 0, 0), 1.0f, 1.0f);
       }}};
  for (const auto& [name, break_] : breaks) EXPECT_NE(problemOf(test::packOf(test::packScene(), break_)), "") << name;
  EXPECT_EQ(problemOf(test::packOf(test::packScene(), [](RuntimePackT&) {})), "");
}

TEST(PackView, HalvesAreThoseOfIeee) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const float wanted = glm::unpackHalf1x16(static_cast<std::uint16_t>(bits)),
                found = floatOf(static_cast<std::uint16_t>(bits));
    if (std::isnan(wanted))
      EXPECT_TRUE(std::isnan(found));
    else
      EXPECT_EQ(found, wanted) << bits;
  }
}

}  // namespace
}  // namespace cloudgen::runtime
