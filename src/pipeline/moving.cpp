// SPDX-License-Identifier: Apache-2.0
#include "pipeline/moving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "pipeline/moving_clouds.hpp"
#include "pipeline/quantity.hpp"
#include "pipeline/steps.hpp"

namespace cloudgen::pipeline {
namespace {

/// The ground that clouds cover at most, as a weight.
double ground(const motion::CarriedCloud& cloud) { return static_cast<double>(cloud.widthMeters) * cloud.widthMeters; }

HourOfMotion hourOf(const Passage& passage, const CloudsOfTime& earlier, const CloudsOfTime& later) {
  HourOfMotion hour;
  double whole = 0, matched = 0, along = 0, square = 0, speed = 0;
  for (std::size_t i = 0; i < earlier.clouds.size(); ++i) {
    const motion::Fate& fate = passage.tracking.earlier[i];
    whole += ground(earlier.clouds[i]);
    if (!fate.partner) ++hour.deaths;
    if (fate.partner && fate.aside) ++hour.mergers;
    if (!fate.partner || fate.aside) continue;
    ++hour.matched;
    matched += ground(earlier.clouds[i]);
    // What the wind alone does, from here on and up to there.
    const auto &forwards = passage.forwards[i], &backwards = passage.backwards[*fate.partner];
    const glm::dvec2 wind = 0.5 * (forwards.back() - forwards.front() + backwards.back() - backwards.front()),
                     drift = backwards.back() - forwards.front();
    along += glm::dot(drift, wind), square += glm::dot(wind, wind);
    speed += glm::length(wind) / passage.seconds;
  }
  for (std::size_t i = 0; i < later.clouds.size(); ++i) {
    const motion::Fate& fate = passage.tracking.later[i];
    whole += ground(later.clouds[i]);
    if (!fate.partner) ++hour.births;
    if (fate.partner && fate.aside) ++hour.splits;
    if (fate.partner && !fate.aside) matched += ground(later.clouds[i]);
  }
  hour.matchedShare = whole > 0 ? matched / whole : 1;
  hour.driftOverWind = square > 0 ? along / square : 0;
  hour.windMetersPerSecond = hour.matched > 0 ? speed / static_cast<double>(hour.matched) : 0;
  return hour;
}

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

/// Identity: the clouds of a chain bear the number of its first. Returns how many chains are there at n + 1 times.
std::vector<std::uint64_t> nameChains(const std::vector<Passage>& passages,
                                      const std::vector<std::uint32_t>& firstOfTime, scene::Scene& scene) {
  std::vector<std::uint64_t> lifetimes(passages.size() + 1, 0);
  std::vector<std::uint32_t> ages(scene.clouds.size(), 1);
  for (std::size_t k = 0; k <= passages.size(); ++k) {
    const std::uint32_t first = firstOfTime[k], end = firstOfTime[k + 1];
    for (std::uint32_t cloud = first; cloud < end; ++cloud) {
      const auto goesOn = [&] {
        if (k == passages.size()) return false;
        const motion::Fate& fate = passages[k].tracking.earlier[cloud - first];
        return fate.partner.has_value() && !fate.aside;
      };
      if (k > 0) {
        const motion::Fate& fate = passages[k - 1].tracking.later[cloud - first];
        if (fate.partner && !fate.aside) {
          const std::uint32_t before = firstOfTime[k - 1] + *fate.partner;
          scene.clouds[cloud].id = scene.clouds[before].id;
          ages[cloud] = ages[before] + 1;
        }
      }
      if (!goesOn()) ++lifetimes[ages[cloud] - 1];
    }
  }
  return lifetimes;
}

void setMotions(const std::vector<Passage>& passages, const std::vector<CloudsOfTime>& clouds, scene::Scene& scene) {
  std::vector<std::uint32_t> keyOfTime{0};
  scene.keySeconds = {0};
  for (const Passage& passage : passages) {
    const double start = scene.keySeconds.back();
    for (int i = 1; i <= passage.intervals; ++i)
      scene.keySeconds.push_back(start + passage.seconds * i / passage.intervals);
    keyOfTime.push_back(static_cast<std::uint32_t>(scene.keySeconds.size() - 1));
  }
  for (const std::uint32_t key : keyOfTime) scene.timeSeconds.push_back(scene.keySeconds[key]);
  for (std::size_t k = 0; k < clouds.size(); ++k)
    for (std::uint32_t cloud = 0; cloud < clouds[k].clouds.size(); ++cloud) {
      scene::Motion motion;
      motion.firstKey = keyOfTime[k > 0 ? k - 1 : 0];
      if (k > 0) motion.moments = coming(passages[k - 1], clouds[k - 1], clouds[k], cloud);
      if (k < passages.size()) {
        if (k > 0) motion.moments.pop_back();
        const auto rest = going(passages[k], clouds[k], clouds[k + 1], cloud);
        motion.moments.insert(motion.moments.end(), rest.begin(), rest.end());
      }
      scene.motions.push_back(std::move(motion));
    }
}

}  // namespace

MovingSky runTimes(const std::vector<base::UtcTime>& times, const OpenTime& open, const Options& options,
                   const base::Progress& progress) {
  std::vector<Located> located;
  for (const base::UtcTime time : times) {
    const auto source = open(time);
    located.push_back(locate(*source, options, progress));
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
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k != fullest)
      placeClouds(located[k].grid, located[k].origin.frame, located[k].origin.cells, options, general,
                  footprints, located[k].table);
    clouds.push_back(cloudsOfTime(located[k].grid, located[k].origin.frame, located[k].table));
  }

  std::optional<MovingSky> sky;
  std::optional<Join> join;
  light::Sun firstSun;
  std::vector<std::uint32_t> firstOfTime{0};
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto source = open(times[k]);
    // What is lit once and for all is lit alike at all times: clouds of two times stand side by side.
    if (k == 0) firstSun = located[k].origin.sun;
    located[k].origin.sun = firstSun;
    located[k].origin.sky = light::skyUnder(firstSun);
    Outcome outcome = finish(std::move(located[k]), *source, general, options, progress);
    firstOfTime.push_back(firstOfTime.back() + static_cast<std::uint32_t>(outcome.scene.instances.size()));
    if (k == 0) {
      join.emplace(outcome.scene);
      scene::Scene empty{outcome.scene.frame};
      sky.emplace(MovingSky{std::move(outcome), std::move(empty), times, {}, {}});
    } else {
      join->add(std::move(outcome.scene));
    }
  }
  progress.step("motion", 0.9);
  std::vector<Passage> passages;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    passages.push_back(passageOf(clouds[k], clouds[k + 1], static_cast<double>(times[k + 1].seconds - times[k].seconds)));
    sky->hours.push_back(hourOf(passages.back(), clouds[k], clouds[k + 1]));
    sky->hours.back().from = times[k], sky->hours.back().to = times[k + 1];
  }
  sky->scene = std::move(join->whole());
  setMotions(passages, clouds, sky->scene);
  sky->lifetimes = nameChains(passages, firstOfTime, sky->scene);
  return std::move(*sky);
}

}  // namespace cloudgen::pipeline
