// SPDX-License-Identifier: Apache-2.0
// Shares no code with the reader: geometry, type codes and the bytes of GRIB1 are written down once more.
#include "support/made_wwmca.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "base/time.hpp"

namespace cloudgen::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

int typeCode(const std::optional<base::Genus>& genus) {
  static const std::map<base::Genus, int> kCodes{
      {base::Genus::Cumulonimbus, 1},  {base::Genus::Stratus, 2},     {base::Genus::Fog, 2},
      {base::Genus::Stratocumulus, 3}, {base::Genus::Cumulus, 4},     {base::Genus::Altostratus, 5},
      {base::Genus::Nimbostratus, 6},  {base::Genus::Altocumulus, 7}, {base::Genus::Cirrostratus, 8},
      {base::Genus::Cirrus, 9},        {base::Genus::Cirrocumulus, 9}};
  return genus ? kCodes.at(*genus) : 25;
}

/// "YYYYMMDDHH" of a time.
std::string hourText(base::UtcTime time) {
  const std::string iso = base::isoText(time);
  return iso.substr(0, 4) + iso.substr(5, 2) + iso.substr(8, 2) + iso.substr(11, 2);
}

void put(std::string& bytes, std::int64_t value, int octets) {
  for (int i = octets - 1; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i));
}

/// A number of three octets with the sign in the first bit.
void putSigned3(std::string& bytes, double value) {
  const auto magnitude = static_cast<std::int64_t>(std::llround(std::abs(value)));
  put(bytes, magnitude | (value < 0 ? 0x800000 : 0), 3);
}

std::string productSection(const MadeAnalysis& analysis, int parameter, int levelType, int level) {
  const std::string hour = hourText(analysis.time);
  const auto number = [&](std::size_t from, std::size_t count) {
    return std::stoi(hour.substr(from, count));
  };
  const int year = number(0, 4);
  std::string bytes;
  put(bytes, 28, 3);
  for (const int octet : {2, 57, 0, analysis.south ? 213 : 212, 128, parameter, levelType})
    put(bytes, octet, 1);
  put(bytes, level, 2);
  for (const int octet : {(year - 1) % 100 + 1, number(4, 2), number(6, 2), number(8, 2), 0, 1, 0, 0, 0})
    put(bytes, octet, 1);
  put(bytes, 0, 2);  // number in average
  put(bytes, 0, 1);
  put(bytes, (year - 1) / 100 + 1, 1);
  put(bytes, 2, 1);  // subcentre
  put(bytes, 0, 2);  // decimal scale
  return bytes;
}

std::string gridSection(const MadeAnalysis& analysis) {
  const field::GeoPoint corner = meshCenter(analysis.size, analysis.south, 0, 0);
  const int step = static_cast<int>(std::lround(23812.5 * 1024 / analysis.size));
  std::string bytes;
  put(bytes, 32, 3);
  for (const int octet : {0, 255, 5}) put(bytes, octet, 1);
  put(bytes, analysis.size, 2);
  put(bytes, analysis.size, 2);
  // The published corner is the exact one rounded away from the equator.
  putSigned3(bytes,
             (corner.latitudeDegrees < 0 ? -1 : 1) * std::ceil(std::abs(corner.latitudeDegrees) * 1000));
  putSigned3(bytes, corner.longitudeDegrees * 1000);
  put(bytes, 128, 1);
  putSigned3(bytes, 100000);
  put(bytes, step, 3);
  put(bytes, step, 3);
  put(bytes, analysis.south ? 128 : 0, 1);
  put(bytes, 0, 1);
  put(bytes, 0, 4);
  return bytes;
}

/// Whole numbers as they are: reference value 0, no scaling.
template <class Value>
std::string dataSection(const std::vector<Value>& values, std::size_t first, std::size_t stride, int octets) {
  const std::size_t count = values.size() / stride;
  const std::size_t data = count * static_cast<std::size_t>(octets), padding = (data + 11) % 2;
  std::string bytes;
  bytes.reserve(data + 12);
  put(bytes, static_cast<std::int64_t>(data + 11 + padding), 3);
  put(bytes, static_cast<std::int64_t>(8 * padding), 1);
  put(bytes, 0, 2);
  put(bytes, 0, 4);
  put(bytes, 8 * octets, 1);
  for (std::size_t i = 0; i < count; ++i) put(bytes, values[i * stride + first], octets);
  bytes.append(padding, '\0');
  return bytes;
}

