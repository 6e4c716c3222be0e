// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::pipeline {

/// What a rule may look at. What is "around" is the mean over the layer and what goes on from it nearby
/// (surroundings.hpp).
enum class Trait {
  Base,                ///< m above mean sea level
  BaseAboveGround,     ///< m
  TopAboveGround,      ///< m
  Depth,               ///< m
  OpticalDepth,        ///< vertical, in cloud
  IceShare,            ///< of the optical depth, 0..1
  TopTemperature,      ///< K
  PatchArea,           ///< km2
  CoverAround,         ///< 0..1
  OpticalDepthAround,  ///< vertical, in cloud
  KIndexAround,        ///< C
};
inline constexpr int kTraitCount = 11;

/// The traits of a layer, by Trait, and the borders of the etages where it is. NaN is unknown: it meets no
/// condition.
struct Traits {
  std::array<float, kTraitCount> values{};
  float middleEtageMeters = 0, highEtageMeters = 0;

  float operator[](Trait trait) const { return values[static_cast<std::size_t>(trait)]; }
  float& operator[](Trait trait) { return values[static_cast<std::size_t>(trait)]; }
};

enum class Comparison { Under, AtMost, Over, AtLeast };

/// What a trait is compared with: a number, or a border of the etages.
enum class Border { Number, MiddleEtage, HighEtage };

struct Condition {
  Trait trait{};
  Comparison comparison{};
  float number = 0;
  Border border = Border::Number;
};

/// What a rule asks for: one of the alternatives, each made of conditions that hold together.
struct Demand {
  std::vector<std::vector<Condition>> alternatives;
  std::string_view name;  ///< of a demand that several rules share ("heaped"); may be empty
  bool denied = false;    ///< none of the alternatives may hold
};

/// All demands must be met. Rules without a genus are for types that somebody else states.
struct Rule {
  std::string_view id;
  base::Genus genus{};
  std::vector<Demand> demands;
};

/// The rules that derive a genus, in the order in which they are tried; the last one takes what is left.
std::span<const Rule> derivingRules();

float limitOf(const Condition& condition, const Traits& traits);
bool holds(const Condition& condition, const Traits& traits);
bool holds(const Demand& demand, const Traits& traits);
bool holds(const Rule& rule, const Traits& traits);

/// The rule that decides: the first that holds.
const Rule& decidingRule(const Traits& traits);

/// What a trait is called, in which unit people read it, and how it gets there: unit = scale * value + shift.
struct TraitText {
  std::string_view name, unit;
  float scale = 1, shift = 0;
  int decimals = 0;

  float shown(float value) const { return scale * value + shift; }
};
const TraitText& textOf(Trait trait);

/// "under", "at most", "over", "at least".
std::string_view textOf(Comparison comparison);

/// "-41.2 C", "unknown" for NaN.
std::string textOf(Trait trait, float value);

/// "top temperature under -25 C", "base at least the high etage's border".
std::string textOf(const Condition& condition);

/// "heaped (cover under 30 %, or ...)".
std::string textOf(const Demand& demand);

}  // namespace cloudgen::pipeline
