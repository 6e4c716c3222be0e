// SPDX-License-Identifier: Apache-2.0
// WMO Manual on Codes, FM 92 GRIB: grid definition templates of edition 2 (3.0 to 3.140), and NCEP's 3.32769;
// grid description sections of edition 1 (code table 6).
#include "input/grib/grid_section.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "input/grib/octets.hpp"

namespace cloudgen::input::grib {
namespace {

[[noreturn]] void notRead(const Octets& octets, const std::string& type, const std::string& hint) {
  throw base::InputError(octets.where(), fmt::format("is on {}, which cannot be placed", type), hint);
}

constexpr const char* kRegrid =
    "bring it to latitudes and longitudes first, as with `cdo remapbil,r720x361 in.grb out.grb`";

[[noreturn]] void refuse2(const Octets& octets, int type) {
  if (type >= 50 && type <= 63)
    notRead(octets, fmt::format("spherical harmonics (grid template 3.{})", type),
            "bring it to a grid first, as with `cdo sp2gpl in.grb out.grb`");
  if (type == 100 || type == 101)
    notRead(octets, fmt::format("an unstructured grid of triangles (grid template 3.{})", type),
            "take the provider's regular latitude-longitude files, or regrid it with its description: "
            "`cdo remapdis,r720x361 -setgrid,icon_grid.nc in.grb out.grb`");
  if (type == 90) notRead(octets, "a space view (grid template 3.90)", kRegrid);
  if (type == 150) notRead(octets, "a HEALPix grid (grid template 3.150)", kRegrid);
  if (type == 32768) notRead(octets, "NCEP's staggered E grid (grid template 3.32768)", kRegrid);
  notRead(octets, fmt::format("a grid of template 3.{}", type), kRegrid);
}

[[noreturn]] void refuse1(const Octets& octets, int type) {
  if (type >= 50 && type <= 80)
    notRead(octets, fmt::format("spherical harmonics (grid type {})", type),
            "bring it to a grid first, as with `cdo sp2gpl in.grb out.grb`");
  if (type == 90) notRead(octets, "a space view (grid type 90)", kRegrid);
  if (type == 192) notRead(octets, "an unstructured grid of triangles (grid type 192)", kRegrid);
  if (type >= 201 && type <= 203)
    notRead(octets, fmt::format("NCEP's staggered E grid (grid type {})", type), kRegrid);
  notRead(octets, fmt::format("a grid of type {}", type), kRegrid);
}

std::string sphere(double radius) { return fmt::format("+R={}", radius); }

std::string spheroid(double major, double minor) { return fmt::format("+a={} +b={}", major, minor); }

/// Code table 3.2.
std::string ellipsoid2(const Octets& octets) {
  constexpr double kUsualRadius = 6371229, kLeast = 6.0e6, kMost = 6.8e6;
  const auto plausible = [&](std::optional<double> meters) {
    return meters && *meters > kLeast && *meters < kMost;
  };
  const auto radius = octets.scaledIfAny(16), major = octets.scaledIfAny(21), minor = octets.scaledIfAny(26);
  switch (octets.whole(15, 1)) {
    case 0:
      return sphere(6367470);
    case 1:
      return sphere(plausible(radius) ? *radius : kUsualRadius);
    case 2:
      return spheroid(6378160, 6356775);
    case 3:
      if (major && minor && plausible(*major * 1000) && plausible(*minor * 1000))
        return spheroid(*major * 1000, *minor * 1000);
      return sphere(kUsualRadius);
    case 4:
      return spheroid(6378137, 6356752.314140);
    case 5:
      return spheroid(6378137, 6356752.314245);
    case 7:
      return plausible(major) && plausible(minor) ? spheroid(*major, *minor) : sphere(kUsualRadius);
    case 8:
      return sphere(6371200);
    case 9:
      return spheroid(6377563.396, 6356256.909);
    default:
      return sphere(kUsualRadius);
  }
}

/// Section 3 of edition 2, its angles in the unit that it states.
class Section2 {
 public:
  explicit Section2(const Octets& octets, GridSection& section) : o_(octets), s_(section) {}

