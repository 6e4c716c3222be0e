// SPDX-License-Identifier: Apache-2.0
#include "input/grib/parameter.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::input::grib {
namespace {

constexpr int kAnyCentre = -1;

struct Numbered {
  int discipline, category, number, centre;
  Parameter parameter;
};

/// WMO code tables 4.2, and local numbers (from 192) of the centres that have them.
constexpr Numbered kEdition2[] = {
    {0, 0, 0, kAnyCentre, {What::Temperature, "t"}},
    {0, 1, 0, kAnyCentre, {What::SpecificHumidity, "q"}},
    {0, 1, 1, kAnyCentre, {What::RelativeHumidity, "r", true}},
    {0, 1, 2, kAnyCentre, {What::HumidityMixingRatio, "mixr"}},
    {0, 1, 22, kAnyCentre, {What::CloudCondensate, "clwmr"}},
    {0, 1, 23, kAnyCentre, {What::CloudIce, "icmr"}},
    {0, 1, 24, kAnyCentre, {What::Rain, "rwmr"}},
    {0, 1, 25, kAnyCentre, {What::Snow, "snmr"}},
    {0, 1, 32, kAnyCentre, {What::Graupel, "grle"}},
    {0, 1, 82, kAnyCentre, {What::CloudIce, "cimixr"}},
    {0, 1, 83, kAnyCentre, {What::CloudLiquid, "clwc"}},
    {0, 1, 84, kAnyCentre, {What::CloudIce, "ciwc"}},
    {0, 1, 85, kAnyCentre, {What::Rain, "crwc"}},
    {0, 1, 86, kAnyCentre, {What::Snow, "cswc"}},
    {0, 1, 201, kOffenbach, {What::Graupel, "QG"}},
    {0, 2, 2, kAnyCentre, {What::WindEast, "u"}},
    {0, 2, 3, kAnyCentre, {What::WindNorth, "v"}},
    {0, 2, 8, kAnyCentre, {What::VerticalVelocity, "w"}},
    {0, 3, 0, kAnyCentre, {What::Pressure, "pres"}},
    {0, 3, 1, kAnyCentre, {What::SeaLevelPressure, "prmsl"}},
    {0, 3, 192, kNcep, {What::SeaLevelPressure, "mslet"}},
    {0, 3, 198, kNcep, {What::SeaLevelPressure, "mslma"}},
    {0, 3, 4, kAnyCentre, {What::Geopotential, "z"}},
    {0, 3, 5, kAnyCentre, {What::GeopotentialHeight, "gh"}},
    {0, 3, 6, kAnyCentre, {What::Height, "h"}},
    {0, 3, 25, kAnyCentre, {What::LogSurfacePressure, "lnsp"}},
    {0, 6, 1, kAnyCentre, {What::Cover, "tcc", true}},
    {0, 6, 2, kAnyCentre, {What::ConvectiveCover, "ccc", true}},
    {0, 6, 3, kAnyCentre, {What::LowCover, "lcc", true}},
    {0, 6, 4, kAnyCentre, {What::MiddleCover, "mcc", true}},
    {0, 6, 5, kAnyCentre, {What::HighCover, "hcc", true}},
    {0, 6, 11, kAnyCentre, {What::CloudBaseHeight, "cdcb"}},
    {0, 6, 12, kAnyCentre, {What::CloudTopHeight, "cdct"}},
    {0, 6, 22, kAnyCentre, {What::Cover, "ccl", true}},
    {0, 6, 26, kAnyCentre, {What::ConvectiveCloudBaseHeight, "HBAS_CON"}},
    {0, 6, 27, kAnyCentre, {What::ConvectiveCloudTopHeight, "HTOP_CON"}},
    {0, 6, 32, kAnyCentre, {What::Cover, "cc"}},
    {0, 6, 199, kOffenbach, {What::Cover, "CLCT_MOD"}},
    {2, 0, 7, kAnyCentre, {What::Height, "mterh"}},
    {192, 128, 54, kEcmwf, {What::Pressure, "pres"}},
    {192, 128, 75, kEcmwf, {What::Rain, "crwc"}},
    {192, 128, 76, kEcmwf, {What::Snow, "cswc"}},
    {192, 128, 129, kEcmwf, {What::Geopotential, "z"}},
    {192, 128, 152, kEcmwf, {What::LogSurfacePressure, "lnsp"}},
    {192, 128, 164, kEcmwf, {What::Cover, "tcc"}},
    {192, 128, 185, kEcmwf, {What::ConvectiveCover, "ccc"}},
    {192, 128, 186, kEcmwf, {What::LowCover, "lcc"}},
    {192, 128, 187, kEcmwf, {What::MiddleCover, "mcc"}},
    {192, 128, 188, kEcmwf, {What::HighCover, "hcc"}},
    {192, 128, 246, kEcmwf, {What::CloudLiquid, "clwc"}},
    {192, 128, 247, kEcmwf, {What::CloudIce, "ciwc"}},
    {192, 128, 248, kEcmwf, {What::Cover, "cc"}},
};

struct Listed {
  int number, centre;
  Parameter parameter;
};

/// Edition 1, WMO code table 2 (versions up to 127), and what NCEP adds to it above 127.
constexpr Listed kTable2[] = {
    {1, kAnyCentre, {What::Pressure, "pres"}},
    {2, kAnyCentre, {What::SeaLevelPressure, "prmsl"}},
    {6, kAnyCentre, {What::Geopotential, "z"}},
    {7, kAnyCentre, {What::GeopotentialHeight, "gh"}},
    {8, kAnyCentre, {What::Height, "h"}},
    {11, kAnyCentre, {What::Temperature, "t"}},
    {33, kAnyCentre, {What::WindEast, "u"}},
    {34, kAnyCentre, {What::WindNorth, "v"}},
    {39, kAnyCentre, {What::VerticalVelocity, "w"}},
    {51, kAnyCentre, {What::SpecificHumidity, "q"}},
    {52, kAnyCentre, {What::RelativeHumidity, "r", true}},
    {53, kAnyCentre, {What::HumidityMixingRatio, "mixr"}},
    {71, kAnyCentre, {What::Cover, "tcc", true}},
    {72, kAnyCentre, {What::ConvectiveCover, "ccc", true}},
    {73, kAnyCentre, {What::LowCover, "lcc", true}},
    {74, kAnyCentre, {What::MiddleCover, "mcc", true}},
    {75, kAnyCentre, {What::HighCover, "hcc", true}},
    {130, kNcep, {What::SeaLevelPressure, "mslet"}},
    {153, kNcep, {What::CloudCondensate, "clwmr"}},
    {170, kNcep, {What::Rain, "rwmr"}},
    {171, kNcep, {What::Snow, "snmr"}},
    {178, kNcep, {What::CloudIce, "icmr"}},
    {179, kNcep, {What::Graupel, "grmr"}},
};

/// ECMWF's table 128.
constexpr Listed kTable128[] = {
    {54, kAnyCentre, {What::Pressure, "pres"}},
    {75, kAnyCentre, {What::Rain, "crwc"}},
    {76, kAnyCentre, {What::Snow, "cswc"}},
    {129, kAnyCentre, {What::Geopotential, "z"}},
    {130, kAnyCentre, {What::Temperature, "t"}},
    {131, kAnyCentre, {What::WindEast, "u"}},
    {132, kAnyCentre, {What::WindNorth, "v"}},
    {133, kAnyCentre, {What::SpecificHumidity, "q"}},
    {134, kAnyCentre, {What::Pressure, "sp"}},
    {135, kAnyCentre, {What::VerticalVelocity, "w"}},
    {151, kAnyCentre, {What::SeaLevelPressure, "msl"}},
    {152, kAnyCentre, {What::LogSurfacePressure, "lnsp"}},
    {156, kAnyCentre, {What::GeopotentialHeight, "gh"}},
    {157, kAnyCentre, {What::RelativeHumidity, "r", true}},
    {164, kAnyCentre, {What::Cover, "tcc"}},
    {185, kAnyCentre, {What::ConvectiveCover, "ccc"}},
    {186, kAnyCentre, {What::LowCover, "lcc"}},
    {187, kAnyCentre, {What::MiddleCover, "mcc"}},
    {188, kAnyCentre, {What::HighCover, "hcc"}},
    {246, kAnyCentre, {What::CloudLiquid, "clwc"}},
    {247, kAnyCentre, {What::CloudIce, "ciwc"}},
    {248, kAnyCentre, {What::Cover, "cc"}},
};

/// DWD's table 201 (COSMO, GME).
constexpr Listed kTable201[] = {
    {29, kAnyCentre, {What::Cover, "CLC", true}},
    {31, kAnyCentre, {What::CloudCondensate, "QC"}},
    {33, kAnyCentre, {What::CloudIce, "QI"}},
    {35, kAnyCentre, {What::Rain, "QR"}},
    {36, kAnyCentre, {What::Snow, "QS"}},
    {39, kAnyCentre, {What::Graupel, "QG"}},
    {68, kAnyCentre, {What::ConvectiveCloudBaseHeight, "HBAS_CON"}},
    {69, kAnyCentre, {What::ConvectiveCloudTopHeight, "HTOP_CON"}},
};

/// HARMONIE's table 253; what is not here is as in table 2.
constexpr Listed kTable253[] = {
    {58, kAnyCentre, {What::CloudIce, "ciwc"}},    {71, kAnyCentre, {What::Cover, "tcc"}},
    {76, kAnyCentre, {What::CloudLiquid, "clwc"}}, {181, kAnyCentre, {What::Rain, "crwc"}},
    {184, kAnyCentre, {What::Snow, "cswc"}},       {201, kAnyCentre, {What::Graupel, "grle"}},
};

/// ecCodes' short names of what the numbers above do not tell.
constexpr std::pair<std::string_view, Parameter> kNames[] = {
    {"clwmr", {What::CloudCondensate, "clwmr"}},
    {"icmr", {What::CloudIce, "icmr"}},
    {"clwc", {What::CloudLiquid, "clwc"}},
    {"ciwc", {What::CloudIce, "ciwc"}},
    {"cc", {What::Cover, "cc"}},
    {"QC", {What::CloudCondensate, "QC"}},
    {"QI", {What::CloudIce, "QI"}},
    {"CLC", {What::Cover, "CLC", true}},
    {"CLCT", {What::Cover, "CLCT", true}},
    {"CLCL", {What::LowCover, "CLCL", true}},
    {"CLCM", {What::MiddleCover, "CLCM", true}},
    {"CLCH", {What::HighCover, "CLCH", true}},
    {"t", {What::Temperature, "t"}},
    {"q", {What::SpecificHumidity, "q"}},
    {"r", {What::RelativeHumidity, "r", true}},
    {"gh", {What::GeopotentialHeight, "gh"}},
    {"z", {What::Geopotential, "z"}},
    {"pres", {What::Pressure, "pres"}},
    {"sp", {What::Pressure, "sp"}},
    {"lnsp", {What::LogSurfacePressure, "lnsp"}},
    {"msl", {What::SeaLevelPressure, "msl"}},
    {"prmsl", {What::SeaLevelPressure, "prmsl"}},
    {"u", {What::WindEast, "u"}},
    {"v", {What::WindNorth, "v"}},
    {"w", {What::VerticalVelocity, "w"}},
    {"crwc", {What::Rain, "crwc"}},
    {"cswc", {What::Snow, "cswc"}},
};

/// NCEP's own, and those that use its tables: US Air Force and Navy, NOAA's research, NCAR.
bool usesNcepTables(int centre) { return centre == kNcep || (centre >= 57 && centre <= 60); }

bool isOf(int tableCentre, int centre) {
  return tableCentre == kAnyCentre || tableCentre == centre ||
         (tableCentre == kNcep && usesNcepTables(centre));
}

template <std::size_t count>
std::optional<Parameter> listed(const Listed (&table)[count], const Product& product) {
  for (const Listed& entry : table)
    if (entry.number == product.number && isOf(entry.centre, product.centre)) return entry.parameter;
  return std::nullopt;
}

std::optional<Parameter> parameterOf1(const Product& product) {
  if (product.table == 128 && product.centre == kEcmwf) return listed(kTable128, product);
  if (product.table == 201) return listed(kTable201, product);
  if (product.table == 253)
    if (const auto own = listed(kTable253, product)) return own;
  const bool standard = product.table <= 127 || product.table == 253;
  return standard ? listed(kTable2, product) : std::nullopt;
}

}  // namespace

std::optional<Parameter> parameterOf(const Product& product) {
  if (product.edition == 1) return parameterOf1(product);
  for (const Numbered& entry : kEdition2)
    if (entry.discipline == product.discipline && entry.category == product.category &&
        entry.number == product.number && isOf(entry.centre, product.centre))
      return entry.parameter;
  return std::nullopt;
}

bool hasOwnNumbers(const Product& product) {
  constexpr int kLocal1 = 128, kLocal2 = 192;
  // What NCEP adds is in the tables above.
  if (usesNcepTables(product.centre)) return false;
  if (product.edition == 1) return product.table >= kLocal1 || product.number >= kLocal1;
  return product.discipline >= kLocal2 || product.category >= kLocal2 || product.number >= kLocal2;
}

std::optional<Parameter> parameterNamed(std::string_view shortName) {
  for (const auto& [name, parameter] : kNames)
    if (name == shortName) return parameter;
  return std::nullopt;
}

}  // namespace cloudgen::input::grib
