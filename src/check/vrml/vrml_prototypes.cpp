// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "check/vrml/vrml_reader.hpp"

namespace cloudgen::check {
namespace {

/// The words of an interface, of VRML97 and of X3D.
constexpr std::array<std::pair<std::string_view, Access>, 8> kAccess{
    {{"eventIn", Access::InputOnly},
     {"eventOut", Access::OutputOnly},
     {"field", Access::InitializeOnly},
     {"exposedField", Access::InputOutput},
     {"inputOnly", Access::InputOnly},
     {"outputOnly", Access::OutputOnly},
     {"initializeOnly", Access::InitializeOnly},
     {"inputOutput", Access::InputOutput}}};

const Access* accessOf(std::string_view word) {
  for (const auto& [name, access] : kAccess)
    if (name == word) return &access;
  return nullptr;
}

bool isFieldType(std::string_view type) {
  if (!type.starts_with("SF") && !type.starts_with("MF")) return false;
  const std::string_view value = type.substr(2);
  return tupleSize(type) > 0 || value == "Bool" || value == "String" || value == "Node" || value == "Image";
}

}  // namespace

bool VrmlReader::startsInterface() { return accessOf(tokens_.peek().text) != nullptr; }

FieldKind VrmlReader::readInterface() {
  const Token word = expect(TokenKind::Word, "field, eventIn, eventOut or exposedField");
  const Access* access = accessOf(word.text);
  if (!access)
    throw VrmlFormError{word.where, "vrml-syntax", excerpt(word.text) + " begins no interface",
                        "field, eventIn, eventOut and exposedField do"};
  const Token type = expect(TokenKind::Word, "a field type");
  if (!isFieldType(type.text))
    throw VrmlFormError{type.where, "vrml-syntax", excerpt(type.text) + " is no field type",
                        "SFFloat is one"};
  return {expect(TokenKind::Word, "a name").text, type.text, *access, {}};
}

/// The first value of a field that the document declares: of nodes, any.
void VrmlReader::readDefault(const FieldKind& field, int depth) {
  if (!field.takesNodes()) return void(readValue(field));
  checker_.beginAnything();
  readNodes(field, depth);
  checker_.endAnything();
}

void VrmlReader::readPrototype(bool isExternal) {
  const Token start = tokens_.take();
  constexpr int kNestingLimit = 50;
  if (bodies_ >= kNestingLimit)
    throw VrmlFormError{start.where, "vrml-limit", "prototypes are nested too deep", "flatten them"};
  ++findings_.result().elements;
  const Token name = expect(TokenKind::Word, "the name of a prototype");
  expect(TokenKind::OpenList, "[");
  std::vector<FieldKind> fields;
  while (tokens_.peek().kind != TokenKind::CloseList && !findings_.full()) {
    fields.push_back(readInterface());
    const Access access = fields.back().access;
    const bool hasValue = access == Access::InitializeOnly || access == Access::InputOutput;
    if (hasValue && !isExternal) readDefault(fields.back(), 0);
  }
  if (findings_.full()) return;
  tokens_.take();
  if (isExternal) {
    readValue({"url", "MFString", Access::InitializeOnly, {}});
  } else {
    expect(TokenKind::Open, "{");
    checker_.beginBody();
    ++bodies_;
    while (tokens_.peek().kind != TokenKind::Close && !findings_.full())
      if (!readDeclaration()) readNode("", 0);
    if (!findings_.full()) tokens_.take();
    --bodies_;
    checker_.endBody();
  }
  checker_.prototype(name.text);
  for (FieldKind& field : fields) checker_.interfaceField(std::move(field));
}

}  // namespace cloudgen::check