  void read() {
    const int type = static_cast<int>(o_.whole(13, 2));
    s_.points = o_.whole(7, 4);
    if (o_.whole(6, 1) != 0)
      notRead(o_, "a grid that its section does not define", "add the definition with ecCodes' grib_set");
    switch (type) {
      case 0:
      case 1:
      case 40:
      case 41:
        readDegrees(type);
        break;
      case 32769:
        readAboutCenter();
        break;
      case 10:
        readMercator();
        break;
      case 12:
        readTransverse();
        break;
      case 20:
      case 30:
      case 31:
        readConic(type);
        break;
      case 140:
        readAzimuthal();
        break;
      default:
        refuse2(o_, type);
    }
    s_.ellipsoid = ellipsoid2(o_);
    readList();
  }

 private:
  static constexpr double kMicro = 1e-6, kMilli = 1e-3;

  double degrees(std::size_t octet) const { return unit_ * static_cast<double>(o_.withSign(octet, 4)); }
  std::optional<double> lengthIfAny(std::size_t octet, double unit) const {
    const auto value = o_.wholeIfAny(octet, 4);
    return value && *value > 0 ? std::optional(unit * static_cast<double>(*value)) : std::nullopt;
  }
  void readSize() {
    s_.columns = o_.wholeIfAny(31, 4);
    s_.rows = o_.wholeIfAny(35, 4);
  }
  void readFlags(std::size_t flags, std::size_t scanning) {
    s_.windsAlongAxes = (o_.whole(flags, 1) & 0x08) != 0;
    s_.scanning = static_cast<int>(o_.whole(scanning, 1));
  }
  void readAngleUnit() {
    const auto basic = o_.wholeIfAny(39, 4), parts = o_.wholeIfAny(43, 4);
    if (basic && parts && *basic > 0 && *parts > 0)
      unit_ = static_cast<double>(*basic) / static_cast<double>(*parts);
  }

  void readDegrees(int type) {
    readSize();
    readAngleUnit();
    s_.kind = type >= 40 ? GridKind::Gaussian : GridKind::LatLon;
    s_.firstLatitude = degrees(47);
    s_.firstLongitude = degrees(51);
    s_.lastLatitude = degrees(56);
    s_.lastLongitude = degrees(60);
    readFlags(55, 72);
    s_.stepX = lengthIfAny(64, unit_);
    if (type >= 40)
      s_.gaussianNumber = o_.whole(68, 4);
    else
      s_.stepY = lengthIfAny(68, unit_);
    listFrom_ = 73;
    if (type == 1 || type == 41) {
      s_.rotated = true;
      s_.southPoleLatitude = degrees(73);
      s_.southPoleLongitude = degrees(77);
      s_.rotationAngle = o_.ieee(81);
      listFrom_ = 85;
    }
  }

  void readAboutCenter() {
    readSize();
    readAngleUnit();
    s_.kind = GridKind::AboutCenter;
    s_.rotated = true;
    s_.firstLatitude = degrees(47);
    s_.firstLongitude = degrees(51);
    s_.centerLatitude = degrees(56);
    s_.centerLongitude = degrees(60);
    readFlags(55, 72);
    s_.stepX = lengthIfAny(64, unit_);
    s_.stepY = lengthIfAny(68, unit_);
    if (o_.has(73, 8)) {
      s_.lastLatitude = degrees(73);
      s_.lastLongitude = degrees(77);
    }
  }

  void readMercator() {
    readSize();
    s_.kind = GridKind::Mercator;
    s_.firstLatitude = degrees(39);
    s_.firstLongitude = degrees(43);
    readFlags(47, 60);
    s_.trueLatitude = degrees(48);
    s_.lastLatitude = degrees(52);
    s_.lastLongitude = degrees(56);
    s_.rotationAngle = degrees(61);
    s_.stepX = lengthIfAny(65, kMilli);
    s_.stepY = lengthIfAny(69, kMilli);
  }

