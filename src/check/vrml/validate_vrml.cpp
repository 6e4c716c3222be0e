// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/validate_vrml.hpp"

#include <charconv>

#include "base/file.hpp"
#include "check/rules/scene_checker.hpp"
#include "check/vrml/vrml_tokens.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

constexpr int kDepthLimit = 200;
constexpr int kVrml97 = 20;

/// Thrown and caught in this file: after a wrong form nothing can be told any more.
struct FormError {
  Position where;
  std::string rule, message, hint;
};

class VrmlReader {
 public:
  VrmlReader(std::string_view text, FindingList& findings, const fs::path& folder,
             const base::Progress& progress)
      : tokens_(text), text_(text), findings_(findings), checker_(findings, folder), progress_(progress) {}

  void read() {
    try {
      readHeader();
      while (tokens_.peek().kind != TokenKind::End && !findings_.full()) readStatement("");
      if (tokens_.brokenString())
        throw FormError{tokens_.peek().where, "vrml-syntax", "a string has no end", "close it with \""};
    } catch (const FormError& error) {
      findings_.error(error.where, error.rule, error.message, error.hint);
    }
    checker_.finish();
  }

 private:
  void readHeader() {
    const std::string_view line = text_.substr(0, text_.find_first_of("\r\n"));
    if (line.starts_with("#VRML V2.0 utf8"))
      version_ = kVrml97;
    else if (line.starts_with("#X3D V3.3 utf8"))
      version_ = 33;
    else if (line.starts_with("#X3D V4.0 utf8"))
      version_ = 40;
    else
      throw FormError{{1, 1},
                      "vrml-header",
                      "the first line is " + excerpt(line),
                      "it is \"#VRML V2.0 utf8\" or \"#X3D V4.0 utf8\""};
    checker_.document(version_, version_ == kVrml97 ? "Full" : "Core", {1, 1});
  }

  Token expect(TokenKind kind, std::string_view what) {
    const Token token = tokens_.take();
    if (token.kind == kind) return token;
    throw FormError{token.where, "vrml-syntax",
                    token.kind == TokenKind::End
                        ? fmt::format("the file ends where {} should stand", what)
                        : fmt::format("{} stands where {} should", excerpt(token.text), what),
                    "check braces, brackets and the field before"};
  }

  /// A statement of the file or, in a node, of its body.
  void readStatement(std::string_view container) {
    const Token token = tokens_.peek();
    if (token.text == "ROUTE") return readRoute();
    if (token.text == "PROFILE") {
      tokens_.take();
      return checker_.document(version_, expect(TokenKind::Word, "a profile").text, token.where);
    }
    if (token.text == "COMPONENT") return readComponent();
    if (token.text == "META" || token.text == "UNIT") {
      for (int words = token.text == "META" ? 3 : 4; words > 0; --words) tokens_.take();
      return;
    }
    readNode(container, 0);
  }

  void readComponent() {
    tokens_.take();
    const Token token = expect(TokenKind::Word, "a component");
    const auto colon = token.text.find(':');
    int level = 0;
    if (colon != token.text.npos)
      std::from_chars(token.text.data() + colon + 1, token.text.data() + token.text.size(), level);
    if (level < 1)
      throw FormError{token.where, "vrml-syntax", excerpt(token.text) + " is no component",
                      "write COMPONENT Name:level"};
    checker_.component(token.text.substr(0, colon), level);
  }

  void readRoute() {
    const Token start = tokens_.take();
    const Token from = expect(TokenKind::Word, "node.field"), to = expect(TokenKind::Word, "TO"),
                target = expect(TokenKind::Word, "node.field");
    const auto dot = from.text.find('.'), targetDot = target.text.find('.');
    if (to.text != "TO" || dot == from.text.npos || targetDot == target.text.npos)
      throw FormError{start.where, "vrml-syntax", "this is no ROUTE", "write ROUTE node.field TO node.field"};
    ++findings_.result().elements;
    checker_.route({std::string(from.text.substr(0, dot)), std::string(from.text.substr(dot + 1)),
                    std::string(target.text.substr(0, targetDot)),
                    std::string(target.text.substr(targetDot + 1)), start.where});
  }

