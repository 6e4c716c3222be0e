// SPDX-License-Identifier: Apache-2.0
// The validator of packs sees what is wrong with one, and names the rule.
#include "check/pack/validate_pack.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "check/fidelity/written_scene.hpp"
#include "support/made_pack.hpp"

namespace cloudgen::check {
namespace {

using pack::RuntimePackT;

pack::Puff withSigma(const pack::Puff& puff, std::uint16_t sigma) {
  return {puff.center_x(), puff.center_y(), puff.center_z(), sigma, puff.sigma_y(), puff.sigma_z(),
          puff.rotation(), puff.optical_depth(), puff.sprite(), 0};
}

pack::Puff withSprite(const pack::Puff& puff, std::uint8_t sprite) {
  return {puff.center_x(), puff.center_y(), puff.center_z(), puff.sigma_x(), puff.sigma_y(), puff.sigma_z(),
          puff.rotation(), puff.optical_depth(), sprite, 0};
}

struct Break {
  const char* rule;
  void (*change)(RuntimePackT&);
};

const std::vector<Break> kBreaks{
    {"missing", [](RuntimePackT& p) { p.tone.reset(); }},
    {"missing", [](RuntimePackT& p) { p.sun.reset(); }},
    {"count", [](RuntimePackT& p) { p.responses.pop_back(); }},
    {"box", [](RuntimePackT& p) { p.archetypes[0]->lower = std::make_unique<pack::Vec3>(9e9f, 0.0f, 0.0f); }},
    {"levels", [](RuntimePackT& p) { p.archetypes[0]->levels.clear(); }},
    {"levels", [](RuntimePackT& p) { p.archetypes[0]->levels[1] = pack::Level(0, 5, 100); }},
    {"index-range", [](RuntimePackT& p) { p.archetypes[0]->levels[1] = pack::Level(60, 0xffffffff, 100); }},
    {"scale", [](RuntimePackT& p) { p.archetypes[1]->sun_scale[3] = std::numeric_limits<float>::infinity(); }},
    {"range", [](RuntimePackT& p) { p.archetypes[1]->sun_least = 5; }},
    {"index-range", [](RuntimePackT& p) { p.archetypes[1]->atlas = 200; }},
    {"index-range", [](RuntimePackT& p) { p.archetypes[1]->impostor = 0; }},
    {"puff", [](RuntimePackT& p) { p.puffs[5] = withSigma(p.puffs[5], 0); }},
    {"puff", [](RuntimePackT& p) { p.puffs[5] = withSigma(p.puffs[5], 0x7c00); }},
    {"index-range", [](RuntimePackT& p) { p.puffs[5] = withSprite(p.puffs[5], 16); }},
    {"index-range", [](RuntimePackT& p) { p.instances[2] = test::changed(p.instances[2], 77, 1); }},
    {"finite", [](RuntimePackT& p) { p.instances[2] = test::changed(p.instances[2], 0, -1); }},
    {"count", [](RuntimePackT& p) { p.records.pop_back(); }},
    {"record", [](RuntimePackT& p) { p.rules.clear(); }},
    {"tiles", [](RuntimePackT& p) { p.tiles[0] = test::withChildren(p.tiles[0], 0, 1); }},
    {"tiles", [](RuntimePackT& p) { p.instances[2] = test::changed(p.instances[2], 0, 900); }},
    {"picture", [](RuntimePackT& p) { p.atlases[0]->color[1] = 'J'; }},
    {"daylight", [](RuntimePackT& p) { std::swap(p.daylight[0], p.daylight[1]); }},
    {"count", [](RuntimePackT& p) { p.sun_colors.pop_back(); }},
    {"sun", [](RuntimePackT& p) { p.sun = std::make_unique<pack::Sun>(1.0f, 2.0f, pack::Vec3(1, 1, 1)); }},
    {"sun", [](RuntimePackT& p) { p.sun = std::make_unique<pack::Sun>(1.0f, NAN, pack::Vec3(0, 1, 0)); }},
    {"levels", [](RuntimePackT& p) { p.archetypes.push_back(std::make_unique<pack::ArchetypeT>(*p.archetypes[0])); }},
    {"keyframes", [](RuntimePackT& p) {
       for (int i = 0; i < 2; ++i) p.keyframes.push_back(std::make_unique<pack::KeyframeT>());
     }},
    {"keyframes", [](RuntimePackT& p) {
       p.keyframes.push_back(std::make_unique<pack::KeyframeT>());
       p.keyframes[0]->clouds = {3, 3};
       p.keyframes[0]->motions.assign(2, pack::Motion({0, 0, 0}, 1, 1));
     }},
    {"count", [](RuntimePackT& p) {
       p.keyframes.push_back(std::make_unique<pack::KeyframeT>());
       p.keyframes[0]->clouds = {3};
     }},
    {"pack-bytes", [](RuntimePackT& p) { p.version = 2; }},
};

TEST(ValidatePack, NamesTheRuleThatIsBroken) {
  const scene::Scene scene = test::packScene();
  for (std::size_t b = 0; b < kBreaks.size(); ++b) {
    const ValidationResult result = validatePack(test::packOf(scene, kBreaks[b].change), "broken.cgpack");
    EXPECT_FALSE(result.valid()) << b << " " << kBreaks[b].rule;
    EXPECT_TRUE(std::any_of(result.findings.begin(), result.findings.end(),
                            [&](const Finding& finding) { return finding.rule == kBreaks[b].rule; }))
        << b << " " << kBreaks[b].rule << ", but " << (result.valid() ? "none" : text(result.findings[0]));
  }
  EXPECT_TRUE(validatePack(test::packOf(scene, [](RuntimePackT&) {}), "whole.cgpack").valid());
}

TEST(ValidatePack, AnArrayThatIsBrokenAllOverIsOneFinding) {
  const std::string bytes = test::packOf(test::packScene(), [](RuntimePackT& p) {
    for (pack::Instance& cloud : p.instances) cloud = test::changed(cloud, 500, 1);
  });
  const ValidationResult result = validatePack(bytes, "broken.cgpack");
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(result.findings[0].message, "instances[0] names an archetype or a yaw that is not there, and 19 more");
}

TEST(ValidatePack, CutAnywhereIsNoPackAndNotRead) {
  const std::string whole = test::packOf(test::packScene());
  for (std::size_t part = 0; part < 60; ++part) {
    const std::string cut = whole.substr(0, whole.size() * part / 60);
    EXPECT_FALSE(validatePack(cut, "cut.cgpack").valid());
    EXPECT_THROW(readPackScene(cut, "cut.cgpack"), base::InputError);
  }
}

}  // namespace
}  // namespace cloudgen::check
