// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/genus.hpp"

namespace cloudgen::input::cdfs {

/// Two tables of cloud type codes that agree on 1 to 8 only.
enum class TypeTable : unsigned char {
  Afwa,  ///< CDFS II: 0 none, 1..9 (9 = Ci), 25 not filled (Unidata afwa.tab; LISF compute_type_based_clouds)
  Wmo    ///< GRIB2 code table 4.203: 9 = Cc, 10 = Ci, 11..20 the same above ground fog, 191 unknown, 255
         ///< missing
};

/// What a code says, and what is taken for a cloud of that type where the file does not say it.
///
/// Depth: between the means that soundings and surface observers give for the morphological types (Poore,
/// Wang & Rossow 1995, J. Climate 8, 550; Wang, Rossow & Zhang 2000, J. Climate 13, 3041: 1.6 km over all
/// layers) and those of the WMO International Cloud Atlas; a cumulonimbus reaches down to where cumulus has
/// its base. Optical depth: within the type's class of ISCCP (Rossow & Schiffer 1999, BAMS 80, 2261), for
/// cumuliform clouds, which ISCCP averages over broken pixels, at its upper end. Share of ice: the atlas's
/// word on what the genus is made of.
struct CloudKind {
  bool inTable = false;
  std::optional<base::Genus> genus;  ///< nothing: the type rules decide
  bool aboveFog = false;
  float depthMeters = 0, leastBaseMeters = 0;
  float opticalDepth = 0, iceShare = 0;
};

using KindTable = std::array<CloudKind, 256>;
extern const KindTable kAfwaKinds, kWmoKinds;

inline const CloudKind& kindOf(TypeTable table, std::uint8_t code) {
  return (table == TypeTable::Afwa ? kAfwaKinds : kWmoKinds)[code];
}

/// The kind of a cloud of unknown type, by its top.
const CloudKind& unknownKind(float topMeters);

/// What rules.hpp writes over a cumulonimbus that it takes as cumulus: in no table, but with a kind of its
/// own, since such a cumulus is as deep as the cumulonimbus was.
inline constexpr std::uint8_t kTallCumulus = 250;

/// "AFWA" or "WMO 4.203".
std::string tableName(TypeTable table);

/// The code of a genus in the AFWA table; of genera that it lacks the nearest: Cc is 9 (Ci), fog is 2 (St).
std::uint8_t afwaCode(base::Genus genus);

}  // namespace cloudgen::input::cdfs
