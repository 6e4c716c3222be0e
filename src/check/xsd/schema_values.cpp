// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/schema_values.hpp"

#include <set>

#include "check/xsd/xml_parser.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

constexpr int kDerivationLimit = 100;

/// A simple type: text that is collapsed and fits one of the patterns, or something else.
struct SimpleType {
  std::string base;
  std::string pattern;
  bool collapsed = false, isText = true;
};

struct AttributeUse {
  std::string name, type;
};

/// A complex type or a group of attributes.
struct AttributeList {
  std::string base;  ///< of an extension
  std::vector<AttributeUse> attributes;
  std::vector<std::string> groups;
  bool plain = true;
};

std::string value(std::span<const XmlAttribute> attributes, std::string_view name) {
  for (const XmlAttribute& attribute : attributes)
    if (attribute.name == name) return std::string(attribute.value);
  return {};
}

/// What the files of a schema say, by name; anonymous types get names that XML cannot spell.
class Definitions {
 public:
  explicit Definitions(const fs::path& schema) { readFile(schema); }

  bool plain() const { return plain_; }
  const std::map<std::string, std::string>& elements() const { return elements_; }

  std::shared_ptr<const SchemaValues::Type> typeOf(const std::string& name) {
    const auto found = simple_.find(name);
    if (found == simple_.end() || !found->second.isText || !found->second.collapsed ||
        found->second.pattern.empty())
      return nullptr;
    if (!found->second.base.ends_with(":string") || ambiguous_.contains(name)) return nullptr;
    auto& type = types_[found->second.pattern];
    if (!type) type = std::make_shared<const SchemaValues::Type>(found->second.pattern);
    return type;
  }

  /// Adds the attributes of a type and of what it extends; false if they are not certain.
  bool collect(const std::string& type, SchemaValues::Attributes& all, int depth = 0) {
    const auto found = complex_.find(type);
    if (found == complex_.end() || !found->second.plain || ambiguous_.contains(type) ||
        depth > kDerivationLimit)
      return false;
    const AttributeList& list = found->second;
    if (!list.base.empty() && !collect(list.base, all, depth + 1)) return false;
    for (const std::string& group : list.groups)
      if (!collect("group " + group, all, depth + 1)) return false;
    for (const AttributeUse& use : list.attributes)
      if (auto known = typeOf(use.type)) all.push_back({use.name, std::move(known)});
    return true;
  }

