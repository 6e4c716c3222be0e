// SPDX-License-Identifier: Apache-2.0
#include "check/rules/node_record.hpp"

namespace cloudgen::check {
namespace {

void checkLevels(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* range = node.fact("range");
  if (!range || !range->readable || range->numbers == 0) return;
  if (range->low < 0)
    findings.error(range->where, "lod-range", "a range is negative", "ranges are distances in local units");
  if (!range->increasing)
    findings.error(range->where, "lod-range", "the ranges are not in increasing order",
                   "sort them, nearest first");
  const auto* children = node.in("children");
  const std::uint64_t levels = children ? children->count : 0;
  if (levels != range->numbers + 1)
    findings.error(node.where, "lod-levels", fmt::format("{} levels for {} ranges", levels, range->numbers),
                   "an LOD has one level more than ranges; the last may be an empty Group");
}

void checkSwitch(const NodeRecord& node, FindingList& findings) {
  const FieldFacts* choice = node.fact("whichChoice");
  const auto* children = node.in("children");
  const double count = children ? static_cast<double>(children->count) : 0;
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
  const bool arrays = node.type.starts_with("CoordinateInterpolator") || node.type == "NormalInterpolator";
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
  if (node.kind->isGeometry) checkGeometry(node, findings);
  if (node.type == "LOD") checkLevels(node, findings);
  if (node.type == "Switch") checkSwitch(node, findings);
  if (node.kind->isBackground) {
    checkAngles(node, "skyAngle", "skyColor", findings);
    checkAngles(node, "groundAngle", "groundColor", findings);
  }
  if (node.kind->hasKeys) checkInterpolator(node, findings);
}

}  // namespace cloudgen::check
