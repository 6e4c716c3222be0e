// SPDX-License-Identifier: Apache-2.0
#include "motion/tracking.hpp"

#include "base/random.hpp"
#include "base/thread.hpp"

namespace cloudgen::motion {
namespace {

CarriedCloud cumulus(double x, double z, float width = 2000) {
  return {{x, z}, width, 1000, 1000, base::Genus::Cumulus};
}

std::vector<CarriedCloud> field(int count, double jitter) {
  std::vector<CarriedCloud> clouds;
  for (int i = 0; i < count; ++i) {
    base::RandomStream random(1, static_cast<std::uint64_t>(i), base::Purpose::Test);
    const double x = random.uniform(0, 1e5), z = random.uniform(0, 1e5);
    base::RandomStream shake(2, static_cast<std::uint64_t>(i), base::Purpose::Test);
    clouds.push_back(cumulus(x + jitter * shake.gaussian(), z + jitter * shake.gaussian(),
                             static_cast<float>(random.uniform(800, 2400))));
  }
  return clouds;
}

TEST(Tracking, CloudsThatTheWindCarriedAreThemselves) {
  const auto earlier = field(400, 0), later = field(400, 60);
  const Tracking tracking = track(earlier, later);
  std::size_t right = 0;
  for (std::uint32_t i = 0; i < earlier.size(); ++i) right += tracking.earlier[i].partner == i;
  EXPECT_GT(right, 380u);
}

TEST(Tracking, PartnersAreMutualOrAside) {
  const auto earlier = field(300, 0), later = field(330, 900);
  const Tracking tracking = track(earlier, later);
  for (std::uint32_t i = 0; i < earlier.size(); ++i) {
    const Fate& fate = tracking.earlier[i];
    if (!fate.partner) continue;
    const Fate& other = tracking.later[*fate.partner];
    ASSERT_TRUE(other.partner);
    EXPECT_EQ(fate.aside, other.aside || other.partner != i);
  }
}

TEST(Tracking, CloudsOfAnotherKindAreOthers) {
  CarriedCloud cirrus = cumulus(0, 0);
  cirrus.genus = base::Genus::Cirrus;
  const std::vector<CarriedCloud> earlier{cumulus(0, 0)}, later{cirrus};
  EXPECT_FALSE(track(earlier, later).earlier[0].partner);
  EXPECT_EQ(likeness(cumulus(0, 0), cumulus(9000, 0)), 0);
  EXPECT_GT(likeness(cumulus(0, 0), cumulus(100, 0)), likeness(cumulus(0, 0), cumulus(100, 0, 1000)));
}

TEST(Tracking, OneCloudOfTwoIsAMerger) {
  const std::vector<CarriedCloud> two{cumulus(0, 0), cumulus(700, 0, 1200)}, one{cumulus(100, 0)};
  const Tracking merged = track(two, one);
  EXPECT_FALSE(merged.earlier[0].aside);
  EXPECT_TRUE(merged.earlier[1].aside);
  EXPECT_EQ(merged.earlier[1].partner, 0u);
  const Tracking split = track(one, two);
  EXPECT_TRUE(split.later[1].aside);
}

/// The nearest first would leave one alone; changing partners serves both.
TEST(Tracking, PartnersAreChangedWhereBothWin) {
  const std::vector<CarriedCloud> earlier{cumulus(0, 0), cumulus(-3300, 0)}, later{cumulus(-1500, 0), cumulus(1800, 0)};
  const Tracking tracking = track(earlier, later);
  EXPECT_EQ(tracking.earlier[0].partner, 1u);
  EXPECT_EQ(tracking.earlier[1].partner, 0u);
}

TEST(Tracking, DoesNotDependOnThreads) {
  const auto earlier = field(500, 0), later = field(500, 400);
  const auto partners = [&](int threads) {
    const base::ThreadLimit limit(threads);
    std::vector<std::optional<std::uint32_t>> out;
    for (const Fate& fate : track(earlier, later).earlier) out.push_back(fate.partner);
    return out;
  };
  EXPECT_EQ(partners(1), partners(4));
}

}  // namespace
}  // namespace cloudgen::motion
