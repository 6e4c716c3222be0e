// SPDX-License-Identifier: Apache-2.0
#include "pipeline/moving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "pipeline/moving_clouds.hpp"
#include "pipeline/quantity.hpp"
#include "pipeline/skies_between.hpp"
#include "pipeline/steps.hpp"

namespace cloudgen::pipeline {
namespace {

/// The ground that clouds cover at most, as a weight.
double ground(const motion::CarriedCloud& cloud) { return static_cast<double>(cloud.widthMeters) * cloud.widthMeters; }

/// What becomes of clouds over the stretches between two times.
class Tally {
 public:
  void add(const Passage& passage, const CloudsOfTime& earlier, const CloudsOfTime& later) {
    ++hour_.stretches;
    for (std::size_t i = 0; i < earlier.clouds.size(); ++i) {
      const motion::Fate& fate = passage.tracking.earlier[i];
      whole_ += ground(earlier.clouds[i]);
      if (!fate.partner) ++hour_.deaths;
      if (fate.partner && fate.aside) ++hour_.mergers;
      if (!fate.partner || fate.aside) continue;
      ++hour_.matched;
      matched_ += ground(earlier.clouds[i]);
      // What the wind alone does, from here on and up to there.
      const auto &forwards = passage.forwards[i], &backwards = passage.backwards[*fate.partner];
      const glm::dvec2 wind = 0.5 * (forwards.back() - forwards.front() + backwards.back() - backwards.front()),
                       drift = backwards.back() - forwards.front();
      along_ += glm::dot(drift, wind), square_ += glm::dot(wind, wind);
      speed_ += glm::length(wind) / passage.seconds;
    }
    for (std::size_t i = 0; i < later.clouds.size(); ++i) {
      const motion::Fate& fate = passage.tracking.later[i];
      whole_ += ground(later.clouds[i]);
      if (!fate.partner) ++hour_.births;
      if (fate.partner && fate.aside) ++hour_.splits;
      if (fate.partner && !fate.aside) matched_ += ground(later.clouds[i]);
    }
  }

  HourOfMotion result() const {
    HourOfMotion hour = hour_;
    hour.matchedShare = whole_ > 0 ? matched_ / whole_ : 1;
    hour.driftOverWind = square_ > 0 ? along_ / square_ : 0;
    hour.windMetersPerSecond = hour.matched > 0 ? speed_ / static_cast<double>(hour.matched) : 0;
    return hour;
  }

 private:
  HourOfMotion hour_;
  double whole_ = 0, matched_ = 0, along_ = 0, square_ = 0, speed_ = 0;
};

/// Joins scenes of one frame: archetypes by name, light by archetype and heading, clouds one after another.
class Join {
 public:
  explicit Join(const scene::Scene& first) : whole_(first) {
    for (std::uint32_t i = 0; i < whole_.archetypes.size(); ++i) archetypes_[whole_.archetypes[i].name] = i;
    for (std::uint32_t i = 0; i < whole_.lit.size(); ++i) lits_[{whole_.lit[i].archetype, whole_.lit[i].yawStep}] = i;
  }

  void add(scene::Scene&& next) {
    std::vector<std::uint32_t> litAs;
    for (scene::LitArchetype& lit : next.lit) {
      scene::Archetype& archetype = next.archetypes[lit.archetype];
      const auto [known, isNew] =
          archetypes_.try_emplace(archetype.name, static_cast<std::uint32_t>(whole_.archetypes.size()));
      if (isNew) whole_.archetypes.push_back(archetype);
      lit.archetype = known->second;
      const auto [row, isNewRow] =
          lits_.try_emplace({lit.archetype, lit.yawStep}, static_cast<std::uint32_t>(whole_.lit.size()));
      if (isNewRow) whole_.lit.push_back(std::move(lit));
      litAs.push_back(row->second);
    }
    for (scene::Instance instance : next.instances) {
      instance.lit = litAs[instance.lit];
      whole_.instances.push_back(instance);
    }
    whole_.clouds.insert(whole_.clouds.end(), std::make_move_iterator(next.clouds.begin()),
                         std::make_move_iterator(next.clouds.end()));
  }

  scene::Scene& whole() { return whole_; }

