// SPDX-License-Identifier: Apache-2.0
#include "field/value_traps.hpp"

namespace cloudgen::field {
namespace {

TEST(ValueTraps, AreCountedWithTheirNumbers) {
  ValueTraps traps;
  traps.look({90000,
              {{Quantity::CloudIce, {-1e-19f, 2e-5f}},
               {Quantity::RelativeHumidity, {1.2f, 0.5f}},
               {Quantity::CloudFraction, {1.00009f, 0.2f}}}});
  const auto warnings = traps.warnings();
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0].id, "negative_condensate");
  EXPECT_EQ(warnings[0].text, "cloud water is negative in 1 cells (down to -1e-19 kg/kg): taken as none");
  EXPECT_EQ(warnings[1].id, "humidity_above_one");
  EXPECT_EQ(warnings[2].id, "cover_above_one");
  EXPECT_EQ(warnings[2].text, "cloud fraction passes 1 in 1 cells (up to 1.00009): taken as 1");
}

TEST(ValueTraps, CoverThatIsZeroEverywhereIsToldOnlyWhereThereIsWater) {
  ValueTraps dry, wet;
  dry.look({90000, {{Quantity::CloudLiquid, {0}}, {Quantity::CloudFraction, {0}}}});
  wet.look({90000, {{Quantity::CloudLiquid, {1e-4f}}, {Quantity::CloudFraction, {0}}}});
  EXPECT_TRUE(dry.warnings().empty());
  ASSERT_EQ(wet.warnings().size(), 1u);
  EXPECT_EQ(wet.warnings()[0].id, "zero_cover");
  EXPECT_TRUE(wet.coverIsEmpty());
}

}  // namespace
}  // namespace cloudgen::field
