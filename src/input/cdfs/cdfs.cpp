// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/cdfs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <map>
#include <set>

#include "base/error.hpp"
#include "input/cdfs/grib_fields.hpp"
#include "input/cdfs/placed_layer.hpp"
#include "input/cdfs/raw_files.hpp"
#include "input/cdfs/rules.hpp"

namespace cloudgen::input {
namespace {

using namespace cdfs;

/// What there is of one hemisphere at one hour.
struct Half {
  std::vector<RawFile> raw;
  std::vector<GribField> grib;
};
using Hour = std::map<Hemisphere, Half>;

struct Inventory {
  std::map<base::UtcTime, Hour> hours;
  std::vector<std::string> unused;
};

Inventory inventoryOf(const std::vector<std::filesystem::path>& files) {
  Inventory inventory;
  for (const auto& file : files) {
    if (auto raw = rawFileOf(file)) {
      inventory.hours[raw->time][raw->half].raw.push_back(std::move(*raw));
      continue;
    }
    for (GribField& field : gribFieldsOf(file, inventory.unused))
      inventory.hours[field.time][field.half].grib.push_back(std::move(field));
  }
  return inventory;
}

std::string nameOf(Hemisphere half) { return half == Hemisphere::North ? "north" : "south"; }

base::UtcTime chosenTime(const Inventory& inventory, const OpenOptions& options, const std::string& where) {
  if (inventory.hours.empty())
    throw base::InputError(where, "holds no field of a cloud analysis", "check that it is the right file");
  if (!options.time) return inventory.hours.begin()->first;
  if (inventory.hours.contains(*options.time)) return *options.time;
  std::vector<std::string> times;
  for (const auto& [time, hour] : inventory.hours) times.push_back(base::isoText(time));
  throw base::InputError(where, fmt::format("has nothing for {}", base::isoText(*options.time)),
                         fmt::format("there is {}", fmt::join(times, ", ")));
}

/// The same kind of file twice, for the same hemisphere and hour, is a mistake.
void refuseTwice(const Half& half) {
  for (std::size_t i = 0; i < half.raw.size(); ++i)
    for (std::size_t k = i + 1; k < half.raw.size(); ++k)
      if (half.raw[i].field == half.raw[k].field)
        throw base::InputError(half.raw[k].path.string(),
                               fmt::format("is there twice ({})", half.raw[i].path.string()),
                               "give each file once");
  std::map<std::pair<GribColumn, std::size_t>, const GribField*> seen;
  for (const GribField& field : half.grib)
    if (const auto [first, added] = seen.try_emplace({field.column, field.layer}, &field); !added)
      throw base::InputError(field.head.location.name(),
                             fmt::format("repeats {}", first->second->head.location.name()),
                             "give each file once");
}

/// Makes an analysis of what there is at one hour.
class Reading {
 public:
  Reading(const Hour& hour, base::UtcTime time) : hour_(hour) {
    analysis_.time = time;
    for (const auto& [half, files] : hour) {
      refuseTwice(files);
      analysis_.halves.push_back(half);
    }
  }

  Analysis of(const OpenOptions& options, int size) {
    settleMesh(size);
    GribReader gribReader(analysis_);
    std::size_t number = 0;
    for (const auto& [half, files] : hour_) {
      if (!files.grib.empty())
        readGrib(files, number, gribReader);
      else
        readRawFiles(files, number, options);
      ++number;
    }
    gribReader.finish();
    analysis_.format = !formats_.contains("raw") ? fmt::format("WWMCA {}", *formats_.begin())
                       : formats_.size() > 1     ? "WWMCA GRIB and raw binary"
                                                 : "WWMCA raw binary";
    refuseHollow();
    return std::move(analysis_);
  }

 private:
  void settleMesh(int size) {
    std::optional<Mesh> mesh;
    for (const auto& [half, files] : hour_) {
      const Mesh own = files.grib.empty() ? standardMesh(size) : meshOf(files.grib, analysis_.warnings);
      if (mesh && *mesh != own)
        throw base::InputError("WWMCA files", "have different grids in the north and in the south",
                               "give files of one kind");
      mesh = own;
    }
    analysis_.mesh = *mesh;
    const auto isGrib2 = [](const GribField& field) { return field.head.location.edition == 2; };
    for (const auto& [half, files] : hour_)
      if (std::any_of(files.grib.begin(), files.grib.end(), isGrib2)) analysis_.table = TypeTable::Wmo;
  }

