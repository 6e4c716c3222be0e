// SPDX-License-Identifier: Apache-2.0
#include "runtime/endless.hpp"

#include <array>
#include <map>

#include "support/made_pack.hpp"

namespace cloudgen::runtime {
namespace {

class Endless : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(view.open(test::bytesOf(bytes))); }
  EndlessSky skyOf(std::string_view code, std::uint64_t seed = 3) const {
    EndlessSky sky;
    EndlessOptions options;
    options.weatherCode = code;
    options.seed = seed;
    const Status made = EndlessSky::make(view, options, sky);
    EXPECT_TRUE(made) << made.problem;
    return sky;
  }
  std::string genusOf(const pack::Instance& cloud) const {
    return view.root().archetypes()->Get(cloud.archetype())->genus()->str();
  }
  /// Clouds of each genus.
  std::map<std::string, int> countsOf(const EndlessSky& sky) const {
    std::map<std::string, int> counts;
    for (const pack::Instance& cloud : sky.instances()) ++counts[genusOf(cloud)];
    return counts;
  }
  /// Ground that the clouds of each genus cover, as a share of the square that they belong to (they may stand a quarter
  /// of its side out of it), by points of a lattice.
  std::map<std::string, double> coverOf(const EndlessSky& sky, const Vec3& eye) const {
    constexpr int kPoints = 100;
    std::map<std::string, double> cover;
    std::map<std::string, std::vector<const pack::Instance*>> clouds;
    for (const pack::Instance& cloud : sky.instances()) clouds[genusOf(cloud)].push_back(&cloud);
    const float reach = 1.7f, side = reach * sky.sideMeters();
    for (const auto& [genus, all] : clouds)
      for (int i = 0; i < kPoints * kPoints; ++i) {
        const float x = eye.x + side * (static_cast<float>(i % kPoints) / kPoints - 0.5f),
                    z = eye.z + side * (static_cast<float>(i / kPoints) / kPoints - 0.5f);
        for (const pack::Instance* cloud : all) {
          const float radius =
              0.5f * cloud->scale() * view.root().archetypes()->Get(cloud->archetype())->width_meters();
          if (std::hypot(x - cloud->position().x(), z - cloud->position().z()) < radius) {
            cover[genus] += reach * reach / (kPoints * kPoints);
            break;
          }
        }
      }
    return cover;
  }

  const std::string bytes = test::packOf(test::withLight(
      test::sceneOf({test::heap("Cu_1", base::Genus::Cumulus, 1500, 900, 3, 24),
                     test::heap("Cu_2", base::Genus::Cumulus, 2200, 1200, 3, 24),
                     test::sheet("As_1", base::Genus::Altostratus, 6000, 400, 24, 1, 0.2f, 5),
                     test::sheet("Ci_1", base::Genus::Cirrus, 5000, 400, 24, 3, 0.15f, 0.4f)},
                    8)));
  PackView view;
};

/// An hour at 250 m/s with a turn in the middle, one place a second.
Vec3 placeAt(int second) {
  const float meters = 250.0f * static_cast<float>(second);
  return second < 1800 ? Vec3{meters, 3000, -0.3f * meters}
                       : Vec3{450'000 - 0.4f * (meters - 450'000), 3000, -135'000 - (meters - 450'000)};
}

TEST_F(Endless, HasTheCloudsOfItsCode) {
  EXPECT_EQ(skyOf("d000").instances().size(), 0u);
  for (const auto& [code, clouds] : {std::pair{"d100", 10u}, {"d200", 30u}, {"n300", 75u}, {"d400", 200u}}) {
    const EndlessSky sky = skyOf(code);
    EXPECT_EQ(sky.instances().size(), clouds) << code;
    const auto counts = countsOf(sky);
    EXPECT_LE(counts.count("As") ? counts.at("As") : 0, 2);
    EXPECT_LE(counts.at("Ci"), 2);
  }
  for (const std::string_view wrong : {"", "d500", "x100", "d110", "d101", "d1000", "d10"}) {
    EndlessSky sky;
    EndlessOptions options;
    options.weatherCode = wrong;
    EXPECT_FALSE(EndlessSky::make(view, options, sky)) << wrong;
  }
}

