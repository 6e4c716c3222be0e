// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/counts.hpp"

#include <fmt/format.h>

namespace cloudgen::input::cdfs {
namespace {

std::string strangeCodeText(TypeTable table, std::uint8_t code, std::uint64_t layers) {
  const TypeTable other = table == TypeTable::Afwa ? TypeTable::Wmo : TypeTable::Afwa;
  const CloudKind& there = kindOf(other, code);
  std::string text = fmt::format("{} layers have the type code {}, which the {} table does not have", layers,
                                 code, tableName(table));
  if (there.inTable)
    text += fmt::format(" (in the {} table it is {})", tableName(other),
                        there.genus ? base::abbreviation(*there.genus) : "no type");
  return text + ": their genus is left to the type rules";
}

}  // namespace

Counts& Counts::operator+=(const Counts& other) {
  told += other.told;
  staleLow += other.staleLow;
  staleUpper += other.staleUpper;
  tooNew += other.tooNew;
  neverObserved += other.neverObserved;
  cumulonimbusAsCumulus += other.cumulonimbusAsCumulus;
  amountTooLarge += other.amountTooLarge;
  withoutHeight += other.withoutHeight;
  withoutType += other.withoutType;
  aboveFog += other.aboveFog;
  baseAssumed += other.baseAssumed;
  depthAssumed += other.depthAssumed;
  totalCells += other.totalCells;
  totalOff += other.totalOff;
  totalOffBy += other.totalOffBy;
  for (std::size_t code = 0; code < strangeCodes.size(); ++code)
    strangeCodes[code] += other.strangeCodes[code];
  return *this;
}

std::vector<field::Warning> warningsOf(const Counts& counts, TypeTable table) {
  std::vector<field::Warning> warnings;
  const auto warn = [&](bool applies, const char* id, std::string text) {
    if (applies) warnings.push_back({id, std::move(text)});
  };
  const std::uint64_t stale = counts.staleLow + counts.staleUpper + counts.tooNew + counts.neverObserved;
  warn(
      stale > 0, "stale_typing",
      fmt::format("{} of {} layers are dropped for their time: {} low ones older than 3 h, {} middle or high "
                  "ones older than 6 h, {} later than 3 h after the base time, {} never observed",
                  stale, stale + counts.told, counts.staleLow, counts.staleUpper, counts.tooNew,
                  counts.neverObserved));
  warn(
      counts.cumulonimbusAsCumulus > 0, "cb_taken_as_cu",
      fmt::format("{} layers of cumulonimbus with a top not above 11.4 to 12.6 km (by latitude) are taken as "
                  "cumulus",
                  counts.cumulonimbusAsCumulus));
  for (std::size_t code = 0; code < counts.strangeCodes.size(); ++code)
    warn(counts.strangeCodes[code] > 0, "type_code",
         strangeCodeText(table, static_cast<std::uint8_t>(code), counts.strangeCodes[code]));
  warn(counts.withoutType > 0, "type_not_filled",
       fmt::format("{} layers have an amount but no type: their genus is left to the type rules",
                   counts.withoutType));
  warn(counts.aboveFog > 0, "ground_fog",
       fmt::format(
           "{} layers are typed as above ground fog: the fog is left out, since the file gives neither "
           "its cover nor its depth",
           counts.aboveFog));
  warn(counts.amountTooLarge > 0, "amount_too_large",
       fmt::format("{} layers have an amount over 100 %: they are dropped", counts.amountTooLarge));
  warn(counts.withoutHeight > 0, "no_height",
       fmt::format("{} layers have neither a base nor a top within 0 to 25 km: they are dropped",
                   counts.withoutHeight));
  warn(counts.totalOff > 0, "total_cover",
       fmt::format(
           "the total cover lies outside of what the layers allow (from the largest to the sum of their "
           "amounts, 5 % either way) in {} of {} cells, by {:.1f} % on average: the layers are taken",
           counts.totalOff, counts.totalCells,
           counts.totalOff > 0 ? counts.totalOffBy / static_cast<double>(counts.totalOff) : 0.0));
  return warnings;
}

}  // namespace cloudgen::input::cdfs