 private:
  scene::Scene whole_;
  std::map<std::string, std::uint32_t> archetypes_;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> lits_;
};

/// The time whose layers cover the most ground: its clouds decide how much detail the budget allows.
std::size_t cloudiest(const std::vector<Located>& times) {
  const auto cover = [](const Located& located) {
    double sum = 0;
    for (const field::Layer& layer : located.table.layers) sum += layer.fraction;
    return sum;
  };
  return static_cast<std::size_t>(
      std::max_element(times.begin(), times.end(),
                       [&](const Located& a, const Located& b) { return cover(a) < cover(b); }) -
      times.begin());
}

bool sameCells(const field::Grid& a, const field::Grid& b) {
  const auto corner = [](const field::Grid& grid) { return field::centerOf(grid, 0); };
  return a.size() == b.size() && a.columns == b.columns && corner(a).longitudeDegrees == corner(b).longitudeDegrees &&
         corner(a).latitudeDegrees == corner(b).latitudeDegrees;
}

/// All skies of a film, those of the times and those between.
struct Skies {
  std::vector<CloudsOfTime> clouds;
  std::vector<Passage> passages;        ///< one fewer
  std::vector<std::uint32_t> ofTimes;   ///< which of them are those of the times
  std::vector<std::uint32_t> first{0};  ///< instance of each, and the end
};

/// Cuts the time between where the wind needs it (or not at all), tracks the clouds from sky to sky, and orders the instances of the
/// joined scene by skies: those between have copies of their own.
Skies skiesOf(const std::vector<base::UtcTime>& times, const std::vector<CloudsOfTime>& clouds,
              const std::vector<motion::WindField>& winds, bool cut, scene::Scene& scene, std::vector<HourOfMotion>& hours) {
  Skies skies;
  const std::vector<scene::Instance> instances = std::move(scene.instances);
  const std::vector<scene::CloudRecord> records = std::move(scene.clouds);
  scene.instances.clear(), scene.clouds.clear();
  const auto place = [&](std::size_t instance, const glm::dvec2& shift) {
    scene.instances.push_back(instances[instance]);
    scene.clouds.push_back(records[instance]);
    scene.instances.back().position += glm::vec3(shift.x, 0, shift.y);
  };
  const auto finishSky = [&] { skies.first.push_back(static_cast<std::uint32_t>(scene.instances.size())); };
  std::size_t start = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::size_t next = start + clouds[k].clouds.size();
    for (std::size_t i = start; i < next; ++i) place(i, glm::dvec2(0));
    finishSky();
    skies.ofTimes.push_back(static_cast<std::uint32_t>(skies.clouds.size()));
    skies.clouds.push_back(clouds[k]);
    if (k + 1 == times.size()) break;
    motion::WindBetween wind{winds[k], winds[k + 1], static_cast<double>(times[k + 1].seconds - times[k].seconds),
                             motion::wayOfPattern(winds[k], winds[k + 1])};
    const int stretches = cut ? stretchesBetween(clouds[k], clouds[k + 1], wind) : 1;
    for (SkyBetween& sky : skiesBetween(clouds[k], clouds[k + 1], wind.way, stretches)) {
      for (const SkyBetween::Origin& origin : sky.origins)
        place((origin.later ? next : start) + origin.cloud, origin.shift);
      finishSky();
      skies.clouds.push_back(std::move(sky.clouds));
    }
    skies.clouds.push_back(clouds[k + 1]);
    Tally tally;
    for (int i = 0; i < stretches; ++i) {
      const std::size_t before = skies.ofTimes.back() + static_cast<std::size_t>(i);
      const double length = 1.0 / stretches;
      skies.passages.push_back(passageOf(skies.clouds[before], skies.clouds[before + 1], wind,
                                         {i * length, i + 1 == stretches ? 1 : (i + 1) * length}));
      tally.add(skies.passages.back(), skies.clouds[before], skies.clouds[before + 1]);
    }
    skies.clouds.pop_back();
    hours.push_back(tally.result());
    hours.back().from = times[k], hours.back().to = times[k + 1];
    hours.back().patternMetersPerSecond = glm::length(wind.way) / wind.seconds;
    start = next;
  }
  return skies;
}

/// Identity: the clouds of a chain bear the number of its first. Returns how many chains are there in n + 1 skies.
std::vector<std::uint64_t> nameChains(const Skies& skies, scene::Scene& scene) {
  std::vector<std::uint64_t> lifetimes(skies.clouds.size(), 0);
  std::vector<std::uint32_t> ages(scene.clouds.size(), 1);
  for (std::size_t k = 0; k < skies.clouds.size(); ++k) {
    const std::uint32_t first = skies.first[k], end = skies.first[k + 1];
    for (std::uint32_t cloud = first; cloud < end; ++cloud) {
      const auto goesOn = [&] {
        if (k == skies.passages.size()) return false;
        const motion::Fate& fate = skies.passages[k].tracking.earlier[cloud - first];
        return fate.partner.has_value() && !fate.aside;
      };
      if (k > 0) {
        const motion::Fate& fate = skies.passages[k - 1].tracking.later[cloud - first];
        if (fate.partner && !fate.aside) {
          const std::uint32_t before = skies.first[k - 1] + *fate.partner;
          scene.clouds[cloud].id = scene.clouds[before].id;
          ages[cloud] = ages[before] + 1;
        }
      }
      if (!goesOn()) ++lifetimes[ages[cloud] - 1];
    }
  }
  return lifetimes;
}

Options withTyping(Options options, const field::Source* typing) {
  if (typing) options.typing = typing;
  return options;
}

/// Moments before a cloud is there and after it has gone, as where the wind has taken it out of the box.
void dropWhatIsGone(scene::Motion& motion) {
  std::vector<scene::Moment>& moments = motion.moments;
  while (moments.size() > 2 && moments.back().presence == 0 && moments[moments.size() - 2].presence == 0) moments.pop_back();
  std::size_t early = 0;
  while (early + 2 < moments.size() && moments[early].presence == 0 && moments[early + 1].presence == 0) ++early;
  moments.erase(moments.begin(), moments.begin() + static_cast<std::ptrdiff_t>(early));
  motion.firstKey += static_cast<std::uint32_t>(early);
}

void setMotions(const Skies& skies, scene::Scene& scene) {
  const auto& [clouds, passages, ofTimes, first] = skies;
  std::vector<std::uint32_t> keyOfSky{0};
  scene.keySeconds = {0};
  for (const Passage& passage : passages) {
    const double start = scene.keySeconds.back();
    for (int i = 1; i <= passage.intervals; ++i)
      scene.keySeconds.push_back(start + passage.seconds * i / passage.intervals);
    keyOfSky.push_back(static_cast<std::uint32_t>(scene.keySeconds.size() - 1));
  }
  for (const std::uint32_t sky : ofTimes) scene.timeSeconds.push_back(scene.keySeconds[keyOfSky[sky]]);
  for (std::size_t k = 0; k < clouds.size(); ++k)
    for (std::uint32_t cloud = 0; cloud < clouds[k].clouds.size(); ++cloud) {
      scene::Motion motion;
      motion.firstKey = keyOfSky[k > 0 ? k - 1 : 0];
      if (k > 0) motion.moments = coming(passages[k - 1], clouds[k - 1], clouds[k], cloud);
      if (k < passages.size()) {
        if (k > 0) motion.moments.pop_back();
        const auto rest = going(passages[k], clouds[k], clouds[k + 1], cloud);
        motion.moments.insert(motion.moments.end(), rest.begin(), rest.end());
      }
      dropWhatIsGone(motion);
      scene.motions.push_back(std::move(motion));
    }
}

}  // namespace

