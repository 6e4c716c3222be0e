// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/meanings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace cloudgen::input::netcdf {
namespace {

using field::Quantity;
using model::CloudPart;
using model::Single;
using model::SingleKind;

/// A meaning, and by which names files call it (lower case; words parted by blanks).
struct Row {
  std::variant<Quantity, Single> what;
  Treatment treatment;
  const char* unit;           ///< what the values become; "1" for fractions
  const char* standardNames;  ///< of the CF conventions
  const char* shortNames;     ///< GRIB_shortName of cfgrib, and the usual names of variables
  const char* parameters;     ///< GRIB_paramId
  bool alongGridAxes = false;
};

constexpr Single single(SingleKind kind, CloudPart part = CloudPart::Total) { return {kind, part}; }

const std::array kOnLevels{
    Row{Quantity::CloudLiquid, Treatment::None, "1",
        "mass_fraction_of_cloud_liquid_water_in_air specific_cloud_liquid_water_content "
        "specific_cloud_water_content "
        "mass_fraction_of_stratiform_cloud_liquid_water_in_air",
        "clwc ql qc clw specific_cloud_liquid_water_content mr_lsliq liquid_water_content_ml", "246"},
    Row{Quantity::CloudIce, Treatment::None, "1",
        "mass_fraction_of_cloud_ice_in_air mass_fraction_of_cloud_ice_water_in_air "
        "specific_cloud_ice_water_content specific_cloud_ice_content "
        "mass_fraction_of_stratiform_cloud_ice_in_air",
        "ciwc qi cli icmr specific_cloud_ice_water_content ice_water_mixing_ratio mr_lsice", "247 260019"},
    Row{Quantity::CloudLiquid, Treatment::PerDryAir, "1", "cloud_liquid_water_mixing_ratio", "", ""},
    Row{Quantity::CloudIce, Treatment::PerDryAir, "1", "cloud_ice_mixing_ratio", "", ""},
    Row{Quantity::CloudCondensate, Treatment::None, "1", "mass_fraction_of_cloud_condensed_water_in_air",
        "clwmr cloud_water cloud_mixing_ratio", "260018"},
    Row{Quantity::CloudFraction, Treatment::None, "1",
        "cloud_area_fraction_in_atmosphere_layer cloud_volume_fraction_in_atmosphere_layer "
        "cloud_area_fraction",
        "cc clc cl cloud_fraction fraction_of_cloud_cover tca cldfra cloud_area_fraction", "248"},
    Row{Quantity::Temperature, Treatment::None, "K", "air_temperature",
        "t ta temperature temp tmp air_temperature t_abs", "130"},
    Row{Quantity::Temperature, Treatment::PotentialTemperature, "K", "air_potential_temperature",
        "theta potential_temperature", ""},
    Row{Quantity::RelativeHumidity, Treatment::None, "1", "relative_humidity",
        "r rh hur relhum relative_humidity", "157"},
    Row{Quantity::SpecificHumidity, Treatment::None, "1", "specific_humidity",
        "q qv hus sphum shum specific_humidity", "133"},
    Row{Quantity::SpecificHumidity, Treatment::VapourPerDryAir, "1", "humidity_mixing_ratio",
        "mixing_ratio qvapor", ""},
    Row{Quantity::GeopotentialHeight, Treatment::None, "m", "geopotential_height",
        "gh zg hgt geopotential_height", "156"},
    Row{Quantity::GeopotentialHeight, Treatment::DividedByGravity, "m2 s-2", "geopotential",
        "z phi geopotential fi", "129"},
    Row{Quantity::Height, Treatment::None, "m",
        "altitude height_above_mean_sea_level geometric_height_at_full_level_center",
        "altitude alt zfull zlev z_mc", ""},
    Row{Quantity::HeightAboveGround, Treatment::None, "m", "height", "height", ""},
    Row{Quantity::Pressure, Treatment::None, "Pa", "air_pressure pressure",
        "pressure pres p pf pfull pfl air_pressure", "54"},
    Row{Quantity::WindEast, Treatment::None, "m s-1", "eastward_wind",
        "u ua ugrd uwind u_wind u_component_of_wind eastward_wind", "131"},
    Row{Quantity::WindNorth, Treatment::None, "m s-1", "northward_wind",
        "v va vgrd vwind v_wind v_component_of_wind northward_wind", "132"},
    Row{Quantity::WindEast, Treatment::None, "m s-1", "x_wind grid_eastward_wind", "x_wind", "", true},
    Row{Quantity::WindNorth, Treatment::None, "m s-1", "y_wind grid_northward_wind", "y_wind", "", true},
    Row{Quantity::VerticalVelocity, Treatment::None, "Pa s-1", "lagrangian_tendency_of_air_pressure",
        "w omega wap vvel vertical_velocity", "135"},
};

const std::array kAlone{
    Row{single(SingleKind::SurfacePressure), Treatment::None, "Pa", "surface_air_pressure surface_pressure",
        "sp ps psfc aps sfc_pressure surface_pressure", "134"},
    Row{single(SingleKind::LogSurfacePressure), Treatment::None, "1", "", "lnsp lnps", "152"},
    Row{single(SingleKind::SeaLevelPressure), Treatment::None, "Pa",
        "air_pressure_at_sea_level air_pressure_at_mean_sea_level",
        "msl psl mslp pmsl prmsl mean_sea_level_pressure", "151"},
    Row{single(SingleKind::SurfaceHeight), Treatment::None, "m", "surface_altitude",
        "orog orography hsurf topo terrain_height sfc_height_amsl altitude zsfc", "228002"},
    Row{single(SingleKind::SurfaceHeight), Treatment::DividedByGravity, "m2 s-2",
        "surface_geopotential geopotential", "z sgp fis geopotential geopotential_at_surface", "129"},
    Row{single(SingleKind::CloudCover), Treatment::None, "1",
        "cloud_area_fraction cloud_area_fraction_in_atmosphere",
        "tcc clt clct total_cloud_cover sfc_cloud_fraction tcdc", "164 228164"},
    Row{single(SingleKind::CloudCover, CloudPart::Low), Treatment::None, "1", "low_type_cloud_area_fraction",
        "lcc cll clcl low_cloud_cover low_type_cloud_area_fraction lcdc", "186 3073"},
    Row{single(SingleKind::CloudCover, CloudPart::Middle), Treatment::None, "1",
        "medium_type_cloud_area_fraction",
        "mcc clm clcm medium_cloud_cover middle_cloud_cover medium_type_cloud_area_fraction mcdc",
        "187 3074"},
    Row{single(SingleKind::CloudCover, CloudPart::High), Treatment::None, "1",
        "high_type_cloud_area_fraction", "hcc clh clch high_cloud_cover high_type_cloud_area_fraction hcdc",
        "188 3075"},
    Row{single(SingleKind::CloudCover, CloudPart::Convective), Treatment::None, "1",
        "convective_cloud_area_fraction", "ccc convective_cloud_cover", "185"},
    Row{single(SingleKind::CloudBaseHeight), Treatment::None, "m", "cloud_base_altitude", "", ""},
    Row{single(SingleKind::CloudTopHeight), Treatment::None, "m", "cloud_top_altitude", "", ""},
    Row{single(SingleKind::CloudBaseHeight, CloudPart::Convective), Treatment::None, "m",
        "convective_cloud_base_altitude", "hbas_con hbas_sc", ""},
    Row{single(SingleKind::CloudTopHeight, CloudPart::Convective), Treatment::None, "m",
        "convective_cloud_top_altitude", "htop_con htop_sc", ""},
    Row{single(SingleKind::CloudBasePressure), Treatment::None, "Pa", "air_pressure_at_cloud_base", "", ""},
    Row{single(SingleKind::CloudTopPressure), Treatment::None, "Pa", "air_pressure_at_cloud_top", "ctp", ""},
    Row{single(SingleKind::CloudBasePressure, CloudPart::Convective), Treatment::None, "Pa",
        "air_pressure_at_convective_cloud_base", "", ""},
    Row{single(SingleKind::CloudTopPressure, CloudPart::Convective), Treatment::None, "Pa",
        "air_pressure_at_convective_cloud_top", "", ""},
};

struct Unused {
  const char* meaning;
  const char* names;
};
constexpr std::array kUnused{
    Unused{"rain",
           "crwc qr qrain mass_fraction_of_rain_in_air mass_fraction_of_rain_water_in_air "
           "specific_rain_water_content rain_mixing_ratio"},
    Unused{"snow",
           "cswc qs qsnow mass_fraction_of_snow_in_air specific_snow_water_content snow_mixing_ratio"},
    Unused{"graupel", "qg qgraup mass_fraction_of_graupel_in_air graupel_mixing_ratio grle"},
    Unused{"upward wind in m/s", "upward_air_velocity upward_wind wwind"},
    Unused{
        "convective cloud in the grid box",
        "cca mr_ccliq mr_ccice conv_cloud_fraction "
        "mass_fraction_of_convective_cloud_liquid_water_in_air mass_fraction_of_convective_cloud_ice_in_air"},
    Unused{"part of the cloud fraction", "ls_cloud_fraction large_scale_cloud_area_fraction"},
};

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool holdsWord(std::string_view words, std::string_view word) {
  if (word.empty() || word.find(' ') != std::string_view::npos) return false;
  for (std::size_t place = words.find(word); place != std::string_view::npos;
       place = words.find(word, place + 1)) {
    const std::size_t end = place + word.size();
    if ((place == 0 || words[place - 1] == ' ') && (end == words.size() || words[end] == ' ')) return true;
  }
  return false;
}

/// CF allows a modifier after a blank; "air_temperature standard_error" is no temperature.
std::string standardNameOf(const Variable& variable) { return lowerCase(variable.text("standard_name")); }

/// MET Norway marks model and pressure levels in the name.
std::string plainName(const Variable& variable) {
  std::string name = lowerCase(variable.name);
  for (const std::string_view ending : {"_ml", "_pl"})
    if (name.ends_with(ending)) name.erase(name.rfind(ending));
  return name;
}

const Row* rowOf(const Variable& variable, std::span<const Row> rows) {
  const auto find = [&](const std::string& word, const char* const Row::*names) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return holdsWord(row.*names, word); });
    return found == rows.end() ? nullptr : &*found;
  };
  if (const Row* row = find(standardNameOf(variable), &Row::standardNames)) return row;
  if (const Row* row = find(lowerCase(variable.text("GRIB_shortName")), &Row::shortNames)) return row;
  if (const auto parameter = variable.number("GRIB_paramId"); parameter && std::abs(*parameter) < 1e9)
    if (const Row* row = find(fmt::format("{}", std::llround(*parameter)), &Row::parameters)) return row;
  // A standard name that means something else outweighs the name.
  const std::string standard = standardNameOf(variable);
  if (!standard.empty() && standard != "unknown" && standard.find(' ') == std::string::npos) {
    const Row* row = find(plainName(variable), &Row::shortNames);
    return row && *row->standardNames == '\0' ? row : nullptr;
  }
  return find(plainName(variable), &Row::shortNames);
}