  void readTransverse() {
    constexpr double kCenti = 1e-2;
    readSize();
    s_.kind = GridKind::TransverseMercator;
    s_.centerLatitude = degrees(39);
    s_.centerLongitude = degrees(43);
    readFlags(47, 60);
    s_.scaleAtCenter = o_.ieee(48);
    s_.falseEasting = kCenti * static_cast<double>(o_.withSign(52, 4));
    s_.falseNorthing = kCenti * static_cast<double>(o_.withSign(56, 4));
    s_.stepX = lengthIfAny(61, kCenti);
    s_.stepY = lengthIfAny(65, kCenti);
    s_.firstX = kCenti * static_cast<double>(o_.withSign(69, 4));
    s_.firstY = kCenti * static_cast<double>(o_.withSign(73, 4));
  }

  void readConic(int type) {
    readSize();
    s_.kind = type == 20 ? GridKind::PolarStereographic : type == 30 ? GridKind::Lambert : GridKind::Albers;
    s_.firstLatitude = degrees(39);
    s_.firstLongitude = degrees(43);
    readFlags(47, 65);
    s_.trueLatitude = degrees(48);
    s_.orientation = degrees(52);
    s_.stepX = lengthIfAny(56, kMilli);
    s_.stepY = lengthIfAny(60, kMilli);
    s_.southPole = (o_.whole(64, 1) & 0x80) != 0;
    if (type == 20) return;
    s_.firstParallel = degrees(66);
    s_.secondParallel = degrees(70);
  }

  void readAzimuthal() {
    readSize();
    s_.kind = GridKind::LambertAzimuthal;
    s_.firstLatitude = degrees(39);
    s_.firstLongitude = degrees(43);
    s_.centerLatitude = degrees(47);
    s_.centerLongitude = degrees(51);
    readFlags(55, 64);
    s_.stepX = lengthIfAny(56, kMilli);
    s_.stepY = lengthIfAny(60, kMilli);
  }

  /// Numbers of points in the rows of reduced grids.
  void readList() {
    const std::size_t width = o_.whole(11, 1);
    if (width == 0 || !s_.rows || s_.columns || listFrom_ == 0) return;
    if (width > 4 || !o_.has(listFrom_, static_cast<std::size_t>(*s_.rows) * width)) {
      throw base::InputError(o_.where(), "lacks the numbers of points in its rows", "fetch the file again");
    }
    for (std::size_t row = 0; row < *s_.rows; ++row)
      s_.pointsInRows.push_back(static_cast<std::uint32_t>(o_.whole(listFrom_ + row * width, width)));
  }

  const Octets& o_;
  GridSection& s_;
  double unit_ = kMicro;
  std::size_t listFrom_ = 0;
};

/// Section 2 of edition 1: millidegrees and metres.
class Section1 {
 public:
  explicit Section1(const Octets& octets, GridSection& section) : o_(octets), s_(section) {}

  void read() {
    const int type = static_cast<int>(o_.whole(6, 1));
    s_.columns = o_.wholeIfAny(7, 2);
    s_.rows = o_.wholeIfAny(9, 2);
    s_.firstLatitude = degrees(11);
    s_.firstLongitude = degrees(14);
    const auto flags = o_.whole(17, 1);
    s_.windsAlongAxes = (flags & 0x08) != 0;
    s_.ellipsoid = flags & 0x40 ? spheroid(6378160, 6356775) : sphere(6367470);
    s_.scanning = static_cast<int>(o_.whole(28, 1));
    switch (type) {
      case 0:
      case 4:
      case 10:
      case 14:
      case 205:
        readDegrees(type, (flags & 0x80) != 0);
        break;
      case 1:
        s_.kind = GridKind::Mercator;
        s_.lastLatitude = degrees(18);
        s_.lastLongitude = degrees(21);
        s_.trueLatitude = degrees(24);
        readSteps(29);
        break;
      case 3:
        s_.kind = GridKind::Lambert;
        readPlane();
        s_.firstParallel = degrees(29);
        s_.secondParallel = degrees(32);
        break;
      case 5:
        s_.kind = GridKind::PolarStereographic;
        readPlane();
        s_.trueLatitude = 60;
        break;
      default:
        refuse1(o_, type);
    }
    readList();
  }

