// SPDX-License-Identifier: Apache-2.0
#include "cli/cloud_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "pipeline/type.hpp"

namespace cloudgen::cli {
namespace {

namespace fs = std::filesystem;
using pipeline::LayerRecord;
using scene::CloudRecord;

constexpr const char *kClouds = "clouds.csv", *kLayers = "layers.csv";

template <std::integral Number>
std::string written(Number value) {
  return std::to_string(value);
}
template <std::floating_point Number>
std::string written(Number value) {
  return std::isfinite(value) ? base::shortest(value) : std::string();
}
std::string written(base::Genus genus) { return std::string(base::abbreviation(genus)); }
std::string written(std::string_view rule) { return std::string(rule); }

/// What a number may be; integers may be anything.
struct Range {
  double low = 0, high = 0;
  bool mayBeUnknown = false;
};

template <std::integral Number>
bool read(std::string_view text, Range, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}
template <std::floating_point Number>
bool read(std::string_view text, Range range, Number& value) {
  if (text.empty()) return value = std::numeric_limits<Number>::quiet_NaN(), range.mayBeUnknown;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= range.low &&
         value <= range.high;
}
bool read(std::string_view text, Range, base::Genus& genus) {
  const auto found = base::genusFromName(text);
  if (found) genus = *found;
  return found.has_value();
}
template <class Text>
bool readRule(std::string_view text, Text& rule) {
  const auto rules = pipeline::typeRules();
  const auto found = std::find_if(rules.begin(), rules.end(), [&](auto& known) { return known.id == text; });
  if (found != rules.end()) rule = found->id;
  return found != rules.end();
}
bool read(std::string_view text, Range, std::string_view& rule) { return readRule(text, rule); }
bool read(std::string_view text, Range, std::string& rule) { return readRule(text, rule); }

/// A column of a list: how its value is written, and read with false for what cannot be.
template <class Row>
struct Column {
  std::string_view name;
  std::function<std::string(const Row&)> text;
  std::function<bool(std::string_view, Row&)> take;
};

/// `member` gives a reference to a member of a row.
template <class Row, class Member>
Column<Row> column(std::string_view name, Member member, Range range = {}) {
  return {name, [member](const Row& row) { return written(member(row)); },
          [member, range](std::string_view text, Row& row) { return read(text, range, member(row)); }};
}

// Wider than what this planet has, narrow enough for sums to stay sane.
constexpr Range kLongitude{-360, 360}, kLatitude{-90, 90}, kHeight{-20'000, 200'000}, kShare{0, 1.001},
    kOpticalDepth{0, 1e12}, kKelvin{0, 1000, true}, kPascal{0, 1e6, true}, kKIndex{-1000, 1000, true},
    kWind{-1000, 1000}, kArea{0, 1e12};

#define MEMBER(path) \
  [](auto& row) -> auto& { return row.path; }

const std::vector<Column<CloudRecord>>& cloudColumns() {
  using Row = CloudRecord;
  static const std::vector<Column<Row>> kColumns{
      column<Row>("id", MEMBER(id)),
      column<Row>("genus", MEMBER(genus)),
      column<Row>("rule", MEMBER(rule)),
      column<Row>("cell", MEMBER(cell)),
      column<Row>("layer", MEMBER(layer)),
      column<Row>("longitude", MEMBER(longitudeDegrees), kLongitude),
      column<Row>("latitude", MEMBER(latitudeDegrees), kLatitude),
      column<Row>("base_m", MEMBER(baseMeters), kHeight),
      column<Row>("top_m", MEMBER(topMeters), kHeight),
      column<Row>("optical_depth", MEMBER(opticalDepth), kOpticalDepth),
  };
  return kColumns;
}

const std::vector<Column<LayerRecord>>& layerColumns() {
  using Row = LayerRecord;
  static const std::vector<Column<Row>> kColumns{
      column<Row>("cell", MEMBER(layer.cell)),
      column<Row>("layer", MEMBER(layer.ordinal)),
      column<Row>("genus", MEMBER(layer.genus)),
      column<Row>("rule", MEMBER(layer.rule)),
      column<Row>("longitude", MEMBER(surroundings.longitudeDegrees), kLongitude),
      column<Row>("latitude", MEMBER(surroundings.latitudeDegrees), kLatitude),
      column<Row>("cell_km2", MEMBER(surroundings.cellSquareKilometers), kArea),
      column<Row>("surface_m", MEMBER(layer.surfaceMeters), kHeight),
      column<Row>("base_m", MEMBER(layer.baseMeters), kHeight),
      column<Row>("top_m", MEMBER(layer.topMeters), kHeight),
      column<Row>("cover", MEMBER(layer.fraction), kShare),
      column<Row>("liquid_optical_depth", MEMBER(layer.liquidOpticalDepth), kOpticalDepth),
      column<Row>("ice_optical_depth", MEMBER(layer.iceOpticalDepth), kOpticalDepth),
      column<Row>("base_temperature_k", MEMBER(layer.baseTemperatureK), kKelvin),
      column<Row>("top_temperature_k", MEMBER(layer.topTemperatureK), kKelvin),
      column<Row>("top_pressure_pa", MEMBER(layer.topPressurePa), kPascal),
      column<Row>("k_index_c", MEMBER(layer.kIndexC), kKIndex),
      column<Row>("wind_east_m_s", MEMBER(layer.windEast), kWind),
      column<Row>("wind_north_m_s", MEMBER(layer.windNorth), kWind),
      column<Row>("shear_east_m_s", MEMBER(layer.shearEast), kWind),
      column<Row>("shear_north_m_s", MEMBER(layer.shearNorth), kWind),
      column<Row>("patch", MEMBER(layer.patch)),
      column<Row>("patch_km2", MEMBER(surroundings.patchSquareKilometers), kArea),
      column<Row>("cover_around", MEMBER(surroundings.coverAround), kShare),
      column<Row>("optical_depth_around", MEMBER(surroundings.opticalDepthAround), kOpticalDepth),
      column<Row>("k_index_around_c", MEMBER(surroundings.kIndexAroundC), kKIndex),
  };
  return kColumns;
}

#undef MEMBER

template <class Row>
std::string headerOf(const std::vector<Column<Row>>& columns) {
  std::string header;
  for (const auto& column : columns) header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

template <class Row>
void writeList(const fs::path& file, const std::vector<Column<Row>>& columns, const std::vector<Row>& rows) {
  std::string text = headerOf(columns) + "\n";
  for (const Row& row : rows)
    for (const auto& column : columns) text += column.text(row) + (&column == &columns.back() ? '\n' : ',');
  base::writeFile(file, text);
}

constexpr const char* kBuildAgain = "build the scene again";

/// Walks the lines of a list and reads the first that `wanted` picks by its first fields.
template <class Row>
class ListReader {
 public:
  ListReader(fs::path file, const std::vector<Column<Row>>& columns)
      : file_(std::move(file)), columns_(columns) {
    std::error_code error;
    if (!fs::is_regular_file(file_, error))
      throw base::InputError(file_.string(), "is not there, or no file",
                             "name a folder that this version of `cloudgen build` made");
    stream_.open(file_, std::ios::binary);
    if (!stream_) throw base::InputError(file_.string(), "cannot be read", "check the permissions");
    if (!nextLine() || line_ != headerOf(columns_))
      throw base::InputError(file_.string(), "does not begin as this version of cloudgen writes it",
                             kBuildAgain);
  }

  /// The first row whose first fields have these values; nothing if there is none. Counts the rows it passes.
  std::optional<Row> find(const std::vector<std::uint64_t>& key) {
    while (nextLine()) {
      ++rows_;
      if (!matches(key)) continue;
      const auto fields = base::split(line_, ',');
      if (fields.size() != columns_.size())
        refuse(fmt::format("has {} fields, not {}", fields.size(), columns_.size()));
      Row row;
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (!columns_[i].take(fields[i], row))
          refuse(
              fmt::format("has no {} that makes sense: \"{}\"", columns_[i].name, fields[i].substr(0, 40)));
      return row;
    }
    return std::nullopt;
  }
  std::uint64_t rows() const { return rows_; }

 private:
  bool matches(const std::vector<std::uint64_t>& key) {
    std::string_view rest = line_;
    bool same = true;
    for (std::size_t i = 0; i < key.size(); ++i) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      std::uint64_t value = 0;
      if (!read(rest.substr(0, end), {}, value))
        refuse(fmt::format("has no {} that makes sense: \"{}\"", columns_[i].name,
                           rest.substr(0, std::min<std::size_t>(end, 40))));
      same = same && value == key[i];
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return same;
  }

  /// False at the end of the file.
  bool nextLine() {
    std::array<char, 4096> buffer;
    if (!stream_.getline(buffer.data(), buffer.size())) {
      if (stream_.eof() && stream_.gcount() == 0) return false;
      ++number_;
      refuse("is too long or cannot be read");
    }
    ++number_;
    line_ = buffer.data();
    if (line_.ends_with('\r')) line_.pop_back();
    return true;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw base::InputError(fmt::format("{}, line {}", file_.string(), number_), what, kBuildAgain);
  }

  fs::path file_;
  const std::vector<Column<Row>>& columns_;
  std::ifstream stream_;
  std::string line_;
  std::uint64_t number_ = 0, rows_ = 0;
};

}  // namespace

void writeCloudLists(const fs::path& folder, const scene::Scene& scene,
                     const std::vector<LayerRecord>& layers) {
  writeList(folder / kClouds, cloudColumns(), scene.clouds);
  writeList(folder / kLayers, layerColumns(), layers);
}

CloudRecord findCloud(const fs::path& folder, std::uint64_t id) {
  ListReader<CloudRecord> list(folder / kClouds, cloudColumns());
  const auto cloud = list.find({id});
  if (!cloud)
    throw base::InputError((folder / kClouds).string(),
                           fmt::format("has no cloud {} among its {}", id, list.rows()),
                           "its first column has the ids; so have the clouds of scene.x3d and of scene.glb");
  return *cloud;
}

LayerRecord findLayer(const fs::path& folder, const CloudRecord& cloud) {
  ListReader<LayerRecord> list(folder / kLayers, layerColumns());
  const auto layer = list.find({cloud.cell, cloud.layer});
  if (!layer)
    throw base::InputError((folder / kLayers).string(),
                           fmt::format("has no layer {} of cell {}", cloud.layer, cloud.cell), kBuildAgain);
  return *layer;
}

}  // namespace cloudgen::cli
