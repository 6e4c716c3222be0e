// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/cloud_types.hpp"

#include <array>

namespace cloudgen::input::cdfs {
namespace {

using base::Genus;

//                                     in table  genus            above fog  depth  least base  optical depth
//                                     ice
constexpr CloudKind kCumulonimbus{true, Genus::Cumulonimbus, false, 11000, 800, 50, 0.5f};
constexpr CloudKind kStratus{true, Genus::Stratus, false, 450, 150, 10, 0};
constexpr CloudKind kStratocumulus{true, Genus::Stratocumulus, false, 550, 400, 9, 0};
constexpr CloudKind kCumulus{true, Genus::Cumulus, false, 1100, 500, 9, 0};
constexpr CloudKind kAltostratus{true, Genus::Altostratus, false, 1700, 1500, 9, 0.6f};
constexpr CloudKind kNimbostratus{true, Genus::Nimbostratus, false, 3500, 500, 35, 0.4f};
constexpr CloudKind kAltocumulus{true, Genus::Altocumulus, false, 700, 1500, 4, 0.1f};
constexpr CloudKind kCirrostratus{true, Genus::Cirrostratus, false, 1600, 3000, 4, 1};
constexpr CloudKind kCirrus{true, Genus::Cirrus, false, 1500, 3000, 1, 1};
constexpr CloudKind kCirrocumulus{true, Genus::Cirrocumulus, false, 400, 3000, 1, 1};

constexpr CloudKind kCongestus{false, Genus::Cumulus, false, 11000, 800, 25, 0.2f};
constexpr CloudKind kUnknown{true};
constexpr CloudKind kUnknownLow{true, std::nullopt, false, 700, 300, 9, 0};
constexpr CloudKind kUnknownMiddle{true, std::nullopt, false, 1200, 1500, 7, 0.4f};
constexpr CloudKind kUnknownHigh{true, std::nullopt, false, 1500, 3000, 2, 1};

constexpr std::array kSharedKinds{kCumulonimbus, kStratus,      kStratocumulus, kCumulus,
                                  kAltostratus,  kNimbostratus, kAltocumulus,   kCirrostratus};

constexpr KindTable afwa() {
  KindTable table{};
  table[0] = table[25] = kUnknown;
  for (std::size_t i = 0; i < kSharedKinds.size(); ++i) table[i + 1] = kSharedKinds[i];
  table[9] = kCirrus;
  table[kTallCumulus] = kCongestus;
  return table;
}

constexpr KindTable wmo() {
  KindTable table{};
  table[0] = table[191] = table[255] = kUnknown;
  for (std::size_t i = 0; i < kSharedKinds.size(); ++i) table[i + 1] = kSharedKinds[i];
  table[9] = kCirrocumulus;
  table[10] = kCirrus;
  table[kTallCumulus] = kCongestus;
  for (std::size_t code = 11; code <= 20; ++code) {
    table[code] = table[code - 10];
    table[code].aboveFog = true;
  }
  return table;
}

}  // namespace

constinit const KindTable kAfwaKinds = afwa(), kWmoKinds = wmo();

const CloudKind& unknownKind(float topMeters) {
  return topMeters < 3000 ? kUnknownLow : topMeters < 7500 ? kUnknownMiddle : kUnknownHigh;
}

std::string tableName(TypeTable table) { return table == TypeTable::Afwa ? "AFWA" : "WMO 4.203"; }

std::uint8_t afwaCode(base::Genus genus) {
  switch (genus) {
    case Genus::Cumulonimbus:
      return 1;
    case Genus::Stratus:
    case Genus::Fog:
      return 2;
    case Genus::Stratocumulus:
      return 3;
    case Genus::Cumulus:
      return 4;
    case Genus::Altostratus:
      return 5;
    case Genus::Nimbostratus:
      return 6;
    case Genus::Altocumulus:
      return 7;
    case Genus::Cirrostratus:
      return 8;
    case Genus::Cirrus:
    case Genus::Cirrocumulus:
      return 9;
  }
  return 0;
}

}  // namespace cloudgen::input::cdfs
