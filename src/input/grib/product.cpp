// SPDX-License-Identifier: Apache-2.0
// WMO Manual on Codes, FM 92 GRIB edition 2: sections 1 and 4, product definition templates 4.0 to 4.15, 4.60
// and 4.61; edition 1: sections 1 and 2.
#include "input/grib/product.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "input/grib/octets.hpp"

namespace cloudgen::input::grib {
namespace {

int small(const Octets& octets, std::size_t octet, std::size_t length = 1) {
  return static_cast<int>(octets.whole(octet, length));
}

base::UtcTime momentOf(const Octets& octets, int year, std::size_t month) {
  const int numbers[] = {small(octets, month), small(octets, month + 1), small(octets, month + 2),
                         small(octets, month + 3)};
  const auto text =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}Z", year, numbers[0], numbers[1], numbers[2], numbers[3]);
  const auto moment = base::utcFromIso(text);
  if (!moment)
    throw base::InputError(octets.where(), "has an impossible date (" + text + ")", "fetch the file again");
  return *moment;
}

/// A moment later by a count of units of code table 4.4 (edition 1: table 4, alike but for 13, a quarter of
/// an hour); nothing for units of months and more.
std::optional<base::UtcTime> later(base::UtcTime run, std::int64_t count, int unit, int edition) {
  std::int64_t seconds = 0;
  switch (unit) {
    case 0:
      seconds = 60;
      break;
    case 1:
      seconds = 3600;
      break;
    case 2:
      seconds = 86400;
      break;
    case 10:
      seconds = 3 * 3600;
      break;
    case 11:
      seconds = 6 * 3600;
      break;
    case 12:
      seconds = 12 * 3600;
      break;
    case 13:
      seconds = edition == 1 ? 900 : 1;
      break;
    case 14:
      seconds = 1800;  // edition 1, local
      break;
    case 254:
      seconds = 1;  // edition 1
      break;
    default:
      return std::nullopt;
  }
  return base::UtcTime{run.seconds + count * seconds};
}

/// Where a template of section 4 keeps what it adds to template 4.0; 0 is nowhere.
struct Layout {
  int number;
  std::size_t member, end;  ///< perturbation number; end of the time interval
  std::size_t derived;      ///< derived forecast: only means are plain
};
constexpr Layout kLayouts[] = {{0, 0, 0, 0},  {1, 36, 0, 0},   {2, 0, 0, 35},
                               {8, 0, 35, 0}, {11, 36, 38, 0}, {12, 0, 37, 35},
                               {15, 0, 0, 0}, {60, 36, 0, 0},  {61, 36, 45, 0}};

const Layout* layoutOf(int number) {
  for (const Layout& layout : kLayouts)
    if (layout.number == number) return &layout;
  return nullptr;
}

Product readProduct2(const FieldHead& head) {
  const std::string where = head.location.name();
  const Octets origin(*head.identification, where), octets(*head.product, where);
  Product product;
  product.discipline = head.discipline;
  product.centre = small(origin, 6, 2);
  product.subcentre = small(origin, 8, 2);
  const Layout* layout = layoutOf(small(octets, 8, 2));
  product.category = small(octets, 10);
  product.number = small(octets, 11);
  product.plain = layout != nullptr && octets.has(34);
  if (!product.plain) return product;
  product.process = small(octets, 14);
  product.run = momentOf(origin, small(origin, 13, 2), 15);
  product.valid = later(*product.run, octets.withSign(19, 4), small(octets, 18), 2);
  product.firstType = small(octets, 23);
  product.firstValue = octets.scaledIfAny(24).value_or(0);
  product.secondType = small(octets, 29);
  product.secondValue = octets.scaledIfAny(30).value_or(0);
  if (layout->member) product.member = small(octets, layout->member);
  if (layout->derived && small(octets, layout->derived) > 1) product.plain = false;
  if (layout->end) {
    product.valid = momentOf(octets, small(octets, layout->end, 2), layout->end + 2);
    product.span = small(octets, layout->end + 12) == 0 ? Span::Average : Span::Other;
  }
  const auto pairs = static_cast<std::size_t>(small(octets, 6, 2));
  if (pairs > 0 && octets.has(34 + 4 * pairs))
    for (std::size_t i = 0; i < pairs; ++i)
      product.coordinates.push_back(octets.ieee(octets.size() + 1 - 4 * (pairs - i)));
  return product;
}

/// Code table 5 of edition 1: from when to when a value holds.
void setTime1(const Octets& octets, Product& product) {
  const int unit = small(octets, 18), first = small(octets, 19), second = small(octets, 20);
  const auto at = [&](int count) { return later(*product.run, count, unit, 1); };
  switch (small(octets, 21)) {
    case 0:
    case 1:
      product.valid = at(first);
      break;
    case 10:
      product.valid = at(first * 256 + second);
      break;
    case 3:
      product.span = Span::Average;
      product.valid = at(second);
      break;
    case 2:
    case 4:
    case 5:
      product.span = Span::Other;
      product.valid = at(second);
      break;
    case 51:
    case 113:
    case 123:
      product.span = Span::Average;
      product.valid = at(first);
      break;
    default:
      product.span = Span::Other;
      product.valid = at(first);
  }
}

Product readProduct1(const FieldHead& head) {
  const std::string where = head.location.name();
  const Octets octets(*head.identification, where), grid(*head.grid, where);
  Product product;
  product.edition = 1;
  product.table = small(octets, 4);
  product.centre = small(octets, 5);
  product.process = small(octets, 6);
  product.number = small(octets, 9);
  product.firstType = small(octets, 10);
  product.firstValue = small(octets, 11, 2);
  product.secondValue = small(octets, 12);
  product.subcentre = small(octets, 26);
  const int century = small(octets, 25), year = small(octets, 13);
  product.run = momentOf(octets, (century - 1) * 100 + year, 14);
  setTime1(octets, product);
  // NCEP's extension for ensembles, and ECMWF's local definitions for them.
  if (product.centre == kNcep && octets.has(43) && small(octets, 41) == 1)
    product.member = small(octets, 42) == 1 ? 0 : small(octets, 43) * (small(octets, 42) == 2 ? -1 : 1);
  if (product.centre == kEcmwf && octets.has(50) && (small(octets, 41) == 1 || small(octets, 41) == 30))
    product.member = small(octets, 50);
  if (grid.size() >= 5) {
    const auto count = static_cast<std::size_t>(small(grid, 4)),
               place = static_cast<std::size_t>(small(grid, 5));
    if (count > 0 && place != 255 && grid.has(place, 4 * count))
      for (std::size_t i = 0; i < count; ++i) product.coordinates.push_back(grid.ibm(place + 4 * i));
  }
  return product;
}

}  // namespace

Product readProduct(const FieldHead& head) {
  return head.location.edition == 1 ? readProduct1(head) : readProduct2(head);
}

}  // namespace cloudgen::input::grib