  void readGrib(const Half& files, std::size_t number, GribReader& reader) {
    for (const GribField& field : files.grib) {
      addFile(*field.head.location.file);
      formats_.insert(field.head.location.edition == 1 ? "GRIB1" : "GRIB2");
      if ((field.head.location.edition == 2) != (analysis_.table == TypeTable::Wmo))
        throw base::InputError(field.head.location.name(), "mixes GRIB1 and GRIB2, whose type tables differ",
                               "give files of one edition");
    }
    reader.read(files.grib, number);
    for (const RawFile& file : files.raw)
      analysis_.unused.push_back(fmt::format("{}: GRIB messages say the same", file.path.string()));
  }

  void readRawFiles(const Half& files, std::size_t number, const OpenOptions& options) {
    if (analysis_.table != TypeTable::Afwa)
      throw base::InputError(files.raw.front().path.string(),
                             "stands beside GRIB2 files, whose type table differs", "give files of one kind");
    for (const RawFile& file : files.raw) addFile(file.path);
    formats_.insert("raw");
    readRaw(files.raw, number, options.byteOrder, analysis_);
  }

  void addFile(const std::filesystem::path& path) {
    const std::string name = path.string();
    if (std::find(analysis_.files.begin(), analysis_.files.end(), name) == analysis_.files.end())
      analysis_.files.push_back(name);
  }

  void refuseHollow() const {
    const std::string where = analysis_.files.front();
    if (analysis_.amount.empty())
      throw base::InputError(where, "and what is with it hold no cloud amounts of layers",
                             "add WWMCA_LYRD_CLOUD_PCTS, or GRIB parameter 163");
    if (analysis_.top.empty() && analysis_.base.empty())
      throw base::InputError(where, "and what is with it hold no heights of layers",
                             "add WWMCA_LYRD_TOPS_HGHTS, or GRIB parameter 228");
  }

  const Hour& hour_;
  Analysis analysis_;
  std::set<std::string> formats_;
};

class CdfsSource : public field::Source {
 public:
  CdfsSource(Analysis analysis, const Inventory& inventory)
      : analysis_(std::move(analysis)), grid_(gridOf(analysis_.mesh, analysis_.halves)) {
    info_.files = analysis_.files;
    info_.format = analysis_.format;
    info_.model = "US Air Force CDFS II";
    info_.validTime = analysis_.time;
    for (const auto& [time, hour] : inventory.hours) info_.validTimes.push_back(time);
    info_.unused = analysis_.unused;
    info_.unused.insert(info_.unused.end(), inventory.unused.begin(), inventory.unused.end());
    info_.warnings = analysis_.warnings;
    tellFields();
    tellMissing();
  }

  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return grid_; }
  field::Telling telling() const override { return field::Telling::Layers; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const field::Level&)>&) const override {}

