// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/xml_parser.hpp"

#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/xmlIO.h>
#include <libxml/xmlschemas.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "check/xsd/xml_scanner.hpp"

namespace cloudgen::check {
namespace {

void initOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    xmlInitParser();
    xmlSetExternalEntityLoader(xmlNoNetExternalEntityLoader);
  });
}

std::string_view view(const xmlChar* text) {
  return text ? reinterpret_cast<const char*>(text) : std::string_view{};
}

/// libxml2's message as one line without the regular expression of a pattern or a value of megabytes.
std::string oneLine(const char* message) {
  std::string line = message ? message : "";
  if (const auto pattern = line.find("' is not accepted by the pattern '"); pattern != line.npos)
    line.resize(pattern), line += "' has the wrong form.";
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  if (const auto value = line.find("The value '"); value != line.npos && line.size() > value + 120) {
    const auto close = line.rfind("' ");
    const std::string rest = close != line.npos && close > value + 11 ? line.substr(close) : "'";
    line = line.substr(0, value + 60) + "..." + rest;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  if (line.size() > 400) line = line.substr(0, 400) + "...";
  return line;
}

/// libxml2's schema validator as something that is told of a document.
class Validator {
 public:
  Validator(const XmlSchema& schema, xmlStructuredErrorFunc onProblem, void* data)
      : values_(schema.values()),
        context_(xmlSchemaNewValidCtxt(static_cast<xmlSchemaPtr>(const_cast<void*>(schema.handle())))) {
    nothing_.initialized = XML_SAX2_MAGIC;
    if (context_) xmlSchemaSetValidStructuredErrors(context_, onProblem, data);
    if (context_) plug_ = xmlSchemaSAXPlug(context_, &handler_, &data_);
    if (plug_) return;
    xmlSchemaFreeValidCtxt(context_);
    throw base::OutputError("validate", "memory ran out", "close other programs");
  }
  ~Validator() {
    xmlSchemaSAXUnplug(plug_);
    xmlSchemaFreeValidCtxt(context_);
  }
  Validator(const Validator&) = delete;
  Validator& operator=(const Validator&) = delete;

  void start(const xmlChar* name, const xmlChar* prefix, const xmlChar* uri, int namespaces,
             const xmlChar** spaces, int count, int defaulted, const xmlChar** attributes) {
    handler_->startElementNs(data_, name, prefix, uri, namespaces, spaces, count, defaulted,
                             uri ? attributes : shortened(view(name), count, attributes));
  }
  void end(const xmlChar* name, const xmlChar* prefix, const xmlChar* uri) {
    handler_->endElementNs(data_, name, prefix, uri);
  }
  void text(const xmlChar* text, int length) { handler_->characters(data_, text, length); }

 private:
  /// The attributes with those values that are known to fit replaced by short ones that fit too. An attribute
  /// with a prefix (xsi:type) may change the type: then they are left alone.
  const xmlChar** shortened(std::string_view element, int count, const xmlChar** attributes) {
    const SchemaValues::Attributes* known = values_.of(element);
    if (!known) return attributes;
    shortened_.assign(attributes, attributes + 5 * count);
    for (int i = 0; i < count; ++i) {
      const xmlChar** attribute = shortened_.data() + 5 * i;
      if (attribute[1]) return attributes;
      const std::string_view name = view(attribute[0]);
      const auto found = std::find_if(known->begin(), known->end(),
                                      [&](const auto& candidate) { return candidate.name == name; });
      const Pattern* pattern = found == known->end() ? nullptr : found->type->pattern();
      const char* begin = reinterpret_cast<const char*>(attribute[3]);
      if (!pattern || !pattern->accepts({begin, static_cast<std::size_t>(attribute[4] - attribute[3])}))
        continue;
      const std::string& text = pattern->shortest();
      attribute[3] = reinterpret_cast<const xmlChar*>(text.data());
      attribute[4] = attribute[3] + text.size();
    }
    return shortened_.data();
  }

  const SchemaValues& values_;
  xmlSchemaValidCtxtPtr context_;
  xmlSAXHandler nothing_{};
  xmlSAXHandlerPtr handler_ = &nothing_;
  void* data_ = this;
  xmlSchemaSAXPlugPtr plug_ = nullptr;
  std::vector<const xmlChar*> shortened_;
};

/// One pass over one document: scanner, libxml2's parser, the visitor and the validator, in this order.
struct Pass {
  ByteSource& source;
  const XmlVisitor& visitor;
  FindingList& findings;
  const base::Progress& progress;
  XmlScanner scanner{};
  std::string_view chunk{};
  std::uint64_t given = 0, reported = 0;
  TagPosition tag{};
  std::vector<XmlAttribute> attributes{};
  std::vector<std::string> prefixed{};
  xmlParserCtxtPtr parser = nullptr;
  std::optional<Validator> validator{};
  std::exception_ptr failure{};
  bool stopped = false;

  void stop() {
    stopped = true;
    if (parser) xmlStopParser(parser);
  }

  int read(char* buffer, int length) {
    if (stopped || length <= 0) return 0;
    if (chunk.empty()) {
      chunk = source.next();
      if (const auto refusal = scanner.scan(chunk)) {
        findings.error(refusal->where, refusal->rule, refusal->message, refusal->hint);
        stopped = true;  // to the parser this is the end of the file: it must not be halted while it reads
        return 0;
      }
      if (given - reported > (4u << 20)) {
        reported = given;
        progress.step("validate", static_cast<double>(given) /
                                      static_cast<double>(std::max<std::uint64_t>(source.size(), 1)));
      }
    }
    const std::size_t count = std::min(chunk.size(), static_cast<std::size_t>(length));
    std::memcpy(buffer, chunk.data(), count);
    chunk.remove_prefix(count);
    given += count;
    return static_cast<int>(count);
  }

  Position parserPosition() const {
    if (!parser || !parser->input) return {};
    return {static_cast<std::uint64_t>(std::max(parser->input->line, 1)),
            static_cast<std::uint64_t>(std::max(parser->input->col, 1))};
  }

  /// The next start tag has been parsed: the scanner, always ahead, knows where it stands.
  void takeTag() {
    if (!scanner.take(tag)) tag = {parserPosition(), {}};
  }

  Position attributePosition(std::string_view name) const {
    for (const auto& attribute : tag.attributes)
      if (attribute.name == name) return attribute.where;
    return tag.where;
  }

  void start(const xmlChar* localName, int count, const xmlChar** values) {
    takeTag();
    attributes.clear();
    prefixed.clear();
    prefixed.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const xmlChar** value = values + 5 * i;  // local name, prefix, namespace, begin, end
      std::string_view name = view(value[0]);
      if (value[1]) name = prefixed.emplace_back(std::string(view(value[1])) + ':' + std::string(name));
      const char* begin = reinterpret_cast<const char*>(value[3]);
      attributes.push_back(
          {name, {begin, static_cast<std::size_t>(value[4] - value[3])}, attributePosition(name)});
    }
    ++findings.result().elements;
    visitor.start(view(localName), tag.where, attributes);
    if (findings.full()) stop();
  }

  void xmlProblem(const xmlError* error) {
    if (stopped || !error) return;
    const bool undeclared = error->code == XML_WAR_UNDECLARED_ENTITY;
    if (error->level < XML_ERR_ERROR && !undeclared) return;
    const Position where{static_cast<std::uint64_t>(std::max(error->line, 1)),
                         static_cast<std::uint64_t>(std::max(error->int2, 1))};
    if (undeclared || error->code == XML_ERR_UNDECLARED_ENTITY)
      findings.error(where, "xml-entity", oneLine(error->message),
                     "only &lt; &gt; &amp; &quot; &apos; and character numbers are read");
    else
      findings.error(where, "xml-malformed", oneLine(error->message),
                     "mend the XML: nothing after this place was checked");
    stop();
  }

  void schemaProblem(const xmlError* error) {
    if (stopped || !error || error->level < XML_ERR_ERROR) return;
    const std::string message = oneLine(error->message);
    Position where = tag.where;
    if (const auto at = message.find(", attribute '"); at != message.npos) {
      const std::size_t begin = at + 13;
      where = attributePosition(std::string_view(message).substr(begin, message.find('\'', begin) - begin));
    }
    findings.error(where, "schema", message, "see the X3D specification of the node, or the schema");
    if (findings.full()) stop();
  }
};

