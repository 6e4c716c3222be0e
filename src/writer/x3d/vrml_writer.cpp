// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "writer/x3d/encodings.hpp"

namespace cloudgen::writer {
namespace {

void appendQuoted(std::string& out, std::string_view value) {
  out += '"';
  for (const char c : cleanText(value)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  out += '"';
}

/// Fields that hold many nodes; all others hold one.
bool holdsMany(std::string_view field) { return field == "children" || field == "value"; }

}  // namespace

void VrmlWriter::start(const HeadEntries& head, std::string_view component) {
  text() += encoding_ == Encoding::Classic ? "#X3D V4.0 utf8\nPROFILE Immersive\n" : "#VRML V2.0 utf8\n";
  if (!component.empty() && encoding_ == Encoding::Classic) text() += fmt::format("COMPONENT {}:1\n", component);
  for (const auto& [name, content] : head) {
    if (encoding_ == Encoding::Vrml97) {
      text() += "# " + name + ": " + cleanText(content);
    } else {
      text() += "META ";
      appendQuoted(text(), name);
      text() += ' ';
      appendQuoted(text(), content);
    }
    text() += '\n';
  }
}

void VrmlWriter::beginChild(std::string_view field) {
  file_.drain();
  if (lists_.empty()) {
    text() += '\n';
    return;
  }
  std::string& list = lists_.back();
  if (list != field) {
    if (!list.empty()) text() += " ]";
    list = holdsMany(field) ? field : std::string_view();
    text() += '\n';
    text().append(lists_.size(), ' ');
    text() += field;
    if (!list.empty()) text() += " [";
  }
  if (!list.empty()) {
    text() += '\n';
    text().append(lists_.size(), ' ');
  } else {
    text() += ' ';
  }
}

void VrmlWriter::open(std::string_view type, std::string_view field, std::string_view def) {
  beginChild(field);
  if (!def.empty()) {
    text() += "DEF ";
    text() += def;
    text() += ' ';
  }
  text() += type;
  text() += " {";
  lists_.emplace_back();
}

void VrmlWriter::close() {
  if (!lists_.back().empty()) text() += " ]";
  text() += " }";
  lists_.pop_back();
}

void VrmlWriter::use(std::string_view, std::string_view field, std::string_view def) {
  beginChild(field);
  text() += "USE ";
  text() += def;
}

void VrmlWriter::route(std::string_view fromNode, std::string_view fromField, std::string_view toNode,
                       std::string_view toField) {
  text() += fmt::format("\nROUTE {}.{} TO {}.{}", fromNode, fromField, toNode, toField);
}

void VrmlWriter::finish() {
  text() += '\n';
  file_.close();
}

void VrmlWriter::boolean(std::string_view name, bool value) {
  openField(name, false);
  text() += value ? "TRUE" : "FALSE";
  closeField(false);
}

void VrmlWriter::string(std::string_view name, std::string_view value) {
  openField(name, false);
  appendQuoted(text(), value);
  closeField(false);
}

void VrmlWriter::strings(std::string_view name, std::span<const std::string> values) {
  openField(name, true);
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text() += ", ";
    appendQuoted(text(), values[i]);
  }
  closeField(true);
}

void VrmlWriter::openField(std::string_view name, bool many) {
  text() += ' ';
  text() += name;
  text() += many ? " [" : " ";
}

void VrmlWriter::closeField(bool many) {
  if (many) text() += ']';
}

}  // namespace cloudgen::writer
