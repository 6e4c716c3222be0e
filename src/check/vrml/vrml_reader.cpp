// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/vrml_reader.hpp"

#include <algorithm>
#include <charconv>

namespace cloudgen::check {
namespace {

constexpr int kDepthLimit = 200;
constexpr int kVrml97 = 20;
constexpr std::size_t kValueBytes = 8 << 20;
constexpr std::uint64_t kReportBytes = 4 << 20;

/// VRML97 has its own names for some fields of X3D.
std::string_view nameInX3d(std::string_view node, std::string_view field) {
  if ((node == "LOD" && field == "level") || (node == "Switch" && field == "choice")) return "children";
  return node == "Collision" && field == "collide" ? "enabled" : field;
}

void append(std::string& values, std::string_view value) {
  if (!values.empty()) values += ' ';
  values += value;
}

}  // namespace

void VrmlReader::read() {
  try {
    readHeader();
    while (tokens_.peek().kind != TokenKind::End && !findings_.full()) readStatement();
    if (tokens_.brokenString())
      throw VrmlFormError{tokens_.peek().where, "vrml-syntax", "a string has no end", "close it with \""};
  } catch (const VrmlFormError& error) {
    findings_.error(error.where, error.rule, error.message, error.hint);
  }
  findings_.result().bytes = tokens_.offset();
  checker_.finish();
}

void VrmlReader::readHeader() {
  const std::string line = tokens_.header();
  const std::string_view form = "#X3D V?.? utf8";
  const bool isX3d = line.size() >= form.size() && line.starts_with("#X3D V") && line[7] == '.' &&
                     line.compare(9, 5, " utf8") == 0;
  version_ = isX3d ? (line[6] - '0') * 10 + (line[8] - '0') : 0;
  if (line.starts_with("#VRML V2.0 utf8")) version_ = kVrml97;
  const bool known = version_ == kVrml97 || (version_ >= 30 && version_ <= 33) || version_ == 40;
  if (!known)
    throw VrmlFormError{{1, 1},
                        "vrml-header",
                        "the first line is " + excerpt(line),
                        "it is \"#VRML V2.0 utf8\" or \"#X3D V4.0 utf8\""};
  checker_.document(version_, version_ == kVrml97 ? "Full" : "Core", {1, 1});
}

Token VrmlReader::expect(TokenKind kind, std::string_view what) {
  Token token = tokens_.take();
  if (tokens_.tooLong())
    throw VrmlFormError{token.where, "vrml-limit",
                        fmt::format("a word or string is over {} bytes", VrmlTokens::kLongest),
                        "is this a VRML file?"};
  if (token.kind == kind) return token;
  throw VrmlFormError{token.where, "vrml-syntax",
                      token.kind == TokenKind::End
                          ? fmt::format("the file ends where {} should stand", what)
                          : fmt::format("{} stands where {} should", excerpt(token.text), what),
                      "check braces, brackets and the field before"};
}

/// A statement that may stand where nodes stand; false if the next is none.
bool VrmlReader::readDeclaration() {
  if (isNext("ROUTE")) return readRoute(), true;
  if (isNext("PROTO")) return readPrototype(false), true;
  if (isNext("EXTERNPROTO")) return readPrototype(true), true;
  if (version_ == kVrml97) return false;
  if (isNext("IMPORT") || isNext("EXPORT")) return readImport(), true;
  return false;
}

void VrmlReader::readStatement() {
  if (readDeclaration()) return;
  const bool isX3d = version_ != kVrml97;
  if (isX3d && isNext("PROFILE")) {
    const Token start = tokens_.take();
    return checker_.document(version_, expect(TokenKind::Word, "a profile").text, start.where);
  }
  if (isX3d && isNext("COMPONENT")) return readComponent();
  if (isX3d && isNext("META")) {
    tokens_.take();
    for (int strings = 2; strings > 0; --strings) expect(TokenKind::String, "a string");
    return;
  }
  if (isX3d && isNext("UNIT")) {
    tokens_.take();
    for (int words = 3; words > 0; --words) expect(TokenKind::Word, "category, name and factor of a unit");
    return;
  }
  readNode("", 0);
}

void VrmlReader::readComponent() {
  tokens_.take();
  const Token token = expect(TokenKind::Word, "a component");
  const auto colon = token.text.find(':');
  int level = 0;
  if (colon != token.text.npos)
    std::from_chars(token.text.data() + colon + 1, token.text.data() + token.text.size(), level);
  if (level < 1)
    throw VrmlFormError{token.where, "vrml-syntax", excerpt(token.text) + " is no component",
                        "write COMPONENT Name:level"};
  checker_.component(token.text.substr(0, colon), level);
}

void VrmlReader::readRoute() {
  const Token start = tokens_.take();
  const Token from = expect(TokenKind::Word, "node.field"), to = expect(TokenKind::Word, "TO"),
              target = expect(TokenKind::Word, "node.field");
  const auto dot = from.text.find('.'), targetDot = target.text.find('.');
  if (to.text != "TO" || dot == from.text.npos || targetDot == target.text.npos)
    throw VrmlFormError{start.where, "vrml-syntax", "this is no ROUTE",
                        "write ROUTE node.field TO node.field"};
  ++findings_.result().elements;
  checker_.route({from.text.substr(0, dot), from.text.substr(dot + 1), target.text.substr(0, targetDot),
                  target.text.substr(targetDot + 1), start.where});
}

void VrmlReader::readImport() {
  const Token start = tokens_.take();
  const Token what = expect(TokenKind::Word, "a name");
  std::string name = what.text.substr(what.text.find('.') + 1);
  if (isNext("AS")) {
    tokens_.take();
    name = expect(TokenKind::Word, "a name").text;
  }
  if (start.text == "IMPORT") checker_.foreignName(name);
}

void VrmlReader::readNode(std::string_view container, int depth) {
  if (depth + bodies_ > kDepthLimit)
    throw VrmlFormError{tokens_.peek().where, "vrml-limit",
                        fmt::format("nodes are nested over {} deep", kDepthLimit), "flatten the scene"};
  ++findings_.result().elements;
  Token token = expect(TokenKind::Word, "a node");
  if (token.text == "USE") {
    const Token name = expect(TokenKind::Word, "a name");
    checker_.begin(checker_.typeOf(name.text), token.where, container);
    checker_.use(name.text, name.where);
    return checker_.end();
  }
  Token name;
  if (token.text == "DEF")
    name = expect(TokenKind::Word, "a name"), token = expect(TokenKind::Word, "a node");
  const bool isInstance = checker_.isPrototype(token.text);
  if (!isInstance && !nodeKind(token.text)) {
    findings_.error(token.where, "vrml-node", excerpt(token.text) + " is no node and no prototype",
                    "is it misspelt, or the field before it? a PROTO stands before its use");
    checker_.beginAnything();  // so that a USE of it has something to mean
    if (!name.text.empty()) checker_.foreignName(name.text);
    skipBody();
    return checker_.endAnything();
  }
  checker_.begin(token.text, token.where, container);
  if (isInstance) checker_.instanceOf(token.text, token.where);
  if (!name.text.empty()) checker_.define(name.text, name.where);
  readBody(depth);
  checker_.end();
  if (tokens_.offset() - reported_ > kReportBytes) {
    reported_ = tokens_.offset();
    progress_.step("validate", static_cast<double>(reported_) /
                                   static_cast<double>(std::max<std::uint64_t>(source_.size(), 1)));
  }
}

void VrmlReader::readBody(int depth) {
  expect(TokenKind::Open, "{");
  while (tokens_.peek().kind != TokenKind::Close && !findings_.full()) readField(depth);
  if (!findings_.full()) tokens_.take();
}

/// Passes over the body of a node that nothing is known about.
void VrmlReader::skipBody() {
  expect(TokenKind::Open, "{");
  for (std::uint64_t open = 1; open > 0;) {
    const Token token = tokens_.take();
    if (token.kind == TokenKind::Open) ++open;
    if (token.kind == TokenKind::Close) --open;
    if (token.kind == TokenKind::End || tokens_.tooLong())
      throw VrmlFormError{token.where, "vrml-syntax", "the file ends where } should stand",
                          "count the braces"};
  }
}

void VrmlReader::readField(int depth) {
  if (readDeclaration()) return;
  const NodeKind* node = checker_.current();
  if (node && node->isOpen && startsInterface()) {
    const FieldKind field = readInterface();
    checker_.ownField(field);
    const bool hasValue = field.access == Access::InitializeOnly || field.access == Access::InputOutput;
    if (hasValue && !isNext("IS")) return readDefault(field, depth);
    if (isNext("IS")) tokens_.take(), expect(TokenKind::Word, "a field of the prototype");
    return;
  }
  const Token token = expect(TokenKind::Word, "a field or }");
  const std::string_view type = node ? std::string_view(node->name) : "the prototype";
  const FieldKind* field =
      checker_.currentField(version_ == kVrml97 ? nameInX3d(type, token.text) : std::string_view(token.text));
  if (!field)
    throw VrmlFormError{token.where, "vrml-field",
                        fmt::format("{} has no field {}", type, excerpt(token.text)),
                        "see the fields of the node in the specification"};
  readFieldValue(*field, token.where, depth);
}

void VrmlReader::readFieldValue(const FieldKind& field, Position where, int depth) {
  if (isNext("IS")) {
    tokens_.take();
    const Token name = expect(TokenKind::Word, "a field of the prototype");
    if (bodies_ == 0)
      findings_.error(name.where, "vrml-is", "IS stands outside of a prototype", "give the field a value");
    return;
  }
  if (field.access == Access::InputOnly || field.access == Access::OutputOnly)
    throw VrmlFormError{where, "vrml-field", fmt::format("{} cannot be given in a file", field.name),
                        "it is an event: route it"};
  if (field.takesNodes()) return readNodes(field, depth);
  checker_.field(field.name, readValue(field), where);
}

void VrmlReader::readNodes(const FieldKind& field, int depth) {
  if (isNext("NULL")) return void(tokens_.take());
  if (tokens_.peek().kind != TokenKind::OpenList) return readNode(field.name, depth + 1);
  const Token open = tokens_.take();
  if (field.type == "SFNode")
    throw VrmlFormError{open.where, "vrml-syntax", fmt::format("{} takes one node, not a list", field.name),
                        "leave the brackets out"};
  while (tokens_.peek().kind != TokenKind::CloseList && !findings_.full())
    if (!readDeclaration()) readNode(field.name, depth + 1);
  if (!findings_.full()) tokens_.take();
}

/// A value as the XML encoding would have it.
std::string VrmlReader::readValue(const FieldKind& field) {
  if (field.type == "SFString") return expect(TokenKind::String, "a string").text;
  if (field.type == "SFImage") return readImage();
  const bool isString = field.type == "MFString";
  const TokenKind kind = isString ? TokenKind::String : TokenKind::Word;
  const std::string_view what = isString ? "a string" : "a value";
  std::string value;
  if (!field.type.starts_with("MF") || tokens_.peek().kind != TokenKind::OpenList) {
    for (int count = std::max(tupleSize(field.type), 1); count > 0; --count)
      append(value, expect(kind, what).text);
    return value;
  }
  const Position start = tokens_.take().where;
  while (tokens_.peek().kind == kind && !tokens_.tooLong()) {
    tokens_.takeInto(value);
    if (value.size() > kValueBytes)
      throw VrmlFormError{start, "vrml-limit",
                          fmt::format("the value of {} is over {} bytes", field.name, kValueBytes),
                          "split the geometry: viewers choke on such values too"};
  }
  expect(TokenKind::CloseList, fmt::format("{} or ]", what));
  return value;
}

/// Width, height and components, then as many pixels.
std::string VrmlReader::readImage() {
  std::string value;
  std::uint64_t pixels = 1;
  for (int i = 0; i < 3; ++i) {
    const Token token = expect(TokenKind::Word, "a number of the image");
    std::uint64_t number = 0;
    std::from_chars(token.text.data(), token.text.data() + token.text.size(), number);
    if (number > 65536)
      throw VrmlFormError{token.where, "vrml-limit", "an image of " + excerpt(token.text) + " pixels",
                          "put it into a file of its own"};
    if (i < 2) pixels *= number;
    append(value, token.text);
  }
  for (; pixels > 0; --pixels) expect(TokenKind::Word, "a pixel of the image");
  return value;
}

}  // namespace cloudgen::check
