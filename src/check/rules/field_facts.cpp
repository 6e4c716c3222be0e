// SPDX-License-Identifier: Apache-2.0
#include "check/rules/field_facts.hpp"

#include <algorithm>

#include "check/rules/numbers.hpp"

namespace cloudgen::check {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && separatesNumbers(text.front())) text.remove_prefix(1);
  while (!text.empty() && separatesNumbers(text.back())) text.remove_suffix(1);
  return text;
}

/// Adds one number; its place in the tuple tells what it is.
void addNumber(FieldFacts& facts, double number, double before) {
  if (facts.numbers < facts.first.size()) facts.first[facts.numbers] = number;
  if (facts.numbers == 0) facts.low = facts.high = number;
  facts.low = std::min(facts.low, number);
  facts.high = std::max(facts.high, number);
  facts.sum += number;
  if (facts.numbers > 0 && number < before) facts.increasing = false;
  ++facts.numbers;
}

ListResult readFloats(FieldFacts& facts, std::string_view value, bool rotations) {
  double before = 0, axis = 0;
  return forEachNumber<double>(value, [&](double number) {
    if (rotations) {
      const std::uint64_t place = facts.numbers % 4;
      axis = place == 0 ? std::abs(number) : place < 3 ? axis + std::abs(number) : axis;
      if (place == 3 && axis == 0) ++facts.zeroAxes;
    }
    addNumber(facts, number, before);
    before = number;
  });
}

ListResult readIntegers(FieldFacts& facts, std::string_view value) {
  double before = 0;
  std::uint64_t run = 0;
  const auto endRun = [&] {
    facts.shortestRun = facts.runs == 0 ? run : std::min(facts.shortestRun, run);
    ++facts.runs;
    run = 0;
  };
  const ListResult list = forEachNumber<std::int64_t>(value, [&](std::int64_t number) {
    addNumber(facts, static_cast<double>(number), before);
    before = static_cast<double>(number);
    if (number == -1)
      endRun();
    else
      ++run;
  });
  if (run > 0) endRun();
  return list;
}

/// Lists of points and colours: how many there are is all that the rules ask of them.
bool isOnlyCounted(std::string_view type) {
  return type.starts_with("MF") && tupleSize(type) > 1 && !type.ends_with("Rotation");
}

void readNumbers(FieldFacts& facts, std::string_view value, FindingList& findings) {
  const FieldKind& field = *facts.field;
  const bool whole = field.type.ends_with("Int32");
  if (isOnlyCounted(field.type)) facts.numbers = countPlainNumbers(value).value_or(0);
  const ListResult list = facts.numbers > 0 ? ListResult{}
                          : whole           ? readIntegers(facts, value)
                                            : readFloats(facts, value, field.type.ends_with("Rotation"));
  const auto size = static_cast<std::uint64_t>(tupleSize(field.type));
  facts.tuples = facts.numbers / size;
  facts.readable = false;
  if (list.end == ListEnd::NotANumber)
    return findings.error(facts.where, "number",
                          fmt::format("{} has {}, which is no {}", field.name, excerpt(list.piece),
                                      whole ? "integer" : "number"),
                          "numbers stand between blanks or commas, with a decimal point");
  if (list.end == ListEnd::NotFinite)
    return findings.error(facts.where, "number-not-finite",
                          fmt::format("{} has {}", field.name, excerpt(list.piece)),
                          "X3D knows finite numbers only: drop the vertex or the node");
  const bool single = field.type.starts_with("SF");
  if (single ? facts.numbers != size : facts.numbers % size != 0)
    return findings.error(facts.where, "number-count",
                          fmt::format("{} has {} numbers", field.name, facts.numbers),
                          single ? fmt::format("an {} has {}", field.type, size)
                                 : fmt::format("an {} has a multiple of {}", field.type, size));
  facts.readable = true;
}

}  // namespace

bool splitStrings(std::string_view value, std::vector<std::string>& strings) {
  strings.clear();
  for (value = trimmed(value); !value.empty(); value = trimmed(value)) {
    if (value.front() != '"') return false;
    std::string string;
    std::size_t at = 1;
    for (; at < value.size() && value[at] != '"'; ++at) {
      if (value[at] == '\\' && at + 1 < value.size()) ++at;
      string += value[at];
    }
    if (at >= value.size()) return false;
    strings.push_back(std::move(string));
    value.remove_prefix(at + 1);
  }
  return true;
}

FieldFacts readField(const FieldKind& field, std::string_view value, Position where, FindingList& findings) {
  FieldFacts facts;
  facts.field = &field;
  facts.where = where;
  if (tupleSize(field.type) > 0) {
    readNumbers(facts, value, findings);
  } else if (field.type == "SFBool") {
    const std::string_view word = trimmed(value);
    facts.truth = word == "true" || word == "TRUE";
    facts.readable = facts.truth || word == "false" || word == "FALSE";
    if (!facts.readable)
      findings.error(where, "boolean", field.name + " is " + excerpt(word), "an SFBool is true or false");
  } else if (field.type == "MFBool") {
    for (std::string_view rest = trimmed(value); !rest.empty(); rest = trimmed(rest)) {
      std::size_t end = 0;
      while (end < rest.size() && !separatesNumbers(rest[end])) ++end;
      rest.remove_prefix(end);
      ++facts.tuples;
    }
  } else if (field.type == "MFString") {
    std::vector<std::string> strings;
    facts.readable = splitStrings(value, strings);
    if (!facts.readable)
      findings.error(
          where, "string-unquoted",
          fmt::format("{} is {}, without quotation marks around each string", field.name, excerpt(value)),
          fmt::format("write {}='\"...\"'", field.name));
  }
  return facts;
}

}  // namespace cloudgen::check
