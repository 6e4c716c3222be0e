// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "field/derivation.hpp"
#include "field/source.hpp"

namespace cloudgen::field {

/// Which quantities are on which level, from the ground upwards.
struct LevelPlan {
  std::vector<std::set<Quantity>> levels;

  bool has(Quantity quantity) const;
  /// The next level above `level` that has it; levels.size() where none has.
  std::size_t nextWith(Quantity quantity, std::size_t level) const;
};

/// Asks the source for its levels at no cell at all; at the first of `cells` where it then visits nothing.
LevelPlan planOf(const Source& source, std::span<const std::uint32_t> cells);

/// Gives levels on, in their order, with what they lack and levels both below and above have: interpolated
/// linearly in the logarithm of pressure (in height where levels have no pressure; by their count where they
/// have neither). Heights are interpolated only where no level has a temperature to compute them with.
/// A level waits until the next one with what it lacks has come, so gaps cost their width in memory.
class GapFiller {
 public:
  GapFiller(LevelPlan plan, std::function<void(Level)> next, Derivations& derivations);
  void add(const Level& level);

 private:
  bool isGap(Quantity quantity, std::size_t level) const;
  bool complete(std::size_t level) const;
  void giveOn();
  void fill(Level& level, Quantity quantity) const;

  LevelPlan plan_;
  std::function<void(Level)> next_;
  Derivations& derivations_;
  std::vector<Quantity> fillable_;
  std::map<Quantity, std::pair<std::size_t, Level>> last_;  ///< level that had it, of quantities with a gap
  std::deque<Level> waiting_;
  std::size_t given_ = 0;
};

}  // namespace cloudgen::field
