// SPDX-License-Identifier: Apache-2.0
#include "field/value_traps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "field/cloud_water.hpp"

namespace cloudgen::field {

void ValueTraps::look(const Level& level) {
  for (const Quantity quantity : {Quantity::CloudCondensate, Quantity::CloudLiquid, Quantity::CloudIce}) {
    if (!level.has(quantity)) continue;
    for (const float value : level.of(quantity)) {
      negativeWater_ += value < 0;
      cloudyCells_ += value > kCloudyMixingRatio;
      leastWater_ = std::min(leastWater_, value);
    }
  }
  if (level.has(Quantity::RelativeHumidity))
    for (const float value : level.of(Quantity::RelativeHumidity)) {
      overSaturated_ += value > 1.0f;
      greatestHumidity_ = std::max(greatestHumidity_, value);
    }
  if (!level.has(Quantity::CloudFraction)) return;
  coverSeen_ = true;
  for (const float value : level.of(Quantity::CloudFraction)) {
    overCovered_ += value > 1.0f;
    greatestCover_ = std::max(greatestCover_, value);
  }
}

std::vector<Warning> ValueTraps::warnings() const {
  std::vector<Warning> found;
  if (negativeWater_)
    found.push_back({"negative_condensate",
                     fmt::format("cloud water is negative in {} cells (down to {:.2g} kg/kg): taken as none",
                                 negativeWater_, leastWater_)});
  if (overSaturated_)
    found.push_back(
        {"humidity_above_one", fmt::format("relative humidity passes 100 % in {} cells (up to {:.4g} %)",
                                           overSaturated_, 100 * greatestHumidity_)});
  if (overCovered_)
    found.push_back(
        {"cover_above_one", fmt::format("cloud fraction passes 1 in {} cells (up to {:.6g}): taken as 1",
                                        overCovered_, greatestCover_)});
  if (coverIsEmpty())
    found.push_back(
        {"zero_cover",
         fmt::format("cloud fraction is zero everywhere, though {} cells hold cloud water: it is derived",
                     cloudyCells_)});
  return found;
}

}  // namespace cloudgen::field
