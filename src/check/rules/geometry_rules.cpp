// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>

#include "check/rules/node_record.hpp"

namespace cloudgen::check {
namespace {

using Tuples = std::optional<std::uint64_t>;

/// The points or colours that a geometry's field holds: nothing if the field is empty, or if it is unknown.
Tuples tuplesIn(const NodeRecord& node, std::string_view field) {
  const auto* children = node.in(field);
  return children ? children->tuples : std::nullopt;
}

/// The same where an index stands: without a node to point into there are no points.
Tuples tuplesToIndex(const NodeRecord& node, std::string_view field) {
  const bool unknown = node.in(field) || node.in("");
  return unknown ? tuplesIn(node, field) : Tuples(0);
}

bool truth(const NodeRecord& node, std::string_view field, bool otherwise) {
  const FieldFacts* facts = node.fact(field);
  return facts ? facts->truth : otherwise;
}

/// Every index must name one of `available` things.
void checkRange(const FieldFacts* index, Tuples available, bool terminators, std::string_view things,
                FindingList& findings) {
  if (!index || !index->readable || index->numbers == 0) return;
  if (index->low < (terminators ? -1 : 0))
    findings.error(
        index->where, "index-range",
        fmt::format("{} has the index {}", index->field->name, static_cast<std::int64_t>(index->low)),
        terminators ? "only -1 may be negative: it ends a face or line" : "indices start at 0");
  if (available && index->high >= 0 && index->high >= static_cast<double>(*available))
    findings.error(index->where, "index-range",
                   fmt::format("{} has the index {}, but there are only {} {}", index->field->name,
                               static_cast<std::int64_t>(index->high), *available, things),
                   "indices run from 0 to the count less one");
}

/// `needed` things a vertex or a face, of which there are `available`.
void checkEnough(Position where, std::string_view rule, Tuples available, std::uint64_t needed,
                 std::string_view what, FindingList& findings) {
  if (available && *available < needed)
    findings.error(where, rule, fmt::format("{} {} for {} that need one", *available, what, needed),
                   fmt::format("give {}, one each", needed));
}

std::uint64_t highestPlusOne(const FieldFacts& index) {
  return index.numbers == 0 || index.high < 0 ? 0 : static_cast<std::uint64_t>(index.high) + 1;
}

/// Normals and colours, one a vertex or one a face.
void checkPerPart(const NodeRecord& node, Position where, std::uint64_t vertices, std::uint64_t faces,
                  FindingList& findings) {
  checkEnough(where, "color-count", tuplesIn(node, "color"),
              truth(node, "colorPerVertex", true) ? vertices : faces, "colours", findings);
  checkEnough(where, "normal-count", tuplesIn(node, "normal"),
              truth(node, "normalPerVertex", true) ? vertices : faces, "normals", findings);
}

/// Triangles or quadrilaterals without terminators.
void checkPolygons(const NodeRecord& node, std::uint64_t corners, FindingList& findings) {
  const FieldFacts* index = node.fact("index");
  if (!index || !index->readable) return;
  checkRange(index, tuplesToIndex(node, "coord"), false, "points", findings);
  if (index->numbers % corners != 0)
    findings.error(index->where, "index-triangles",
                   fmt::format("{} indices are no whole number of {}", index->numbers,
                               corners == 3 ? "triangles" : "quadrilaterals"),
                   fmt::format("an {} has {} indices each and no -1", node.type, corners));
  checkEnough(index->where, "texcoord-count", tuplesIn(node, "texCoord"), highestPlusOne(*index),
              "texture coordinates for points", findings);
  checkPerPart(node, index->where, highestPlusOne(*index), index->numbers / corners, findings);
}

/// Fans or strips of triangles, parted by -1.
void checkFansOrStrips(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* index = node.fact("index");
  if (!index || !index->readable || index->numbers == 0) return;
  checkRange(index, tuplesToIndex(node, "coord"), true, "points", findings);
  if (index->shortestRun < 3)
    findings.error(index->where, "index-face",
                   fmt::format("index has a fan or strip of {} points", index->shortestRun),
                   "it needs at least 3");
}

/// Points that are drawn in groups of a fixed size.
void checkWholeGroups(const NodeRecord& node, std::uint64_t corners, FindingList& findings) {
  const Tuples points = tuplesIn(node, "coord");
  if (points && *points % corners != 0)
    findings.error(node.where, "vertex-count",
                   fmt::format("{} points are no whole number of groups of {}", *points, corners),
                   fmt::format("a {} takes {} points each", node.type, corners));
}

/// Points that are drawn in groups of stated sizes.
void checkCounts(const NodeRecord& node, std::string_view field, std::uint64_t fewest,
                 FindingList& findings) {
  const FieldFacts* counts = node.fact(field);
  if (!counts || !counts->readable || counts->numbers == 0) return;
  const Tuples points = tuplesIn(node, "coord");
  if (counts->low < static_cast<double>(fewest))
    findings.error(counts->where, "vertex-count",
                   fmt::format("{} has a count of {}", field, static_cast<std::int64_t>(counts->low)),
                   fmt::format("each is at least {}", fewest));
  else if (points && counts->sum > static_cast<double>(*points))
    findings.error(counts->where, "vertex-count",
                   fmt::format("{} counts {:.0f} points of {}", field, counts->sum, *points),
                   "give as many points as are counted");
}

void checkSecondIndex(const NodeRecord& node, std::string_view field, const FieldFacts& index, bool perVertex,
                      FindingList& findings) {
  const FieldFacts* second = node.fact(field);
  if (!second || !second->readable || second->numbers == 0) return;
  const std::uint64_t needed = perVertex ? index.numbers : index.runs;
  // The last -1 may be left out of either list.
  const bool fits =
      perVertex ? second->numbers + 1 >= needed && second->numbers <= needed + 1 && second->runs == index.runs
                : second->numbers >= needed;
  if (!fits)
    findings.error(second->where, "index-count",
                   fmt::format("{} does not run along with coordIndex ({} and {} entries)", field,
                               second->numbers, index.numbers),
                   perVertex ? "both lists have the same length, with -1 at the same places"
                             : "one entry a face or line");
}

void checkFacesOrLines(const NodeRecord& node, std::uint64_t fewest, FindingList& findings) {
  const FieldFacts* index = node.fact("coordIndex");
  if (!index || !index->readable || index->numbers == 0) return;
  checkRange(index, tuplesToIndex(node, "coord"), true, "points", findings);
  if (index->shortestRun < fewest)
    findings.error(
        index->where, "index-face",
        fmt::format("coordIndex has a {} of {} points", fewest == 3 ? "face" : "line", index->shortestRun),
        fmt::format("it needs at least {}", fewest));
  const FieldFacts* texture = node.fact("texCoordIndex");
  if (texture && texture->numbers > 0) {
    checkRange(texture, tuplesToIndex(node, "texCoord"), true, "texture coordinates", findings);
    checkSecondIndex(node, "texCoordIndex", *index, true, findings);
  } else {
    checkEnough(index->where, "texcoord-count", tuplesIn(node, "texCoord"), highestPlusOne(*index),
                "texture coordinates for points", findings);
  }
  for (const auto& [field, own, switched, rule] :
       {std::tuple{"color", "colorIndex", "colorPerVertex", "color-count"},
        std::tuple{"normal", "normalIndex", "normalPerVertex", "normal-count"}}) {
    const bool perVertex = truth(node, switched, true);
    const FieldFacts* second = node.fact(own);
    if (second && second->numbers > 0) {
      checkRange(second, tuplesToIndex(node, field), perVertex, fmt::format("{}s", field), findings);
      checkSecondIndex(node, own, *index, perVertex, findings);
    } else {
      checkEnough(index->where, rule, tuplesIn(node, field), perVertex ? highestPlusOne(*index) : index->runs,
                  fmt::format("{}s", field), findings);
    }
  }
}

void checkGrid(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* height = node.fact("height");
  const FieldFacts* columns = node.fact("xDimension");
  const FieldFacts* rows = node.fact("zDimension");
  if ((height && !height->readable) || (columns && !columns->readable) || (rows && !rows->readable)) return;
  const double points = (columns ? columns->first[0] : 0) * (rows ? rows->first[0] : 0);
  const std::uint64_t heights = height ? height->numbers : 0;
  if (points < 0 || static_cast<double>(heights) != points)
    findings.error(height ? height->where : node.where, "grid-height-count",
                   fmt::format("{} heights for {:.0f} points", heights, points),
                   "there are xDimension times zDimension heights, row by row");
  else if (columns && rows)
    checkPerPart(
        node, height ? height->where : node.where, heights,
        static_cast<std::uint64_t>(std::max(columns->first[0] - 1, 0.0) * std::max(rows->first[0] - 1, 0.0)),
        findings);
}

}  // namespace

void checkGeometry(const NodeRecord& node, FindingList& findings) {
  const std::string& type = node.type;
  if (type == "IndexedTriangleSet") checkPolygons(node, 3, findings);
  if (type == "IndexedQuadSet") checkPolygons(node, 4, findings);
  if (type == "IndexedTriangleFanSet" || type == "IndexedTriangleStripSet") checkFansOrStrips(node, findings);
  if (type == "IndexedFaceSet") checkFacesOrLines(node, 3, findings);
  if (type == "IndexedLineSet") checkFacesOrLines(node, 2, findings);
  if (type == "TriangleSet") checkWholeGroups(node, 3, findings);
  if (type == "QuadSet") checkWholeGroups(node, 4, findings);
  if (type == "TriangleFanSet") checkCounts(node, "fanCount", 3, findings);
  if (type == "TriangleStripSet") checkCounts(node, "stripCount", 3, findings);
  if (type == "LineSet") checkCounts(node, "vertexCount", 2, findings);
  if (type == "ElevationGrid" || type == "GeoElevationGrid") checkGrid(node, findings);
}

}  // namespace cloudgen::check
