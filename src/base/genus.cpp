// SPDX-License-Identifier: Apache-2.0
#include "base/genus.hpp"

#include "base/text.hpp"

namespace cloudgen::base {
namespace {

struct GenusNames {
  std::string_view abbreviation, name;
};

constexpr std::array<GenusNames, kGenusCount> kNames{{{"Ci", "cirrus"},
                                                      {"Cc", "cirrocumulus"},
                                                      {"Cs", "cirrostratus"},
                                                      {"Ac", "altocumulus"},
                                                      {"As", "altostratus"},
                                                      {"Ns", "nimbostratus"},
                                                      {"Sc", "stratocumulus"},
                                                      {"St", "stratus"},
                                                      {"Cu", "cumulus"},
                                                      {"Cb", "cumulonimbus"},
                                                      {"Fog", "fog"}}};

}  // namespace

std::array<Genus, kGenusCount> allGenera() {
  std::array<Genus, kGenusCount> genera{};
  for (int i = 0; i < kGenusCount; ++i) genera[i] = static_cast<Genus>(i);
  return genera;
}

std::string_view abbreviation(Genus genus) { return kNames[static_cast<int>(genus)].abbreviation; }

std::string_view name(Genus genus) { return kNames[static_cast<int>(genus)].name; }

std::optional<Genus> genusFromName(std::string_view text) {
  for (const Genus genus : allGenera())
    if (equalIgnoringCase(text, abbreviation(genus)) || equalIgnoringCase(text, name(genus))) return genus;
  return std::nullopt;
}

}  // namespace cloudgen::base