/// Calls a member of the pass from C: an exception waits there until the parser has returned.
template <typename Body>
void guarded(Pass& pass, Body body) {
  try {
    body(pass);
  } catch (...) {
    if (!pass.failure) pass.failure = std::current_exception();
    pass.stopped = true;
  }
}

/// The same for what the parser calls between two tokens, where it can be halted.
template <typename Body>
void guardedEvent(void* data, Body body) {
  Pass& pass = *static_cast<Pass*>(data);
  guarded(pass, body);
  if (pass.stopped) pass.stop();
}

int readChunk(void* data, char* buffer, int length) {
  int count = 0;
  guarded(*static_cast<Pass*>(data), [&](Pass& pass) { count = pass.read(buffer, length); });
  return count;
}

void onStart(void* data, const xmlChar* name, const xmlChar* prefix, const xmlChar* uri, int namespaces,
             const xmlChar** spaces, int count, int defaulted, const xmlChar** attributes) {
  guardedEvent(data, [&](Pass& pass) {
    if (!pass.stopped) pass.start(name, count, attributes);
    if (pass.validator && !pass.stopped)
      pass.validator->start(name, prefix, uri, namespaces, spaces, count, defaulted, attributes);
  });
}

void onEnd(void* data, const xmlChar* name, const xmlChar* prefix, const xmlChar* uri) {
  guardedEvent(data, [&](Pass& pass) {
    if (!pass.stopped) pass.visitor.end();
    if (pass.validator && !pass.stopped) pass.validator->end(name, prefix, uri);
  });
}