std::string fieldData(const MadeAnalysis& analysis, int parameter, std::size_t layer) {
  switch (parameter) {
    case 163:
      return dataSection(analysis.amount, layer, 4, 1);
    case 164:
      return dataSection(analysis.type, layer, 4, 1);
    case 227:
      return dataSection(analysis.base, layer, 4, 2);
    case 228:
      return dataSection(analysis.top, layer, 4, 2);
    case 185:
      return dataSection(analysis.opticalDepthTimesTen, layer, 4, 2);
    case 71:
      return dataSection(analysis.totalCover, 0, 1, 1);
    case 183:
      return dataSection(analysis.ageMinutes, 0, 1, 2);
    default:
      throw std::runtime_error("no such parameter");
  }
}

/// The layers of each cell of a sky, and which cell a place is in.
class Sampler {
 public:
  explicit Sampler(const field::Source& sky) : grid_(sky.grid()), finder_(sky.grid()) {
    std::vector<std::uint32_t> cells(grid_.size());
    for (std::uint32_t cell = 0; cell < cells.size(); ++cell) cells[cell] = cell;
    layers_.resize(cells.size());
    sky.visitLayers(cells, [&](const field::StatedLayer& layer) {
      layers_[layer.cell].push_back(layer);
      if (layers_[layer.cell].size() > 4)
        throw std::runtime_error("a cell of the sky has more than four layers");
    });
  }

  const std::vector<field::StatedLayer>& at(const field::GeoPoint& place) const {
    static const std::vector<field::StatedLayer> kClear;
    const auto cell = cellAt(place);
    return cell ? layers_[*cell] : kClear;
  }

 private:
  std::optional<std::uint32_t> cellAt(const field::GeoPoint& place) const {
    if (!grid_.crs.starts_with("+proj=longlat") || !grid_.rowY.empty()) return finder_.at(place);
    const double west = grid_.firstX - 0.5 * grid_.stepX;
    const double east = place.longitudeDegrees - west;
    const int column = static_cast<int>(std::floor((east - 360 * std::floor(east / 360)) / grid_.stepX));
    const int row = static_cast<int>(std::floor((place.latitudeDegrees - grid_.firstY) / grid_.stepY + 0.5));
    if (column >= grid_.columns || row < 0 || row >= grid_.rows) return std::nullopt;
    return grid_.index(column, row);
  }

  const field::Grid& grid_;
  field::CellFinder finder_;
  std::vector<std::vector<field::StatedLayer>> layers_;
};

void writeBytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error(file.string() + " cannot be written");
}

template <class Value>
std::string ordered(const std::vector<Value>& values, std::endian order) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(Value));
  for (const Value value : values)
    for (std::size_t i = 0; i < sizeof(Value); ++i)
      bytes += static_cast<char>(value >> (8 * (order == std::endian::big ? sizeof(Value) - 1 - i : i)));
  return bytes;
}

}  // namespace

MadeAnalysis clearAnalysis(bool south, base::UtcTime time, int size) {
  MadeAnalysis made;
  made.size = size, made.south = south, made.time = time;
  made.type.resize(made.cells() * 4);
  made.amount.resize(made.cells() * 4);
  made.base.resize(made.cells() * 4);
  made.top.resize(made.cells() * 4);
  made.opticalDepthTimesTen.resize(made.cells() * 4);
  made.totalCover.resize(made.cells());
  made.ageMinutes.resize(made.cells());
  return made;
}