  void readNode(std::string_view container, int depth) {
    if (depth > kDepthLimit)
      throw FormError{tokens_.peek().where, "vrml-limit",
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
    if (!nodeKind(token.text))
      throw FormError{token.where, "vrml-node", excerpt(token.text) + " is no node that cloudgen knows",
                      "known are the nodes of its X3D profile; is a field misspelt?"};
    checker_.begin(token.text, token.where, container);
    if (!name.text.empty()) checker_.define(name.text, name.where);
    expect(TokenKind::Open, "{");
    while (tokens_.peek().kind != TokenKind::Close && !findings_.full()) readField(depth);
    if (!findings_.full()) tokens_.take();
    checker_.end();
    progress_.step("validate",
                   static_cast<double>(token.text.data() - text_.data()) / static_cast<double>(text_.size()));
  }

  void readField(int depth) {
    if (tokens_.peek().text == "ROUTE") return readRoute();
    const Token token = expect(TokenKind::Word, "a field or }");
    // VRML97 has its own names for the children of two nodes.
    const std::string& type = checker_.current()->name;
    const bool isChildren = version_ == kVrml97 && ((type == "LOD" && token.text == "level") ||
                                                    (type == "Switch" && token.text == "choice"));
    const FieldKind* field = checker_.current()->field(isChildren ? "children" : token.text);
    if (!field)
      throw FormError{token.where, "vrml-field", fmt::format("{} has no field {}", type, excerpt(token.text)),
                      "see the fields of the node in the specification"};
    if (field->type == "SFNode" || field->type == "MFNode") return readNodes(*field, depth);
    readValue(*field, token.where);
  }

  void readNodes(const FieldKind& field, int depth) {
    if (tokens_.peek().text == "NULL") return void(tokens_.take());
    if (tokens_.peek().kind != TokenKind::OpenList) return readNode(field.name, depth + 1);
    const Token open = tokens_.take();
    if (field.type == "SFNode")
      throw FormError{open.where, "vrml-syntax", fmt::format("{} takes one node, not a list", field.name),
                      "leave the brackets out"};
    while (tokens_.peek().kind != TokenKind::CloseList && !findings_.full()) readNode(field.name, depth + 1);
    if (!findings_.full()) tokens_.take();
  }

  void readValue(const FieldKind& field, Position where) {
    if (field.type == "SFString") return void(expect(TokenKind::String, "a string"));
    std::string value;
    if (field.type.starts_with("MF") && tokens_.peek().kind == TokenKind::OpenList) {
      tokens_.take();
      while (tokens_.peek().kind == TokenKind::Word || tokens_.peek().kind == TokenKind::String)
        append(value, tokens_.take().text);
      expect(TokenKind::CloseList, "]");
    } else {
      const bool isString = field.type == "MFString";
      const int count = std::max(tupleSize(field.type), 1);
      for (int i = 0; i < count; ++i)
        append(
            value,
            expect(isString ? TokenKind::String : TokenKind::Word, isString ? "a string" : "a value").text);
    }
    checker_.field(field.name, value, where);
  }

  static void append(std::string& value, std::string_view piece) {
    if (!value.empty()) value += ' ';
    value += piece;
  }

  VrmlTokens tokens_;
  std::string_view text_;
  FindingList& findings_;
  SceneChecker checker_;
  const base::Progress& progress_;
  int version_ = 40;
};

}  // namespace

ValidationResult validateVrmlText(std::string_view text, const std::string& name, const fs::path& folder,
                                  const base::Progress& progress) {
  ValidationResult result;
  result.bytes = text.size();
  FindingList findings(name, result);
  VrmlReader(text, findings, folder, progress).read();
  return result;
}

ValidationResult validateVrml(const fs::path& file, const std::optional<fs::path>&,
                              const base::Progress& progress) {
  const std::string text = base::readFile(file);
  const fs::path folder = file.parent_path();
  return validateVrmlText(text, file.string(), folder.empty() ? fs::path(".") : folder, progress);
}

}  // namespace cloudgen::check
