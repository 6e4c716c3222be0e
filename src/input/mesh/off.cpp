// SPDX-License-Identifier: Apache-2.0
// Object File Format of Geomview, as text: "OFF" (COFF, NOFF, STOFF: more numbers a point, after the first
// three), counts of points, faces and edges, points, faces.
#include "input/mesh/mesh_builder.hpp"
#include "input/mesh/mesh_file.hpp"
#include "input/mesh/words.hpp"

namespace cloudgen::input::mesh {

base::Mesh readOff(std::string_view text, const std::string& where) {
  MeshBuilder builder(where);
  Words words(text);
  const auto goOn = [&](const char* missing) {
    const bool more = words.nextFilledLine();
    builder.where = fmt::format("{}, line {}", where, words.line());
    if (!more) builder.refuse(std::string("ends before ") + missing);
  };
  goOn("its header");
  const std::string_view kind = words.word();
  if (!kind.ends_with("OFF") || kind.find_first_of("4n") != std::string_view::npos)
    builder.refuse("does not begin with OFF (of three dimensions)");
  auto points = words.whole();
  if (!points) {
    goOn("its counts");
    points = words.whole();
  }
  const auto faces = words.whole();
  if (!points || !faces || *points < 0 || *faces < 0) builder.refuse("has no counts of points and faces");
  for (long long i = 0; i < *points; ++i) {
    goOn("its last point");
    const auto x = words.number(), y = words.number(), z = words.number();
    if (!x || !y || !z) builder.refuse("has a point that is not three numbers");
    builder.addPoint({*x, *y, *z});
  }
  std::vector<std::int64_t> corners;
  for (long long i = 0; i < *faces; ++i) {
    goOn("its last face");
    const auto count = words.whole();
    corners.clear();
    for (long long k = 0; count && k < *count; ++k) {
      const auto corner = words.whole();
      if (!corner) builder.refuse("has a face of fewer corners than it says");
      corners.push_back(*corner);
    }
    builder.addPolygon(corners);
  }
  builder.where = where;
  return builder.finished();
}

}  // namespace cloudgen::input::mesh
