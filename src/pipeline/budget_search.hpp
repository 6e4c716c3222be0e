// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloudgen::pipeline {

/// Puffs that some budget makes, as a share of those that are allowed.
struct DrawnShare {
  double share = 0;

  bool isTooMany() const { return share > 1.25; }
  bool isTooFew() const { return share < 0.6; }
  bool isNear() const { return !isTooMany() && !isTooFew(); }
  /// Too few are nearer to what is allowed than too many.
  bool isNearerThan(const DrawnShare& other) const {
    if (isTooMany() != other.isTooMany()) return other.isTooMany();
    return std::abs(std::log(share)) < std::abs(std::log(other.share));
  }
};

/// Looks for the budget with which as many puffs are drawn as are allowed: in proportion, and half-way between
/// what was too little and too much where that overshoots, as puffs come in steps.
class BudgetSearch {
 public:
  explicit BudgetSearch(double budget) : budget_(budget) {}

  double budget() const { return budget_; }
  /// Of the present budget so much is drawn.
  void drew(const DrawnShare& drawn) {
    (drawn.isTooMany() ? tooLarge_ : tooSmall_) = budget_;
    budget_ *= std::clamp(1 / drawn.share, 0.1, 10.0);
    if (budget_ <= tooSmall_ || budget_ >= tooLarge_) budget_ = std::sqrt(tooSmall_ * tooLarge_);
  }

 private:
  double budget_, tooSmall_ = 0, tooLarge_ = std::numeric_limits<double>::infinity();
};

}  // namespace cloudgen::pipeline