field::GeoPoint meshCenter(int size, bool south, int column, int row) {
  const double x = column - size / 2, y = (south ? 1 : -1) * (row - size / 2);
  const double equator = 6371.2213 * 1.8660254 / (23.8125 * 1024 / size);
  const double c = equator * equator, r = x * x + y * y;
  const double longitude = 10 + std::atan2(y, x) / kDegree;
  return {longitude - 360 * std::floor((longitude + 180) / 360),
          (south ? -1 : 1) * std::asin((c - r) / (c + r)) / kDegree};
}

MadeAnalysis sampled(const field::Source& sky, bool south, int size) {
  MadeAnalysis made = clearAnalysis(south, sky.info().validTime, size);
  const Sampler sampler(sky);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const std::size_t first = made.slot(column, row, 0);
      double clear = 1;
      std::size_t slot = first;
      for (const field::StatedLayer& layer : sampler.at(meshCenter(size, south, column, row))) {
        made.type[slot] = static_cast<std::uint8_t>(typeCode(layer.genus));
        made.amount[slot] = static_cast<std::uint8_t>(std::lround(100 * layer.coverFraction));
        made.base[slot] = static_cast<std::int16_t>(std::lround(layer.baseMeters));
        made.top[slot] = static_cast<std::int16_t>(std::lround(layer.topMeters));
        made.opticalDepthTimesTen[slot] = static_cast<std::uint16_t>(std::lround(10 * layer.opticalDepth));
        clear *= 1 - layer.coverFraction;
        ++slot;
      }
      made.totalCover[first / 4] = static_cast<std::uint8_t>(std::lround(100 * (1 - clear)));
    }
  return made;
}

std::string wwmcaMessage(const MadeAnalysis& analysis, int parameter, int layer) {
  const bool ofLayer = parameter != 71 && parameter != 183;
  const std::string body = productSection(analysis, parameter, ofLayer ? 109 : 200, ofLayer ? layer : 0) +
                           gridSection(analysis) +
                           fieldData(analysis, parameter, static_cast<std::size_t>(layer - 1));
  std::string message = "GRIB";
  put(message, static_cast<std::int64_t>(body.size() + 12), 3);
  put(message, 1, 1);
  return message + body + "7777";
}

std::string wwmcaGrib(const MadeAnalysis& analysis) {
  std::string bytes;
  for (const int parameter : {163, 164, 227, 228, 185})
    for (int layer = 1; layer <= 4; ++layer) bytes += wwmcaMessage(analysis, parameter, layer);
  return bytes + wwmcaMessage(analysis, 71, 1) + wwmcaMessage(analysis, 183, 1);
}

std::filesystem::path writeWwmcaGrib(const MadeAnalysis& analysis, const std::filesystem::path& folder) {
  const auto file =
      folder / ("WWMCA_" + hourText(analysis.time) + (analysis.south ? "_S" : "_N") + "_16_M.GR1");
  writeBytes(file, wwmcaGrib(analysis));
  return file;
}

std::vector<std::filesystem::path> writeWwmcaRaw(const MadeAnalysis& analysis,
                                                 const std::filesystem::path& folder, std::endian order) {
  const std::int64_t now = (analysis.time.seconds - base::utcFromCivil(1967, 12, 31).seconds) / 60;
  std::vector<std::int32_t> times;
  for (const std::uint16_t age : analysis.ageMinutes) times.push_back(static_cast<std::int32_t>(now - age));
  const std::string ending = (analysis.south ? "SH_" : "NH_") + hourText(analysis.time);
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& prefix, const std::string& bytes) {
    files.push_back(folder / (prefix + ending));
    writeBytes(files.back(), bytes);
  };
  write("WWMCA_LYRD_CLOUD_TYPE_", ordered(analysis.type, order));
  write("WWMCA_LYRD_CLOUD_PCTS_", ordered(analysis.amount, order));
  write("WWMCA_LYRD_TOPS_HGHTS_", ordered(analysis.top, order));
  write("WWMCA_PIXL_TIME_MEANS_", ordered(times, order));
  write("WWMCA_TOTAL_CLOUD_PCT_", ordered(analysis.totalCover, order));
  return files;
}

}  // namespace cloudgen::test
