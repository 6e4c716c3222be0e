// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/byte_source.hpp"
#include "check/xsd/schema_values.hpp"

namespace cloudgen::check {

/// A compiled XML Schema. Nothing is fetched from the network.
class XmlSchema {
 public:
  /// Throws InputError if the file is missing or is no schema.
  explicit XmlSchema(const std::filesystem::path& file);
  const void* handle() const { return schema_.get(); }
  const SchemaValues& values() const { return values_; }

 private:
  SchemaValues values_;
  std::shared_ptr<void> schema_;
};

struct XmlAttribute {
  std::string_view name;   ///< as written, with its prefix
  std::string_view value;  ///< references replaced; valid during the call only
  Position where;
};

/// What a reader of the document is told; `name` is the local name.
struct XmlVisitor {
  std::function<void(std::string_view name, Position where, std::span<const XmlAttribute> attributes)> start;
  std::function<void()> end;
};

/// Reads the document once in constant memory, validates it against the schema on the way and tells the
/// visitor. No network, no DTD, no entity but XML's own five. Findings: xml-malformed, xml-limit, xml-entity,
/// xml-encoding, schema. Stops at the first thing that is not XML, and when the findings are full. Throws
/// InterruptedError, and what the visitor throws.
void parseXml(ByteSource& source, const XmlSchema& schema, const XmlVisitor& visitor, FindingList& findings,
              const base::Progress& progress);

/// The same without a schema, for those who read what has been validated.
void parseXml(ByteSource& source, const XmlVisitor& visitor, FindingList& findings,
              const base::Progress& progress);

}  // namespace cloudgen::check