 private:
  double degrees(std::size_t octet) const { return 1e-3 * static_cast<double>(o_.withSign(octet, 3)); }

  void readDegrees(int type, bool stepsGiven) {
    s_.kind = type == 205               ? GridKind::AboutCenter
              : type == 4 || type == 14 ? GridKind::Gaussian
                                        : GridKind::LatLon;
    s_.lastLatitude = degrees(18);
    s_.lastLongitude = degrees(21);
    const auto stepX = o_.wholeIfAny(24, 2), stepY = o_.wholeIfAny(26, 2);
    if (stepsGiven && stepX && *stepX > 0) s_.stepX = 1e-3 * static_cast<double>(*stepX);
    if (s_.kind == GridKind::Gaussian)
      s_.gaussianNumber = stepY.value_or(0);
    else if (stepsGiven && stepY && *stepY > 0)
      s_.stepY = 1e-3 * static_cast<double>(*stepY);
    if (type == 10 || type == 14) {
      s_.rotated = true;
      s_.southPoleLatitude = degrees(33);
      s_.southPoleLongitude = degrees(36);
      s_.rotationAngle = o_.has(39, 4) ? o_.ibm(39) : 0;
    }
    if (type != 205) return;
    s_.rotated = true;
    s_.centerLatitude = degrees(18);
    s_.centerLongitude = degrees(21);
    s_.lastLatitude.reset();
    s_.lastLongitude.reset();
    if (o_.has(29, 6)) {
      s_.lastLatitude = degrees(29);
      s_.lastLongitude = degrees(32);
    }
  }

  void readSteps(std::size_t octet) {
    const auto x = o_.wholeIfAny(octet, 3), y = o_.wholeIfAny(octet + 3, 3);
    if (x && *x > 0) s_.stepX = static_cast<double>(*x);
    if (y && *y > 0) s_.stepY = static_cast<double>(*y);
  }

  void readPlane() {
    s_.orientation = degrees(18);
    readSteps(21);
    s_.southPole = (o_.whole(27, 1) & 0x80) != 0;
  }

  /// Numbers of points in the rows lie behind the vertical coordinates.
  void readList() {
    const std::size_t place = o_.whole(5, 1), coordinates = o_.whole(4, 1);
    if (s_.columns || !s_.rows || place == 255) return;
    const std::size_t from = place + 4 * coordinates;
    if (!o_.has(from, static_cast<std::size_t>(*s_.rows) * 2))
      throw base::InputError(o_.where(), "lacks the numbers of points in its rows", "fetch the file again");
    for (std::size_t row = 0; row < *s_.rows; ++row)
      s_.pointsInRows.push_back(static_cast<std::uint32_t>(o_.whole(from + 2 * row, 2)));
  }

  const Octets& o_;
  GridSection& s_;
};

}  // namespace

GridSection readGridSection(const FieldHead& head) {
  GridSection section;
  section.where = head.location.name();
  const Octets octets(*head.grid, section.where);
  if (head.location.edition == 2) {
    Section2(octets, section).read();
  } else if (octets.size() == 0) {
    const Octets product(*head.identification, section.where);
    notRead(octets, fmt::format("catalogue grid {} without its definition", product.whole(7, 1)),
            "write the definition into it, as with wgrib or ecCodes' grib_set");
  } else {
    Section1(octets, section).read();
  }
  return section;
}

}  // namespace cloudgen::input::grib
