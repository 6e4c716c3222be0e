// SPDX-License-Identifier: Apache-2.0
#include "check/rules/node_record.hpp"

namespace cloudgen::check {
namespace {

using Tuples = std::optional<std::uint64_t>;

/// The points or colours that a geometry's field holds: nothing if the field is empty, or if it is unknown.
Tuples tuplesIn(const NodeRecord& node, std::string_view field) {
  const auto found = node.children.find(field);
  return found == node.children.end() ? std::nullopt : found->second.tuples;
}

/// The same where an index stands: without a node to point into there are no points.
Tuples tuplesToIndex(const NodeRecord& node, std::string_view field) {
  const bool unknown = node.children.contains(field) || node.children.contains("");
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

void checkTriangles(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* index = node.fact("index");
  if (!index || !index->readable) return;
  checkRange(index, tuplesToIndex(node, "coord"), false, "points", findings);
  if (index->numbers % 3 != 0)
    findings.error(index->where, "index-triangles",
                   fmt::format("{} indices are no whole number of triangles", index->numbers),
                   "an IndexedTriangleSet has three indices a triangle and no -1");
  checkEnough(index->where, "texcoord-count", tuplesIn(node, "texCoord"), highestPlusOne(*index),
              "texture coordinates for points", findings);
  const std::uint64_t coloured =
      truth(node, "colorPerVertex", true) ? highestPlusOne(*index) : index->numbers / 3;
  checkEnough(index->where, "color-count", tuplesIn(node, "color"), coloured, "colours", findings);
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
  const bool perVertex = truth(node, "colorPerVertex", true);
  const FieldFacts* colour = node.fact("colorIndex");
  if (colour && colour->numbers > 0) {
    checkRange(colour, tuplesToIndex(node, "color"), perVertex, "colours", findings);
    checkSecondIndex(node, "colorIndex", *index, perVertex, findings);
  } else {
    checkEnough(index->where, "color-count", tuplesIn(node, "color"),
                perVertex ? highestPlusOne(*index) : index->runs, "colours", findings);
  }
}

void checkLevels(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* range = node.fact("range");
  if (!range || !range->readable || range->numbers == 0) return;
  if (range->low < 0)
    findings.error(range->where, "lod-range", "a range is negative", "ranges are distances in local units");
  if (!range->increasing)
    findings.error(range->where, "lod-range", "the ranges are not in increasing order",
                   "sort them, nearest first");
  const auto found = node.children.find("children");
  const std::uint64_t levels = found == node.children.end() ? 0 : found->second.count;
  if (levels != range->numbers + 1)
    findings.error(node.where, "lod-levels", fmt::format("{} levels for {} ranges", levels, range->numbers),
                   "an LOD has one level more than ranges; the last may be an empty Group");
}

void checkSwitch(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* choice = node.fact("whichChoice");
  const auto found = node.children.find("children");
  const double count = found == node.children.end() ? 0 : static_cast<double>(found->second.count);
  if (choice && choice->readable && choice->first[0] >= count)
    findings.error(choice->where, "switch-choice",
                   fmt::format("whichChoice is {} of {} children", choice->first[0], count),
                   "choices are counted from 0; -1 shows none");
}

void checkInterpolator(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* key = node.fact("key");
  const FieldFacts* value = node.fact("keyValue");
  if (key && key->readable && !key->increasing)
    findings.error(key->where, "key-order", "the keys are not in increasing order",
                   "sort keys and values by time");
  const std::uint64_t keys = key ? key->numbers : 0, values = value ? value->tuples : 0;
  if ((key && !key->readable) || (value && !value->readable)) return;
  const bool arrays = node.type == "CoordinateInterpolator";
  const bool fits = keys == 0 ? values == 0 : arrays ? values > 0 && values % keys == 0 : values == keys;
  if (!fits)
    findings.error(value ? value->where : node.where, "key-count",
                   fmt::format("{} values for {} keys", values, keys),
                   arrays ? "every key has the same number of points" : "every key has one value");
}

void checkTurnsAndScales(const NodeRecord& node, FindingList& findings) {
  for (const FieldFacts& facts : node.facts) {
    if (!facts.readable) continue;
    if (facts.zeroAxes > 0)
      findings.error(facts.where, "rotation-axis",
                     fmt::format("{} turns about the axis 0 0 0", facts.field->name),
                     "give an axis of length one; for no turn write 0 0 1 0");
    if (facts.field->name == "scale" && facts.numbers > 0 &&
        facts.numbers == static_cast<std::uint64_t>(tupleSize(facts.field->type)))
      for (std::uint64_t axis = 0; axis < facts.numbers; ++axis)
        if (facts.first[axis] == 0) {
          findings.error(facts.where, "scale-zero", "a scale of zero flattens the node away",
                         "leave the node out instead");
          break;
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
  else if (truth(node, "colorPerVertex", true))
    checkEnough(height ? height->where : node.where, "color-count", tuplesIn(node, "color"), heights,
                "colours", findings);
}

void checkAngles(const NodeRecord& node, std::string_view angles, std::string_view colours,
                 FindingList& findings) {
  const FieldFacts* angle = node.fact(angles);
  const FieldFacts* colour = node.fact(colours);
  if (!angle || !angle->readable || angle->numbers == 0) return;
  if (!angle->increasing)
    findings.error(angle->where, "key-order", fmt::format("{} is not in increasing order", angles),
                   "angles grow away from the pole");
  if ((!colour || colour->readable) && (colour ? colour->tuples : 0) != angle->numbers + 1)
    findings.error(angle->where, "color-count",
                   fmt::format("{} colours for {} angles", colour ? colour->tuples : 0, angle->numbers),
                   "one colour more than angles");
}

}  // namespace

void checkNode(const NodeRecord& node, FindingList& findings) {
  checkTurnsAndScales(node, findings);
  if (node.type == "IndexedTriangleSet") checkTriangles(node, findings);
  if (node.type == "IndexedFaceSet") checkFacesOrLines(node, 3, findings);
  if (node.type == "IndexedLineSet") checkFacesOrLines(node, 2, findings);
  if (node.type == "ElevationGrid") checkGrid(node, findings);
  if (node.type == "LOD") checkLevels(node, findings);
  if (node.type == "Switch") checkSwitch(node, findings);
  if (node.type == "Background") {
    checkAngles(node, "skyAngle", "skyColor", findings);
    checkAngles(node, "groundAngle", "groundColor", findings);
  }
  if (node.type.ends_with("Interpolator")) checkInterpolator(node, findings);
}

}  // namespace cloudgen::check
