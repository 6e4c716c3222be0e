// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace cloudgen::base {

/// The ten cloud genera of the WMO atlas, and fog.
enum class Genus : unsigned char {
  Cirrus,
  Cirrocumulus,
  Cirrostratus,
  Altocumulus,
  Altostratus,
  Nimbostratus,
  Stratocumulus,
  Stratus,
  Cumulus,
  Cumulonimbus,
  Fog
};

inline constexpr int kGenusCount = 11;

/// Every genus, in the order of the enumeration.
std::array<Genus, kGenusCount> allGenera();

/// The atlas abbreviation: "Ci", "Cc", ... "Cb"; "Fog".
std::string_view abbreviation(Genus genus);

/// The full name in lower case: "cirrus", ... "fog".
std::string_view name(Genus genus);

/// The genus of an abbreviation or a full name, in any case; nothing if there is none.
std::optional<Genus> genusFromName(std::string_view text);

}  // namespace cloudgen::base