bool isFraction(const Row& row) {
  if (const auto* quantity = std::get_if<Quantity>(&row.what))
    return *quantity == Quantity::CloudFraction || *quantity == Quantity::RelativeHumidity;
  return std::get<Single>(row.what).kind == SingleKind::CloudCover;
}

bool isRatioOfMasses(const Row& row) {
  return std::string_view(row.unit) == "1" && std::holds_alternative<Quantity>(row.what) && !isFraction(row);
}

/// False where the unit says that the variable is something else than its name makes believe.
bool convert(const Row& row, const Variable& variable, Meaning& meaning) {
  const std::string unit = variable.text("units");
  const auto warn = [&](std::string id, const std::string& text) {
    meaning.warningId = std::move(id);
    meaning.warning = text;
  };
  // Numbers as "units" (1.f) stand in real files.
  const auto number = variable.number("units");
  if (unit.empty() && !number) {
    if (std::string_view(row.unit) != "1")
      warn("unit_missing", fmt::format("{} has no unit: taken as {}", variable.name, row.unit));
    return true;
  }
  if (number) return std::string_view(row.unit) == "1" && *number == 1;
  if (isFraction(row) && isPercent(unit)) {
    meaning.inPercent = true;
    return true;
  }
  // "r" is relative humidity in one model and a mixing ratio in another.
  if (isFraction(row) && unit.find("kg") != std::string::npos) return false;
  if (const auto found = conversion(unit, row.unit)) {
    meaning.toSi = *found;
    return !isRatioOfMasses(row) || found->offset == 0;
  }
  if (row.treatment == Treatment::DividedByGravity)
    if (const auto found = conversion(unit, "m")) {
      meaning.treatment = Treatment::None;
      meaning.toSi = *found;
      return true;
    }
  if (std::holds_alternative<Quantity>(row.what) &&
      (std::get<Quantity>(row.what) == Quantity::GeopotentialHeight))
    if (const auto found = conversion(unit, "m2 s-2")) {
      meaning.treatment = Treatment::DividedByGravity;
      meaning.toSi = *found;
      return true;
    }
  // A unit that measures something else: "w" in m/s is no pressure velocity.
  for (const char* other :
       {"m", "s", "K", "Pa", "kg m-3", "m s-1", "m2 s-2", "kg m-2", "1", "W m-2", "Pa s-1", "s-1"})
    if (conversion(unit, other)) return false;
  warn("unit_unknown", fmt::format("{} has the unit \"{}\", which UDUNITS does not know: taken as {}",
                                   variable.name, unit, row.unit));
  return true;
}

}  // namespace

std::optional<Meaning> meaningOf(const Variable& variable, bool onLevels) {
  const Row* row = onLevels ? rowOf(variable, kOnLevels) : rowOf(variable, kAlone);
  if (!row || !variable.isNumeric()) return std::nullopt;
  Meaning meaning{row->what, row->treatment, row->alongGridAxes, false, {}, {}, {}};
  if (!convert(*row, variable, meaning)) return std::nullopt;
  return meaning;
}

std::string unusedMeaning(const Variable& variable) {
  for (const Unused& unused : kUnused)
    if (holdsWord(unused.names, standardNameOf(variable)) || holdsWord(unused.names, plainName(variable)))
      return unused.meaning;
  return {};
}

}  // namespace cloudgen::input::netcdf
