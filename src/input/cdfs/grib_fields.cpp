// SPDX-License-Identifier: Apache-2.0
// Octets of section 1: WMO Manual on Codes, FM 92 GRIB edition 1 and (sections 1 to 4) edition 2.
#include "input/cdfs/grib_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "input/grib/handle.hpp"

namespace cloudgen::input::cdfs {
namespace {

constexpr int kAirForce = 57, kLayerLevel = 109, kColumnLevel = 200;
constexpr std::size_t kSection1 = 28;

/// Section 1 of GRIB1, octets counted from 1 as the manual does.
struct Section1 {
  std::string_view bytes;

  int octet(std::size_t number) const { return static_cast<unsigned char>(bytes[number - 1]); }
  bool whole() const { return bytes.size() >= kSection1; }
  int centre() const { return octet(5); }
  int gridDefinition() const { return octet(7); }
  int parameter() const { return octet(9); }
  int levelType() const { return octet(10); }
  int level() const { return octet(11) * 256 + octet(12); }

  /// Analyses have no forecast step; one in hours or minutes is added.
  base::UtcTime time() const {
    const int year = (octet(25) - 1) * 100 + octet(13);
    base::UtcTime time = base::utcFromCivil(year, std::clamp(octet(14), 1, 12), std::clamp(octet(15), 1, 31),
                                            octet(16), octet(17));
    if (octet(21) == 0 && octet(18) <= 1) time.seconds += octet(19) * (octet(18) == 1 ? 3600 : 60);
    return time;
  }
};

GribColumn columnOf(const Section1& section) {
  if (section.levelType() == kLayerLevel) switch (section.parameter()) {
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
  if (section.levelType() == kColumnLevel && section.parameter() == 71) return GribColumn::TotalCover;
  if (section.levelType() == kColumnLevel && section.parameter() == 183) return GribColumn::UpdateTime;
  return GribColumn::Other;
}

/// Discipline 0, category 6 of GRIB2 (code table 4.2).
GribColumn columnOf2(long number) {
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

bool isSouth(const grib::Handle& handle) {
  if (const auto flag = handle.integerIfAny("projectionCentreFlag"); flag && (*flag & 128) != 0) return true;
  // The corners of a hemisphere's square lie beyond the equator.
  return handle.number("latitudeOfFirstGridPointInDegrees") > 0;
}

base::UtcTime validTime(const grib::Handle& handle) {
  const long date = handle.integer("validityDate"), time = handle.integer("validityTime");
  return base::utcFromCivil(static_cast<int>(date / 10000),
                            std::clamp(static_cast<int>(date / 100 % 100), 1, 12),
                            std::clamp(static_cast<int>(date % 100), 1, 31), static_cast<int>(time / 100),
                            static_cast<int>(time % 100));
}

/// Tells what each message of a file is.
class Listing {
 public:
  Listing(const std::filesystem::path& file, std::vector<std::string>& unused)
      : stream_(file, std::ios::binary), unused_(unused) {}

  std::vector<GribField> of(const std::vector<grib::FieldLocation>& locations) {
    for (const grib::FieldLocation& location : locations)
      location.edition == 1 ? add1(location) : add2(location);
    return std::move(fields_);
  }

 private:
  void add1(const grib::FieldLocation& location) {
    std::string bytes(kSection1, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(location.messageOffset + 8));
    if (!stream_.read(bytes.data(), kSection1))
      throw base::InputError(location.name(), "cannot be read any more",
                             "leave input files alone while they are read");
    const Section1 section{bytes};
    const auto column = columnOf(section);
    const bool onLayer = section.level() >= 1 && section.level() <= static_cast<int>(kLayers);
    if (column == GribColumn::Other || section.centre() != kAirForce || (hasLayers(column) && !onLayer)) {
      unused_.push_back(fmt::format("parameter {} on level {} of type {} ({})", section.parameter(),
                                    section.level(), section.levelType(), location.name()));
      return;
    }
    const bool bothNamed = section.gridDefinition() == 212 || section.gridDefinition() == 213;
    const bool south = bothNamed ? section.gridDefinition() == 213 : isSouth(grib::Handle(location));
    add(location, column, section.level(), south, section.time());
  }

  void add2(const grib::FieldLocation& location) {
    const grib::Handle handle(location);
    const bool cloud =
        handle.integerIfAny("discipline") == 0 && handle.integerIfAny("parameterCategory") == 6;
    const auto column = cloud ? columnOf2(handle.integer("parameterNumber")) : GribColumn::Other;
    const long level = handle.integerIfAny("level").value_or(0);
    if (column == GribColumn::Other || (hasLayers(column) && (level < 1 || level > 4))) {
      unused_.push_back(fmt::format("{} on level {} ({})", handle.text("shortName"), level, location.name()));
      return;
    }
    add(location, column, static_cast<int>(level), isSouth(handle), validTime(handle));
  }

  void add(const grib::FieldLocation& location, GribColumn column, int level, bool south,
           base::UtcTime time) {
    fields_.push_back({location, column, hasLayers(column) ? static_cast<std::size_t>(level - 1) : 0,
                       south ? Hemisphere::South : Hemisphere::North, time});
  }

  std::ifstream stream_;
  std::vector<std::string>& unused_;
  std::vector<GribField> fields_;
};

MeshHeader headerOf(const grib::Handle& handle, Hemisphere half) {
  constexpr long kMostColumns = 4096;
  if (handle.text("gridType") != "polar_stereographic")
    throw base::InputError(handle.location().name(),
                           fmt::format("is on a grid of the kind {}", handle.text("gridType")),
                           "give WWMCA files on their own polar stereographic grid");
  MeshHeader header;
  const long columns = handle.integer("Nx"), rows = handle.integer("Ny");
  if (columns < 2 || rows < 2 || columns > kMostColumns || rows > kMostColumns)
    throw base::InputError(handle.location().name(),
                           fmt::format("has a grid of {} x {} cells", columns, rows), "fetch the file again");
  header.columns = static_cast<int>(columns), header.rows = static_cast<int>(rows);
  header.firstLatitude = handle.number("latitudeOfFirstGridPointInDegrees");
  header.firstLongitude = handle.number("longitudeOfFirstGridPointInDegrees");
  header.orientation = handle.number("orientationOfTheGridInDegrees");
  header.stepMeters = handle.number("DxInMetres");
  header.radiusMeters = handle.numberIfAny("radius").value_or(6367470);  // GRIB1's sphere
  header.south = half == Hemisphere::South;
  header.rowsRise = handle.integerIfAny("jScansPositively") == 1;
  return header;
}

std::uint8_t typeless(TypeTable table) { return table == TypeTable::Afwa ? kNotFilled : kWmoMissing; }

/// Neither missing nor damaged.
bool isThere(double value) { return value > 0.5 * grib::Handle::kMissing; }

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
  const Section1 section{message.substr(8)};
  return message[7] == 1 && section.centre() == kAirForce && columnOf(section) != GribColumn::Other;
}

std::vector<GribField> gribFieldsOf(const std::filesystem::path& file, std::vector<std::string>& unused) {
  return Listing(file, unused).of(grib::locateFields(file));
}

Mesh meshOf(const std::vector<GribField>& fields, std::vector<field::Warning>& warnings) {
  const grib::Handle handle(fields.front().location);
  const MeshHeader header = headerOf(handle, fields.front().half);
  if (const auto mesh = meshOf(header)) return *mesh;
  const bool square =
      header.columns == header.rows && std::has_single_bit(static_cast<unsigned>(header.rows));
  if (!square)
    throw base::InputError(handle.location().name(), "has a grid without the pole in it",
                           "give WWMCA files on their own polar stereographic grid");
  warnings.push_back(
      {"grid_header", fmt::format("the grid in the header of {} does not hold the pole: that of the "
                                  "Air Force's mesh with {} x {} cells is taken",
                                  handle.location().name(), header.columns, header.rows)});
  return standardMesh(header.columns);
}

void GribReader::read(const std::vector<GribField>& fields, std::size_t half) {
  constexpr std::size_t kTasks = 4;  // each holds a decoded message
  for (const GribField& field : fields) provide(field.column);
  base::parallelFor(kTasks, [&](std::size_t task) {
    std::vector<double> values;
    for (const GribField& field : fields) {
      if (static_cast<std::size_t>(field.column) % kTasks != task) continue;
      grib::Handle(field.location).readValues(values, analysis_.mesh.size());
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
