// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: "v x y z" and "f a b c ...", corners as "point/texture/normal" counted from 1, or backwards
// from -1. All else (normals, materials, lines, curves) says nothing about a cloud.
#include <charconv>

#include "input/mesh/mesh_builder.hpp"
#include "input/mesh/mesh_file.hpp"
#include "input/mesh/words.hpp"

namespace cloudgen::input::mesh {

base::Mesh readObj(std::string_view text, const std::string& where) {
  MeshBuilder builder(where);
  Words words(text);
  std::vector<std::int64_t> corners;
  while (words.nextLine()) {
    const std::string_view kind = words.word();
    if (kind != "v" && kind != "f") continue;
    builder.where = fmt::format("{}, line {}", where, words.line());
    if (kind == "v") {
      const auto x = words.number(), y = words.number(), z = words.number();
      if (!x || !y || !z) builder.refuse("has a point that is not three numbers");
      builder.addPoint({*x, *y, *z});
      continue;
    }
    corners.clear();
    for (std::string_view corner = words.word(); !corner.empty(); corner = words.word()) {
      std::int64_t index = 0;
      const std::string_view point = corner.substr(0, corner.find('/'));
      const auto [end, error] = std::from_chars(point.data(), point.data() + point.size(), index);
      if (error != std::errc() || end != point.data() + point.size() || index == 0)
        builder.refuse("has a face whose corners are not numbers of points");
      corners.push_back(index > 0 ? index - 1 : static_cast<std::int64_t>(builder.points()) + index);
    }
    builder.addPolygon(corners);
  }
  builder.where = where;
  return builder.finished();
}

}  // namespace cloudgen::input::mesh
