// SPDX-License-Identifier: Apache-2.0
// Centres: WMO common code table C-1. Processes: NCEP's ON388 table A; other centres number their runs anew
// with each version, so that their centre alone is named.
#include "input/grib/model_name.hpp"

#include <fmt/format.h>

namespace cloudgen::input::grib {
namespace {

struct Named {
  int number;
  std::string_view name;
};

/// Runs the models of NCEP that it develops.
constexpr int kNoaaResearch = 59;

constexpr Named kNcepProcesses[] = {
    {11, "GEFS"}, {81, "GFS"},  {82, "GFS"}, {83, "HRRR"},  {84, "NAM"},    {86, "RUC"},
    {89, "RUC"},  {90, "GFS"},  {96, "GFS"}, {105, "RAP"},  {107, "GEFS"},  {112, "NAM"},
    {115, "NAM"}, {116, "NAM"}, {39, "NAM"}, {134, "RRFS"}, {114, "NAEFS"}, {197, "CFS"},
};

constexpr Named kCentres[] = {
    {34, "JMA"},
    {38, "CMA"},
    {40, "KMA"},
    {54, "Environment Canada"},
    {57, "US Air Force"},
    {58, "US Navy"},
    {60, "NCAR"},
    {74, "Met Office UM"},
    {78, "DWD ICON"},
    {80, "COSMO (Rome)"},
    {82, "SMHI"},
    {84, "Meteo-France AROME"},
    {85, "Meteo-France ARPEGE"},
    {86, "FMI"},
    {88, "MET Norway"},
    {94, "DMI"},
    {96, "HNMS"},
    {98, "ECMWF IFS"},
    {99, "KNMI"},
    {215, "COSMO (Zurich)"},
    {220, "COSMO (Warsaw)"},
    {233, "Met Eireann"},
};

template <std::size_t count>
std::string_view named(const Named (&names)[count], int number) {
  for (const Named& entry : names)
    if (entry.number == number) return entry.name;
  return {};
}

}  // namespace

std::string modelName(const Product& product) {
  if (product.centre == kNcep || product.centre == kNoaaResearch) {
    const std::string_view name = named(kNcepProcesses, product.process),
                           centre = product.centre == kNcep ? "NCEP" : "NOAA";
    return name.empty() ? fmt::format("{}, process {}", centre, product.process)
                        : fmt::format("{} {}", centre, name);
  }
  const std::string_view centre = named(kCentres, product.centre);
  if (!centre.empty()) return std::string(centre);
  return fmt::format("centre {}, process {}", product.centre, product.process);
}

}  // namespace cloudgen::input::grib
