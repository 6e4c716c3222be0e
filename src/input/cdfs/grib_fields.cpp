// SPDX-License-Identifier: Apache-2.0
// Octets of section 1: WMO Manual on Codes, FM 92 GRIB edition 1 and (sections 1 to 4) edition 2.
#include "input/cdfs/grib_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "input/grib/handle.hpp"
#include "input/grib/octets.hpp"
#include "input/grib/product.hpp"

namespace cloudgen::input::cdfs {
namespace {

constexpr int kAirForce = 57, kLayerLevel = 109, kColumnLevel = 200;
constexpr std::size_t kSection1 = 28;

GribColumn columnOf1(int parameter, int levelType) {
  if (levelType == kLayerLevel) switch (parameter) {
      case 163:
        return GribColumn::Amount;
      case 164:
        return GribColumn::Type;
      case 227:
        return GribColumn::Base;
      case 228:
        return GribColumn::Top;
      case 185:
        return GribColumn::OpticalDepth;
      default:
        return GribColumn::Other;
    }
  if (levelType == kColumnLevel && parameter == 71) return GribColumn::TotalCover;
  if (levelType == kColumnLevel && parameter == 183) return GribColumn::UpdateTime;
  return GribColumn::Other;
}

/// Discipline 0, category 6 of GRIB2 (code table 4.2).
GribColumn columnOf2(int number) {
  switch (number) {
    case 1:
      return GribColumn::TotalCover;
    case 7:
    case 22:
      return GribColumn::Amount;
    case 8:
      return GribColumn::Type;
    case 11:
      return GribColumn::Base;
    case 12:
      return GribColumn::Top;
    default:
      return GribColumn::Other;
  }
}

bool hasLayers(GribColumn column) {
  return column != GribColumn::TotalCover && column != GribColumn::UpdateTime && column != GribColumn::Other;
}

std::uint64_t bigEndian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

/// A cloud type by layer, or another cloud field of the Air Force.
bool startsWithTypedCloud2(std::string_view message) {
  if (message.size() < 23 || message[6] != 0) return false;
  const bool airForce = bigEndian(message.substr(21, 2)) == kAirForce;
  for (std::size_t place = 16; place + 11 <= message.size();) {
    const std::string_view section = message.substr(place);
    if (section[4] == 4)
      return section[9] == 6 &&
             (section[10] == 8 || (airForce && columnOf2(section[10]) != GribColumn::Other));
    const std::uint64_t length = bigEndian(section.substr(0, 4));
    if (length < 5 || length > message.size()) return false;
    place += length;
  }
  return false;
}

/// What section 2 (GRIB1) or 3 (GRIB2, template 20) says; the two lay it out differently. Throws InputError
/// for grids of other kinds and absurd ones.
MeshHeader headerOf(const grib::FieldHead& head) {
  constexpr std::uint64_t kMostColumns = 4096;
  const bool first = head.location.edition == 1;
  const grib::Octets grid(*head.grid, head.location.name());
  const bool polar = first ? grid.has(6) && grid.whole(6, 1) == 5 : grid.whole(13, 2) == 20;
  if (!polar)
    throw base::InputError(head.location.name(), "is not on a polar stereographic grid",
                           "give WWMCA files on their own grid");
  const std::uint64_t columns = first ? grid.whole(7, 2) : grid.whole(31, 4);
  const std::uint64_t rows = first ? grid.whole(9, 2) : grid.whole(35, 4);
  if (columns < 2 || rows < 2 || columns > kMostColumns || rows > kMostColumns)
    throw base::InputError(head.location.name(), fmt::format("has a grid of {} x {} cells", columns, rows),
                           "fetch the file again");
  const auto number = [&](std::size_t octet1, std::size_t octet2) {
    return first ? 1e-3 * static_cast<double>(grid.withSign(octet1, 3))
                 : 1e-6 * static_cast<double>(grid.withSign(octet2, 4));
  };
  MeshHeader header;
  header.columns = static_cast<int>(columns), header.rows = static_cast<int>(rows);
  header.firstLatitude = number(11, 39);
  header.firstLongitude = number(14, 43);
  header.orientation = number(18, 52);
  header.stepMeters =
      first ? static_cast<double>(grid.whole(21, 3)) : 1e-3 * static_cast<double>(grid.whole(56, 4));
  header.radiusMeters = first || grid.whole(15, 1) == 0 ? 6367470 : 6371229;  // the spheres of GRIB
  // The corners of a hemisphere's square lie beyond the equator.
  header.south = (grid.whole(first ? 27 : 64, 1) & 128) != 0 || header.firstLatitude > 0;
  header.rowsRise = (grid.whole(first ? 28 : 65, 1) & 64) != 0;
  return header;
}

Hemisphere halfOf(const grib::FieldHead& head) {
  const int named = head.location.edition == 1 ? static_cast<unsigned char>((*head.identification)[6]) : 0;
  if (named == 212) return Hemisphere::North;
  if (named == 213) return Hemisphere::South;
  return headerOf(head).south ? Hemisphere::South : Hemisphere::North;
}

/// What a message is, or nothing (and a line of `unused`) where it is not WWMCA's.
std::optional<GribField> fieldOf(const grib::FieldHead& head, std::vector<std::string>& unused) {
  const grib::Product product = grib::readProduct(head);
  const bool second = product.edition == 2;
  GribField field;
  if (second && product.discipline == 0 && product.category == 6) field.column = columnOf2(product.number);
  if (!second && product.centre == kAirForce) field.column = columnOf1(product.number, product.firstType);
  const bool onLayer = product.firstValue >= 1 && product.firstValue <= static_cast<double>(kLayers);
  if (field.column == GribColumn::Other || (hasLayers(field.column) && !onLayer) || !product.valid) {
    unused.push_back(fmt::format("parameter {} on level {:g} of type {} ({})", product.number,
                                 product.firstValue, product.firstType, head.location.name()));
    return std::nullopt;
  }
  field.head = head;
  if (hasLayers(field.column)) field.layer = static_cast<std::size_t>(product.firstValue) - 1;
  field.half = halfOf(head);
  field.time = *product.valid;
  return field;
}

std::uint8_t typeless(TypeTable table) { return table == TypeTable::Afwa ? kNotFilled : kWmoMissing; }

/// Neither missing nor damaged.
bool isThere(double value) { return value > 0.5 * grib::kMissingValue; }

/// Values are whole numbers that packing may have moved a little. (std::round is a call, and there are
/// millions.)
std::uint8_t byteOf(double value, std::uint8_t missing) {
  return isThere(value) ? static_cast<std::uint8_t>(std::min(255.0, std::max(0.0, value)) + 0.5) : missing;
}

std::int16_t heightOf(double value) {
  return value > 0 ? static_cast<std::int16_t>(std::min(32000.0, value) + 0.5) : kNoHeight;
}

}  // namespace

bool startsLikeWwmca(std::string_view firstBytes) {
  const std::size_t start = firstBytes.find("GRIB");
  if (start == std::string_view::npos || firstBytes.size() < start + 8 + kSection1) return false;
  const std::string_view message = firstBytes.substr(start);
  if (message[7] == 2) return startsWithTypedCloud2(message);
  const auto octet = [&](std::size_t number) { return static_cast<unsigned char>(message[7 + number]); };
  return message[7] == 1 && octet(5) == kAirForce && columnOf1(octet(9), octet(10)) != GribColumn::Other;
}

std::vector<GribField> gribFieldsOf(const std::filesystem::path& file, std::vector<std::string>& unused) {
  std::vector<GribField> fields;
  for (const grib::FieldHead& head : grib::locateFields(file))
    if (auto field = fieldOf(head, unused)) fields.push_back(std::move(*field));
  return fields;
}

Mesh meshOf(const std::vector<GribField>& fields, std::vector<field::Warning>& warnings) {
  const GribField& first = fields.front();
  // A message may name its grid by number alone.
  if (first.head.grid->empty()) return standardMesh();
  MeshHeader header = headerOf(first.head);
  header.south = first.half == Hemisphere::South;
  if (const auto mesh = meshOf(header)) return *mesh;
  const bool square =
      header.columns == header.rows && std::has_single_bit(static_cast<unsigned>(header.rows));
  if (!square)
    throw base::InputError(first.head.location.name(), "has a grid without the pole in it",
                           "give WWMCA files on their own grid");
  warnings.push_back(
      {"grid_header", fmt::format("the grid in the header of {} does not hold the pole: that of the Air "
                                  "Force's mesh with {} x {} cells is taken",
                                  first.head.location.name(), header.columns, header.rows)});
  return standardMesh(header.columns);
}

void GribReader::read(const std::vector<GribField>& fields, std::size_t half) {
  constexpr std::size_t kTasks = 4;  // each holds a decoded message
  for (const GribField& field : fields) provide(field.column);
  base::parallelFor(kTasks, [&](std::size_t task) {
    std::vector<double> values;
    for (const GribField& field : fields) {
      if (static_cast<std::size_t>(field.column) % kTasks != task) continue;
      grib::decodeValues(field.head.location, analysis_.mesh.size(), values);
      keep(field, values, half);
    }
  });
  for (const GribField& field : fields)
    if (field.column == GribColumn::UpdateTime)
      analysis_.fields.push_back(fmt::format(
          "update time of the {}: {}", field.half == Hemisphere::North ? "north" : "south",
          absoluteTimes_ ? "minutes since 1967-12-31" : "minutes from the base time, of either sign"));
}

void GribReader::provide(GribColumn column) {
  const std::size_t cells = analysis_.cells(), slots = cells * kLayers;
  switch (column) {
    case GribColumn::Amount:
      return Analysis::provide(analysis_.amount, slots, std::uint8_t{0});
    case GribColumn::Type:
      return Analysis::provide(analysis_.type, slots, typeless(analysis_.table));
    case GribColumn::Base:
      return Analysis::provide(analysis_.base, slots, kNoHeight);
    case GribColumn::Top:
      return Analysis::provide(analysis_.top, slots, kNoHeight);
    case GribColumn::OpticalDepth:
      return Analysis::provide(analysis_.opticalDepth, slots, 0.0f);
    case GribColumn::TotalCover:
      return Analysis::provide(analysis_.totalCover, cells, std::uint8_t{255});
    case GribColumn::UpdateTime:
      return Analysis::provide(analysis_.ageMinutes, cells, std::int16_t{0});
    case GribColumn::Other:
      return;
  }
}

void GribReader::keep(const GribField& field, const std::vector<double>& values, std::size_t half) {
  const std::size_t first = half * analysis_.mesh.size();
  const auto fill = [&](auto& column, const auto& convert) {
    auto* slot = column.data() + first * kLayers + field.layer;
    for (std::size_t i = 0; i < values.size(); ++i) slot[i * kLayers] = convert(values[i]);
  };
  switch (field.column) {
    case GribColumn::Amount:
      return fill(analysis_.amount, [](double value) { return byteOf(value, 0); });
    case GribColumn::Type:
      return fill(analysis_.type,
                  [missing = typeless(analysis_.table)](double value) { return byteOf(value, missing); });
    case GribColumn::Base:
      return fill(analysis_.base, heightOf);
    case GribColumn::Top:
      return fill(analysis_.top, heightOf);
    case GribColumn::OpticalDepth:
      return fill(analysis_.opticalDepth, [this](double value) { return keepDepth(value); });
    case GribColumn::TotalCover:
      std::transform(values.begin(), values.end(),
                     analysis_.totalCover.begin() + static_cast<std::ptrdiff_t>(first),
                     [](double value) { return byteOf(value, 255); });
      return;
    case GribColumn::UpdateTime:
      return keepAges(values, first);
    case GribColumn::Other:
      return;
  }
}

float GribReader::keepDepth(double value) {
  if (!(value > 0 && value < 1e6)) return 0;
  const double beyond = value - static_cast<double>(static_cast<int>(value));
  fractionalDepth_ |= beyond > 1e-3 && beyond < 1 - 1e-3;
  largestDepth_ = std::max(largestDepth_, value);
  return static_cast<float>(value);
}

void GribReader::keepAges(const std::vector<double>& values, std::size_t first) {
  constexpr double kSurelyAbsolute = 1e6;
  const auto large = [](double value) { return isThere(value) && std::abs(value) > kSurelyAbsolute; };
  absoluteTimes_ = std::any_of(values.begin(), values.end(), large);
  const double now =
      static_cast<double>(analysis_.time.seconds - base::utcFromCivil(1967, 12, 31).seconds) / 60;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool never = !isThere(values[i]) || (absoluteTimes_ && values[i] == 0);
    const double age = absoluteTimes_ ? now - values[i] : std::abs(values[i]);
    analysis_.ageMinutes[first + i] =
        never ? kNeverObserved : static_cast<std::int16_t>(std::clamp(age, -32768.0, 32766.0));
  }
}

void GribReader::finish() {
  constexpr double kDeepest = 200;
  if (largestDepth_ == 0) return;
  const bool timesTen = !fractionalDepth_ || largestDepth_ > kDeepest;
  if (!timesTen) return;
  for (float& depth : analysis_.opticalDepth) depth *= 0.1f;
  analysis_.warnings.push_back(
      {"optical_depth_x10",
       fmt::format(
           "optical depths are stored times ten ({}): they are divided by ten, the largest from {:g} to {:g}",
           fractionalDepth_ ? "no cloud is that deep" : "whole numbers only", largestDepth_,
           largestDepth_ / 10)});
}

}  // namespace cloudgen::input::cdfs