MovingSky runTimes(const std::vector<base::UtcTime>& times, const OpenTime& open, const Options& options,
                   const base::Progress& progress, const OpenTime& openTyping) {
  std::vector<Located> located;
  for (const base::UtcTime time : times) {
    const auto source = open(time);
    const auto typing = openTyping ? openTyping(time) : nullptr;
    located.push_back(locate(*source, withTyping(options, typing.get()), progress));
    if (!sameCells(located.front().grid, located.back().grid))
      throw base::InputError(source->info().files.front(), "has another grid than the time before",
                             "give times of one model on one grid");
  }
  progress.step("quantity", 0.25);
  const std::size_t fullest = cloudiest(located);
  const Generalisation general = placeWithinBudget(located[fullest].grid, located[fullest].origin.frame,
                                                   located[fullest].origin.cells, options, located[fullest].table);
  FootprintBook footprints(options, general);
  std::vector<CloudsOfTime> clouds;
  std::vector<motion::WindField> winds;
  for (std::size_t k = 0; k < times.size(); ++k) {
    winds.push_back(windOf(located[k]));
    if (k != fullest)
      placeClouds(located[k].grid, located[k].origin.frame, located[k].origin.cells, options, general,
                  footprints, located[k].table);
    clouds.push_back(cloudsOfTime(located[k].grid, located[k].origin.frame, located[k].table));
  }

  std::optional<MovingSky> sky;
  std::optional<Join> join;
  light::Sun firstSun;
  light::Moon firstMoon;
  light::Sky firstSky;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto source = open(times[k]);
    const auto typing = openTyping ? openTyping(times[k]) : nullptr;
    // What is lit once and for all is lit alike at all times: clouds of two times stand side by side.
    Origin& origin = located[k].origin;
    if (k == 0) firstSun = origin.sun, firstMoon = origin.moon, firstSky = origin.sky;
    origin.sun = firstSun, origin.moon = firstMoon, origin.sky = firstSky;
    Outcome outcome = finish(std::move(located[k]), *source, general, withTyping(options, typing.get()), progress);
    if (k == 0) {
      join.emplace(outcome.scene);
      scene::Scene empty{outcome.scene.frame};
      sky.emplace(MovingSky{std::move(outcome), std::move(empty), std::nullopt, times, {}, {}});
    } else {
      join->add(std::move(outcome.scene));
    }
  }
  progress.step("motion", 0.9);
  const auto move = [&](bool cut, scene::Scene& scene, std::vector<HourOfMotion>& hours) {
    scene = join->whole();
    const Skies skies = skiesOf(times, clouds, winds, cut, scene, hours);
    setMotions(skies, scene);
    return nameChains(skies, scene);
  };
  sky->lifetimes = move(true, sky->scene, sky->hours);
  const auto isCut = [](const HourOfMotion& hour) { return hour.stretches > 1; };
  if (std::any_of(sky->hours.begin(), sky->hours.end(), isCut)) {
    std::vector<HourOfMotion> uncut;
    move(false, sky->uncut.emplace(join->whole().frame), uncut);
  }
  return std::move(*sky);
}

}  // namespace cloudgen::pipeline