  void visitLayers(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::StatedLayer&)>& visit) const override {
    for (const std::uint32_t cell : cells) {
      assert(cell < analysis_.cells());
      const std::uint8_t* const amounts = analysis_.amount.data() + cell * kLayers;
      std::uint32_t any = 0;
      std::memcpy(&any, amounts, sizeof any);
      if (any != 0) visitCell(cell, amounts, visit);
    }
  }

 private:
  void visitCell(std::uint32_t cell, const std::uint8_t* amounts,
                 const std::function<void(const field::StatedLayer&)>& visit) const {
    struct Told {
      PlacedLayer placed;
      float cover = 0;
    };
    std::array<Told, kLayers> upwards;
    std::size_t count = 0;
    for (std::size_t k = 0; k < kLayers; ++k) {
      if (amounts[k] == 0) continue;
      const auto placed = placedLayer(analysis_, cell * kLayers + k);
      if (!placed) continue;
      std::size_t place = count++;
      for (; place > 0 && placed->baseMeters < upwards[place - 1].placed.baseMeters; --place)
        upwards[place] = upwards[place - 1];
      upwards[place] = {*placed, 0.01f * amounts[k]};
    }
    field::StatedLayer layer;
    layer.cell = cell;
    if (!analysis_.ageMinutes.empty())
      layer.ageMinutes = static_cast<std::uint16_t>(std::max<std::int16_t>(0, analysis_.ageMinutes[cell]));
    for (std::size_t i = 0; i < count; ++i) {
      const PlacedLayer& placed = upwards[i].placed;
      layer.genus = placed.kind->genus;
      layer.coverFraction = upwards[i].cover;
      layer.baseMeters = placed.baseMeters;
      layer.topMeters = placed.topMeters;
      layer.opticalDepth = placed.opticalDepth;
      layer.iceShare = placed.kind->iceShare;
      visit(layer);
    }
  }

  void tellFields() {
    const auto tell = [&](bool there, std::string line) {
      if (there) info_.fields.push_back(std::move(line));
    };
    tell(true, "cover: layer cloud amount, per cent, four floating layers");
    tell(!analysis_.type.empty(),
         fmt::format("genus: layer cloud type by the {} table", tableName(analysis_.table)));
    tell(!analysis_.base.empty(), "base: layer cloud base, m");
    tell(!analysis_.top.empty(), "top: layer cloud top, m");
    tell(!analysis_.opticalDepth.empty(), "optical depth: layer cloud optical depth");
    tell(!analysis_.ageMinutes.empty(), "age: time of the last update of the cell");
    tell(!analysis_.totalCover.empty(), "total cover: compared with the layers, not used");
    const Mesh& mesh = analysis_.mesh;
    tell(true,
         fmt::format("grid: {} x {} cells of {:g} m at 60 degrees, pole at ({:g}, {:g}), {}", mesh.columns,
                     mesh.rows, mesh.stepX, 1 - mesh.firstX / mesh.stepX, 1 - mesh.firstY / mesh.stepY,
                     analysis_.halves.size() == 2 ? "north and south joined at the equator"
                                                  : nameOf(analysis_.halves.front()) + " only"));
    info_.fields.insert(info_.fields.end(), analysis_.fields.begin(), analysis_.fields.end());
  }

  void tellMissing() {
    const auto miss = [&](bool absent, const char* line) {
      if (absent) info_.missing.push_back(line);
    };
    miss(analysis_.type.empty(), "cloud type: the genus is left to the type rules");
    miss(analysis_.base.empty(), "cloud base: top minus a depth by type");
    miss(analysis_.top.empty(), "cloud top: base plus a depth by type");
    miss(analysis_.opticalDepth.empty(), "optical depth: typical of the type");
    miss(analysis_.ageMinutes.empty(), "times of update: no layer is dropped for its age");
    miss(true, "fog: CDFS II does not analyse it");
    miss(true, "share of ice, wind and shear: by type; none");
    info_.warnings.push_back({"heights_assumed_msl",
                              "the files do not say what heights are above: they are taken as above mean sea "
                              "level, not above ground"});
  }

  Analysis analysis_;
  field::Grid grid_;
  field::SourceInfo info_;
};

}  // namespace

bool isCdfs(const std::filesystem::path& file, std::string_view firstBytes) {
  return rawFileOf(file).has_value() || startsLikeWwmca(firstBytes);
}

std::unique_ptr<field::Source> openCdfs(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options) {
  return openCdfs(files, options, kSixteenthMesh);
}

std::unique_ptr<field::Source> openCdfs(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options, int size) {
  assert(!files.empty());
  const Inventory inventory = inventoryOf(files);
  const std::string where =
      files.size() == 1 ? files.front().string() : fmt::format("{} WWMCA files", files.size());
  const base::UtcTime time = chosenTime(inventory, options, where);
  Analysis analysis = Reading(inventory.hours.at(time), time).of(options, size);
  applyRules(analysis);
  return std::make_unique<CdfsSource>(std::move(analysis), inventory);
}

}  // namespace cloudgen::input