 private:
  void readFile(const fs::path& file) {
    if (!seen_.insert(file.lexically_normal().string()).second) return;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      plain_ = false;
      return;
    }
    ByteSource source(file);
    ValidationResult result;
    FindingList findings(file.string(), result);
    std::vector<fs::path> includes;
    const XmlVisitor visitor{[&](std::string_view name, Position, std::span<const XmlAttribute> attributes) {
                               open_.emplace_back(name);
                               if (name == "include")
                                 includes.push_back(file.parent_path() / value(attributes, "schemaLocation"));
                               start(name, attributes);
                             },
                             [&] { end(); }};
    parseXml(source, visitor, findings, {});
    plain_ = plain_ && result.valid();
    for (const fs::path& include : includes) readFile(include);
  }

  void start(std::string_view name, std::span<const XmlAttribute> attributes) {
    if (name == "annotation") ++silent_;
    if (silent_ > 0) return;
    const bool isKey = name == "key" || name == "keyref" || name == "unique";  // these compare values
    if (isKey || name == "import" || name == "redefine" || !value(attributes, "targetNamespace").empty())
      plain_ = false;
    if (name == "simpleType") return startType(value(attributes, "name"), simpleNames_, simple_);
    if (name == "complexType") return startComplexType(value(attributes, "name"));
    if (name == "attributeGroup" && !value(attributes, "name").empty())
      return startComplexType("group " + value(attributes, "name"));
    if (name == "element") return startElement(attributes);
    if (name == "attribute") return startAttribute(attributes);
    if (!simpleNames_.empty()) return startFacet(name, attributes);
    if (complexNames_.empty()) return;
    AttributeList& list = complex_[complexNames_.back()];
    if (name == "attributeGroup") list.groups.push_back(value(attributes, "ref"));
    if (name == "extension") list.base = value(attributes, "base");
    if (name == "restriction" || name == "anyAttribute" || name == "simpleContent") list.plain = false;
  }

  template <typename Type>
  void startType(std::string name, std::vector<std::string>& names, std::map<std::string, Type>& types) {
    if (name.empty()) name = "anonymous " + std::to_string(++anonymous_);
    if (types.contains(name)) ambiguous_.insert(name);
    types[name] = {};
    names.push_back(std::move(name));
  }

  void startComplexType(std::string name) {
    startType(std::move(name), complexNames_, complex_);
    if (!elementNames_.empty() && complexNames_.size() == 1)
      setElement(elementNames_.back(), complexNames_.back());
  }

  void startFacet(std::string_view name, std::span<const XmlAttribute> attributes) {
    SimpleType& type = simple_[simpleNames_.back()];
    if (name == "restriction") {
      type.base = value(attributes, "base");
    } else if (name == "pattern") {  // several of one type are alternatives
      const std::string pattern = '(' + value(attributes, "value") + ')';
      type.pattern += (type.pattern.empty() ? "" : "|") + pattern;
    } else if (name == "whiteSpace") {
      type.collapsed = value(attributes, "value") == "collapse";
    } else {
      type.isText = false;
    }
  }

  void startElement(std::span<const XmlAttribute> attributes) {
    const std::string name = value(attributes, "name"), type = value(attributes, "type");
    elementNames_.push_back(name);
    if (!type.empty()) setElement(name, type);
    if (!name.empty() && !complexNames_.empty()) elements_[name] = "";  // a local one
  }

  void setElement(const std::string& name, const std::string& type) {
    const auto [found, isNew] = elements_.try_emplace(name, type);
    if (!isNew && found->second != type) found->second = "";
  }

  void startAttribute(std::span<const XmlAttribute> attributes) {
    if (complexNames_.empty()) return;
    AttributeList& list = complex_[complexNames_.back()];
    if (!value(attributes, "ref").empty() || !value(attributes, "fixed").empty() ||
        value(attributes, "use") == "prohibited")
      list.plain = false;
    list.attributes.push_back({value(attributes, "name"), value(attributes, "type")});
  }

  void end() {
    const std::string name = std::move(open_.back());
    open_.pop_back();
    if (name == "annotation") return void(--silent_);
    if (silent_ > 0) return;
    if (name == "simpleType") {
      const std::string type = std::move(simpleNames_.back());
      simpleNames_.pop_back();
      if (!simpleNames_.empty()) simple_[simpleNames_.back()].isText = false;
      const bool isOfAttribute = !open_.empty() && open_.back() == "attribute" && !complexNames_.empty();
      if (isOfAttribute) complex_[complexNames_.back()].attributes.back().type = type;
    }
    const bool isGroup = name == "attributeGroup" && !complexNames_.empty() && open_.size() == 1;
    if (name == "complexType" || isGroup) complexNames_.pop_back();
    if (name == "element") elementNames_.pop_back();
  }

  bool plain_ = true;
  int silent_ = 0, anonymous_ = 0;
  std::set<std::string> seen_, ambiguous_;
  std::vector<std::string> open_, simpleNames_, complexNames_, elementNames_;
  std::map<std::string, SimpleType> simple_;
  std::map<std::string, AttributeList> complex_;
  std::map<std::string, std::string> elements_;  ///< name to complex type; empty where there are several
  std::map<std::string, std::shared_ptr<const SchemaValues::Type>> types_;  ///< by pattern
};

}  // namespace

const Pattern* SchemaValues::Type::pattern() const {
  if (!pattern_) pattern_ = Pattern::compiled(expression_);
  return *pattern_ ? &**pattern_ : nullptr;
}

SchemaValues::SchemaValues(const fs::path& schema) {
  Definitions definitions(schema);
  if (!definitions.plain()) return;
  for (const auto& [element, type] : definitions.elements()) {
    Attributes attributes;
    if (!type.empty() && definitions.collect(type, attributes))
      elements_.emplace(element, std::move(attributes));
  }
}

const SchemaValues::Attributes* SchemaValues::of(std::string_view element) const {
  const auto found = elements_.find(element);
  return found == elements_.end() ? nullptr : &found->second;
}

}  // namespace cloudgen::check
