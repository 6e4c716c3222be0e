// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/node_writer.hpp"

#include <array>
#include <cassert>

#include "base/text.hpp"
#include "writer/x3d/encodings.hpp"

namespace cloudgen::writer {
namespace {

void appendNumbers(std::string& out, std::span<const float> values, int decimals) {
  for (size_t i = 0; i < values.size(); ++i) {
    assert(std::isfinite(values[i]));
    if (i > 0) out += ' ';
    base::appendFixed(out, values[i], decimals);
  }
}

}  // namespace

void NodeWriter::number(std::string_view name, double value, int decimals) {
  assert(std::isfinite(value));
  openField(name, false);
  base::appendFixed(text(), value, decimals);
  closeField(false);
}

void NodeWriter::vector(std::string_view name, const glm::vec3& value, int decimals) {
  openField(name, false);
  appendNumbers(text(), std::array{value.x, value.y, value.z}, decimals);
  closeField(false);
}

void NodeWriter::place(std::string_view name, const glm::dvec3& value) {
  constexpr int kDegreeDecimals = 7, kMeterDecimals = 1;  // some centimetres
  openField(name, false);
  base::appendFixed(text(), value.x, kDegreeDecimals);
  text() += ' ';
  base::appendFixed(text(), value.y, kDegreeDecimals);
  text() += ' ';
  base::appendFixed(text(), value.z, kMeterDecimals);
  closeField(false);
}

void NodeWriter::rotation(std::string_view name, const glm::vec4& value) {
  openField(name, false);
  appendNumbers(text(), std::array{value.x, value.y, value.z, value.w}, 5);
  closeField(false);
}

void NodeWriter::numbers(std::string_view name, std::span<const float> values, int group, int decimals) {
  const size_t step = static_cast<size_t>(group);
  openField(name, true);
  for (size_t i = 0; i < values.size(); i += step) {
    if (i > 0) text() += group > 1 ? ", " : " ";
    appendNumbers(text(), values.subspan(i, step), decimals);
  }
  closeField(true);
}

void NodeWriter::integer(std::string_view name, std::int64_t value) {
  openField(name, false);
  text() += std::to_string(value);
  closeField(false);
}

void NodeWriter::integers(std::string_view name, std::span<const std::int32_t> values) {
  openField(name, true);
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text() += ' ';
    text() += std::to_string(values[i]);
  }
  closeField(true);
}

std::unique_ptr<NodeWriter> nodeWriter(Encoding encoding, const std::filesystem::path& file) {
  if (encoding == Encoding::Xml) return std::make_unique<XmlWriter>(file);
  return std::make_unique<VrmlWriter>(file, encoding);
}

std::string cleanText(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const size_t length = base::characterLength(text);
    if (length == 0)
      clean += '?';
    else if (length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F))
      clean += ' ';
    else
      clean += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return clean;
}

}  // namespace cloudgen::writer
