// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/validate_x3d.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/data_dir.hpp"
#include "check/rules/scene_checker.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

/// Elements that are no nodes.
constexpr std::array<std::string_view, 17> kStatements{
    "X3D",     "head",           "component",         "unit",      "meta",  "Scene",      "ROUTE",
    "IMPORT",  "EXPORT",         "ProtoDeclare",      "ProtoBody", "field", "fieldValue", "IS",
    "connect", "ProtoInterface", "ExternProtoDeclare"};

bool isStatement(std::string_view name) {
  return std::find(kStatements.begin(), kStatements.end(), name) != kStatements.end();
}

using Attributes = std::span<const XmlAttribute>;

std::string_view value(Attributes attributes, std::string_view name) {
  for (const XmlAttribute& attribute : attributes)
    if (attribute.name == name) return attribute.value;
  return {};
}

/// "4.0" to 40; 0 if it is no version.
int versionFromText(std::string_view text) {
  if (text.size() != 3 || text[1] != '.') return 0;
  return (text[0] - '0') * 10 + (text[2] - '0');
}

Access accessFromText(std::string_view text) {
  if (text == "initializeOnly") return Access::InitializeOnly;
  if (text == "inputOnly") return Access::InputOnly;
  return text == "outputOnly" ? Access::OutputOnly : Access::InputOutput;
}

/// Tells the scene checker what the XML encoding (ISO/IEC 19776-1) means.
class X3dReader {
 public:
  X3dReader(FindingList& findings, const fs::path& folder) : checker_(findings, folder) {}

  void start(std::string_view name, Position where, Attributes attributes) {
    const Kind parent = open_.empty() ? Kind::Statement : open_.back();
    open_.push_back(kindOf(name));
    switch (open_.back()) {
      case Kind::Node:
        return startNode(name, where, attributes);
      case Kind::Body:
        return checker_.beginBody();
      case Kind::Anything:
        startField(parent, attributes);
        return checker_.beginAnything();
      case Kind::Interface:
        if (name != "ProtoInterface") checker_.prototype(value(attributes, "name"));
        return;
      case Kind::Statement:
        return startStatement(name, where, attributes);
    }
  }

  void end() {
    if (open_.back() == Kind::Node) checker_.end();
    if (open_.back() == Kind::Body) checker_.endBody();
    if (open_.back() == Kind::Anything) checker_.endAnything();
    open_.pop_back();
  }

  void finish() { checker_.finish(); }

 private:
  enum class Kind { Statement, Node, Body, Anything, Interface };

  static Kind kindOf(std::string_view name) {
    if (!isStatement(name)) return Kind::Node;
    if (name == "ProtoBody") return Kind::Body;
    if (name == "field" || name == "fieldValue") return Kind::Anything;
    const bool declares = name == "ProtoDeclare" || name == "ExternProtoDeclare" || name == "ProtoInterface";
    return declares ? Kind::Interface : Kind::Statement;
  }

  /// A field that the document gives to a prototype, or to a script or shader.
  void startField(Kind parent, Attributes attributes) {
    if (parent != Kind::Interface && parent != Kind::Node) return;
    FieldKind field{std::string(value(attributes, "name")),
                    std::string(value(attributes, "type")),
                    accessFromText(value(attributes, "accessType")),
                    {}};
    if (parent == Kind::Node)
      checker_.ownField(std::move(field));
    else
      checker_.interfaceField(std::move(field));
  }

  void startNode(std::string_view name, Position where, Attributes attributes) {
    checker_.begin(name, where, value(attributes, "containerField"));
    const std::string_view use = value(attributes, "USE");
    if (name == "ProtoInstance" && use.empty()) checker_.instanceOf(value(attributes, "name"), where);
    for (const XmlAttribute& attribute : attributes) {
      if (attribute.name == "DEF") checker_.define(attribute.value, attribute.where);
    }
    for (const XmlAttribute& attribute : attributes) {
      if (attribute.name == "USE")
        checker_.use(attribute.value, attribute.where);
      else if (attribute.name != "DEF")
        checker_.field(attribute.name, attribute.value, attribute.where);
    }
  }

  void startStatement(std::string_view name, Position where, Attributes attributes) {
    if (name == "X3D")
      checker_.document(versionFromText(value(attributes, "version")), value(attributes, "profile"), where);
    if (name == "IMPORT") {
      const std::string_view alias = value(attributes, "AS");
      checker_.foreignName(alias.empty() ? value(attributes, "importedDEF") : alias);
    }
    if (name == "component") {
      const std::string_view text = value(attributes, "level");
      int level = 0;
      std::from_chars(text.data(), text.data() + text.size(), level);
      checker_.component(value(attributes, "name"), level);
    }
    const auto text = [&](std::string_view attribute) { return std::string(value(attributes, attribute)); };
    if (name == "ROUTE")
      checker_.route({text("fromNode"), text("fromField"), text("toNode"), text("toField"), where});
  }

  SceneChecker checker_;
  std::vector<Kind> open_;
};

void validate(ByteSource& source, const XmlSchema& schema, const fs::path& folder, FindingList& findings,
              const base::Progress& progress) {
  X3dReader reader(findings, folder);
  const XmlVisitor visitor{[&](std::string_view name, Position where, Attributes attributes) {
                             reader.start(name, where, attributes);
                           },
                           [&] { reader.end(); }};
  parseXml(source, schema, visitor, findings, progress);
  reader.finish();
}

}  // namespace

const XmlSchema& ChosenSchema::compiled() const {
  if (!schema_) schema_.emplace(file_ ? *file_ : base::dataDir() / "schemas" / "cloudgen-x3d.xsd");
  return *schema_;
}

ValidationResult validateX3d(const fs::path& file, const ChosenSchema& schema,
                             const base::Progress& progress) {
  ByteSource source(file);
  ValidationResult result;
  FindingList findings(file.string(), result);
  const fs::path folder = file.parent_path();
  validate(source, schema.compiled(), folder.empty() ? fs::path(".") : folder, findings, progress);
  return result;
}

ValidationResult validateX3dText(std::string_view text, const std::string& name, const XmlSchema& schema,
                                 const fs::path& folder) {
  ByteSource source(text);
  ValidationResult result;
  FindingList findings(name, result);
  validate(source, schema, folder, findings, {});
  return result;
}

}  // namespace cloudgen::check