void onText(void* data, const xmlChar* text, int length) {
  guardedEvent(data, [&](Pass& pass) {
    if (pass.validator && !pass.stopped) pass.validator->text(text, length);
  });
}

void onXmlProblem(void*, xmlErrorPtr error) {
  if (!error || !error->ctxt) return;
  guardedEvent(static_cast<xmlParserCtxtPtr>(error->ctxt)->_private,
               [&](Pass& pass) { pass.xmlProblem(error); });
}

void onSchemaProblem(void* data, xmlErrorPtr error) {
  guardedEvent(data, [&](Pass& pass) { pass.schemaProblem(error); });
}

struct Freed {
  void operator()(xmlParserCtxtPtr parser) const {
    if (parser->myDoc) xmlFreeDoc(parser->myDoc);
    xmlFreeParserCtxt(parser);
  }
};

void ignoreMessage(void*, xmlErrorPtr) {}

}  // namespace

XmlSchema::XmlSchema(const std::filesystem::path& file) : values_(file) {
  initOnce();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw base::InputError(file.string(), "no such schema", "check the path of --schema");
  const std::unique_ptr<xmlSchemaParserCtxt, decltype(&xmlSchemaFreeParserCtxt)> parser(
      xmlSchemaNewParserCtxt(file.string().c_str()), xmlSchemaFreeParserCtxt);
  if (parser) xmlSchemaSetParserStructuredErrors(parser.get(), ignoreMessage, nullptr);
  // A schema that is not even XML reaches the global handler.
  xmlSetStructuredErrorFunc(nullptr, ignoreMessage);
  xmlSchemaPtr schema = parser ? xmlSchemaParse(parser.get()) : nullptr;
  xmlSetStructuredErrorFunc(nullptr, nullptr);
  if (!schema)
    throw base::InputError(file.string(), "is not an XML Schema that libxml2 can compile",
                           "see `xmllint --schema`");
  schema_.reset(schema, [](void* handle) { xmlSchemaFree(static_cast<xmlSchemaPtr>(handle)); });
}

namespace {

/// With a schema, or with none.
void parse(ByteSource& source, const XmlSchema* schema, const XmlVisitor& visitor, FindingList& findings,
           const base::Progress& progress) {
  initOnce();
  Pass pass{source, visitor, findings, progress};
  if (schema) pass.validator.emplace(*schema, onSchemaProblem, &pass);
  xmlSAXHandler handler{};
  handler.initialized = XML_SAX2_MAGIC;
  handler.startElementNs = onStart;
  handler.endElementNs = onEnd;
  handler.characters = handler.ignorableWhitespace = handler.cdataBlock = onText;
  handler.serror = onXmlProblem;
  const std::unique_ptr<xmlParserCtxt, Freed> parser(
      xmlCreateIOParserCtxt(&handler, &pass, readChunk, nullptr, &pass, XML_CHAR_ENCODING_NONE));
  if (!parser) throw base::OutputError("X3D", "memory ran out", "close other programs");
  // The scanner has its own limits and refuses entities. libxml2's would also stop at sound scenes: it counts
  // 10 MB from where it last tidied its buffer, which it may not do for several megabytes of long values.
  xmlCtxtUseOptions(parser.get(), XML_PARSE_NONET | XML_PARSE_HUGE);
  // xmlCtxtUseOptions copies handlers about: the pass is found again through the parser itself.
  parser->_private = &pass;
  pass.parser = parser.get();
  xmlParseDocument(parser.get());
  if (pass.failure) std::rethrow_exception(pass.failure);
  findings.result().bytes = pass.given;
  if (!parser->wellFormed && !pass.stopped)
    findings.error(pass.parserPosition(), "xml-malformed", "this is no XML document",
                   "is it the right file?");
}

}  // namespace

void parseXml(ByteSource& source, const XmlSchema& schema, const XmlVisitor& visitor, FindingList& findings,
              const base::Progress& progress) {
  parse(source, &schema, visitor, findings, progress);
}

void parseXml(ByteSource& source, const XmlVisitor& visitor, FindingList& findings,
              const base::Progress& progress) {
  parse(source, nullptr, visitor, findings, progress);
}

}  // namespace cloudgen::check
