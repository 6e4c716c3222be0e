// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "writer/x3d/encodings.hpp"

namespace cloudgen::writer {
namespace {

/// The field that a node stands in when XML does not say containerField.
std::string_view defaultField(std::string_view type) {
  if (type == "Appearance") return "appearance";
  if (type == "Material" || type == "UnlitMaterial") return "material";
  if (type == "ImageTexture") return "texture";
  if (type == "GeoOrigin") return "geoOrigin";
  if (type == "Coordinate") return "coord";
  if (type == "TextureCoordinate") return "texCoord";
  if (type == "Color" || type == "ColorRGBA") return "color";
  if (type == "ElevationGrid" || type == "IndexedFaceSet" || type == "IndexedLineSet" ||
      type == "IndexedTriangleSet")
    return "geometry";
  if (type.starts_with("Metadata"))
    return {};  // "metadata" by the standard, but X_ITE 15 takes it for a "value": always say which
  return "children";
}

}  // namespace

void XmlWriter::start(const HeadEntries& head, std::string_view component) {
  text() +=
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D profile=\"Immersive\" version=\"4.0\">\n<head>\n";
  if (!component.empty()) text() += fmt::format("<component name=\"{}\" level=\"1\"/>\n", component);
  for (const auto& [name, content] : head) {
    text() += "<meta name=\"";
    text() += base::xmlEscaped(cleanText(name));
    text() += "\" content=\"";
    text() += base::xmlEscaped(cleanText(content));
    text() += "\"/>\n";
  }
  text() += "</head>\n<Scene>";
}

void XmlWriter::beginTag(std::string_view type, std::string_view field) {
  if (inTag_) text() += '>';
  file_.drain();
  text() += '\n';
  text().append(types_.size(), ' ');
  text() += '<';
  text() += type;
  if (!types_.empty() && field != defaultField(type)) string("containerField", field);
}

void XmlWriter::open(std::string_view type, std::string_view field, std::string_view def) {
  beginTag(type, field);
  if (!def.empty()) string("DEF", def);
  types_.emplace_back(type);
  inTag_ = true;
}

void XmlWriter::close() {
  if (inTag_) {
    text() += "/>";
  } else {
    text() += '\n';
    text().append(types_.size() - 1, ' ');
    text() += "</" + types_.back() + ">";
  }
  types_.pop_back();
  inTag_ = false;
}

void XmlWriter::use(std::string_view type, std::string_view field, std::string_view def) {
  beginTag(type, field);
  string("USE", def);
  text() += "/>";
  inTag_ = false;
}

void XmlWriter::route(std::string_view fromNode, std::string_view fromField, std::string_view toNode,
                      std::string_view toField) {
  beginTag("ROUTE", {});
  string("fromNode", fromNode);
  string("fromField", fromField);
  string("toNode", toNode);
  string("toField", toField);
  text() += "/>";
  inTag_ = false;
}

void XmlWriter::finish() {
  text() += "\n</Scene>\n</X3D>\n";
  file_.close();
}

void XmlWriter::boolean(std::string_view name, bool value) {
  openField(name, false);
  text() += value ? "true" : "false";
  closeField(false);
}

void XmlWriter::string(std::string_view name, std::string_view value) {
  openField(name, false);
  text() += base::xmlEscaped(cleanText(value));
  closeField(false);
}

void XmlWriter::strings(std::string_view name, std::span<const std::string> values) {
  text() += ' ';
  text() += name;
  text() += "='";
  for (size_t i = 0; i < values.size(); ++i) {
    text() += i > 0 ? " \"" : "\"";
    std::string quoted;
    for (const char c : values[i]) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    text() += base::xmlEscaped(cleanText(quoted));
    text() += '"';
  }
  text() += '\'';
}

void XmlWriter::openField(std::string_view name, bool) {
  text() += ' ';
  text() += name;
  text() += "=\"";
}

void XmlWriter::closeField(bool) { text() += '"'; }

}  // namespace cloudgen::writer