TEST_F(Endless, CoverOfEveryGenusHoldsForAnHour) {
  for (const std::string_view code : {"d100", "d300", "d400"}) {
    EndlessSky sky = skyOf(code);
    // What the code asks for: its clouds side by side.
    std::map<std::string, double> asked;
    for (const pack::Instance& cloud : sky.instances()) {
      const double width = cloud.scale() * view.root().archetypes()->Get(cloud.archetype())->width_meters();
      asked[genusOf(cloud)] += 0.785398 * width * width / (static_cast<double>(sky.sideMeters()) * sky.sideMeters());
    }
    std::map<std::string, double> mean;
    double everLeast = 1e9, everMost = 0;
    int looks = 0;
    for (int second = 0; second <= 3600; second += 60, ++looks) {
      sky.moveTo(placeAt(second));
      for (const auto& [genus, cover] : coverOf(sky, placeAt(second))) {
        mean[genus] += cover;
        if (genus != "Ci") continue;
        everLeast = std::min(everLeast, cover);
        everMost = std::max(everMost, cover);
      }
    }
    for (const auto& [genus, cover] : asked) {
      EXPECT_NEAR(mean[genus] / looks / cover, 1, 0.1) << code << " " << genus;
    }
    EXPECT_NEAR(everLeast / asked["Ci"], 1, 0.1) << code;
    EXPECT_NEAR(everMost / asked["Ci"], 1, 0.1) << code;
  }
}

TEST_F(Endless, NoCloudAppearsNearerThanStated) {
  for (const std::string_view code : {"d100", "d400"}) {
    EndlessSky sky = skyOf(code);
    sky.moveTo(placeAt(0));
    std::size_t appeared = 0;
    for (int second = 1; second < 3600; ++second) {
      const std::vector<pack::Instance> before(sky.instances().begin(), sky.instances().end());
      const Vec3 eye = placeAt(second);
      std::size_t changed = 0;
      const std::size_t moved = sky.moveTo(eye);
      for (std::size_t i = 0; i < before.size(); ++i) {
        const pack::Vec3 &now = sky.instances()[i].position(), &was = before[i].position();
        if (now.x() == was.x() && now.z() == was.z()) continue;
        ++changed;
        EXPECT_GE(std::hypot(now.x() - eye.x, now.z() - eye.z), EndlessOptions().nearestMeters);
        EXPECT_GE(std::hypot(was.x() - eye.x, was.z() - eye.z), EndlessOptions().nearestMeters)
            << "none vanishes nearer, too";
      }
      EXPECT_EQ(moved, changed);
      appeared += changed;
    }
    EXPECT_GT(appeared, sky.instances().size()) << "clouds are met again and again";
  }
}

TEST_F(Endless, SameSeedSameSkyWhereverOneComesFrom) {
  EndlessSky straight = skyOf("d300"), roundabout = skyOf("d300"), other = skyOf("d300", 4);
  const Vec3 there{777'000, 2000, -333'000};
  for (int step = 0; step <= 50; ++step) roundabout.moveTo({16'000.0f * static_cast<float>(step), 900, 5000});
  straight.moveTo(there);
  roundabout.moveTo(there);
  other.moveTo(there);
  int same = 0;
  for (std::size_t i = 0; i < straight.instances().size(); ++i) {
    EXPECT_EQ(straight.instances()[i].position().x(), roundabout.instances()[i].position().x());
    EXPECT_EQ(straight.instances()[i].position().z(), roundabout.instances()[i].position().z());
    EXPECT_EQ(straight.instances()[i].yaw_step(), roundabout.instances()[i].yaw_step());
    same += straight.instances()[i].position().x() == other.instances()[i].position().x();
  }
  EXPECT_EQ(same, 0);
}

TEST_F(Endless, FewCloudsKeepTheirDistanceAndHeightsTheirOrder) {
  for (const std::string_view code : {"d100", "d200"}) {
    EndlessSky sky = skyOf(code);
    for (int second = 0; second < 3600; second += 300) {
      sky.moveTo(placeAt(second));
      float heapTop = 0, sheetLow = 1e9f;
      for (const pack::Instance& cloud : sky.instances()) {
        const std::string genus = genusOf(cloud);
        if (genus != "Cu") {
          sheetLow = std::min(sheetLow, cloud.position().y());
          continue;
        }
        heapTop = std::max(heapTop, cloud.position().y());
        for (const pack::Instance& next : sky.instances())
          if (&next != &cloud && genusOf(next) == "Cu") {
            EXPECT_GE(std::hypot(next.position().x() - cloud.position().x(), next.position().z() - cloud.position().z()),
                      3999.0f);
          }
      }
      EXPECT_LT(heapTop, sheetLow);
    }
  }
}

}  // namespace
}  // namespace cloudgen::runtime
