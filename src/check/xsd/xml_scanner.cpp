// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/xml_scanner.hpp"

#include <array>
#include <cstring>

#include "base/text.hpp"

namespace cloudgen::check {
namespace {

bool isSpace(char character) {
  return character == ' ' || character == '\n' || character == '\t' || character == '\r';
}

}  // namespace

/// Goes over bytes that end nothing.
void XmlScanner::pass(std::string_view run) {
  const char* from = run.data();
  const char* end = from + run.size();
  while (const void* newline =
             from == end ? nullptr : std::memchr(from, '\n', static_cast<std::size_t>(end - from))) {
    from = static_cast<const char*>(newline) + 1;
    ++line_, lineStart_ = offset_ + static_cast<std::uint64_t>(from - run.data());
  }
  offset_ += run.size();
}

bool XmlScanner::take(TagPosition& tag) {
  if (tags_.empty()) return false;
  std::swap(tag, tags_.front());
  spare_.push_back(std::move(tags_.front()));
  tags_.pop_front();
  return true;
}

std::optional<Refusal> XmlScanner::scan(std::string_view chunk) {
  if (first_ && !chunk.empty()) {
    first_ = false;
    if (chunk.substr(0, 4).find('\0') != chunk.npos || chunk.starts_with("\xff\xfe") ||
        chunk.starts_with("\xfe\xff"))
      refuse("xml-encoding", "the text is UTF-16 or UTF-32, or no text", "save the scene as UTF-8");
    if (chunk.starts_with("\xef\xbb\xbf")) chunk.remove_prefix(3);  // a byte order mark takes no column
  }
  while (!chunk.empty() && !refusal_) {
    std::size_t bulk = 0;  // bytes up to the one that ends a value or a run of text
    if (state_ == State::Value) bulk = std::min(chunk.find(quote_), chunk.size());
    if (state_ == State::Text) bulk = std::min(chunk.find('<'), chunk.size());
    if (bulk > 0) {
      run_ += bulk;
      pass(chunk.substr(0, bulk));
      chunk.remove_prefix(bulk);
      if (state_ == State::Value && run_ > limits_.attributeBytes)
        refuse("xml-limit",
               fmt::format("the value of {} is over {} bytes", excerpt(tag_.attributes.back().name),
                           limits_.attributeBytes),
               "split the geometry: viewers choke on such values too");
      if (state_ == State::Text && run_ > limits_.textBytes)
        refuse("xml-limit", fmt::format("a run of text over {} bytes", limits_.textBytes),
               "X3D keeps its data in attributes");
      continue;
    }
    const char character = chunk.front();
    step(character);
    ++offset_;
    if (character == '\n') ++line_, lineStart_ = offset_;
    chunk.remove_prefix(1);
  }
  return refusal_;
}

void XmlScanner::startMarkup(State state) {
  state_ = state;
  run_ = 0;
  name_.clear();
  tail_.clear();
}

void XmlScanner::remember(char character) {
  if (tail_.size() == 3) tail_.erase(0, 1);
  tail_ += character;
  if (++run_ > limits_.textBytes)
    refuse("xml-limit", fmt::format("a comment, instruction or declaration over {} bytes", limits_.textBytes),
           "make it shorter");
}

void XmlScanner::step(char character) {
  switch (state_) {
    case State::Text:
      markup_ = here();
      return startMarkup(State::Open);
    case State::Open:
      if (character == '!') return startMarkup(State::Bang);
      if (character == '?') return instruction_.clear(), startMarkup(State::Instruction);
      if (character == '/') return startMarkup(State::EndTag);
      tag_.where = markup_;
      tag_.attributes.clear();
      slash_ = false;
      return startMarkup(State::Name);
    case State::Name:
      if (isSpace(character) || character == '>' || character == '/') {
        state_ = State::InTag;
        return stepInTag(character);
      }
      if (++run_ > limits_.nameBytes)
        refuse("xml-limit", "the name of an element is too long", "is this an X3D file?");
      return;
    case State::InTag:
    case State::AttributeName:
    case State::AfterName:
      return stepInTag(character);
    case State::Value:  // the closing quote: what stands before it was passed over in bulk
      return startMarkup(State::InTag);
    case State::EndTag:
      if (character == '>')
        --depth_, startMarkup(State::Text);
      else
        remember(character);
      return;
    case State::Instruction:
      remember(character);
      if (instruction_.size() < 200) instruction_ += character;
      if (tailIs("?>")) checkEncoding(), startMarkup(State::Text);
      return;
    case State::Comment:
      remember(character);
      if (tailIs("-->")) startMarkup(State::Text);
      return;
    case State::CData:
      remember(character);
      if (tailIs("]]>")) startMarkup(State::Text);
      return;
    case State::Bang:
    case State::Doctype:
    case State::DoctypeQuote:
      return stepBang(character);
  }
}

void XmlScanner::stepInTag(char character) {
  if (state_ == State::AttributeName) {
    if (character == '=' || isSpace(character))
      state_ = State::AfterName;
    else if (character == '>')
      return finishTag();
    else
      tag_.attributes.back().name += character;
    if (tag_.attributes.back().name.size() > limits_.nameBytes)
      refuse("xml-limit", "the name of an attribute is too long", "is this an X3D file?");
    return;
  }
  if (character == '>') return finishTag();
  if (state_ == State::AfterName) {
    if (character == '"' || character == '\'') quote_ = character, startMarkup(State::Value);
    return;
  }
  slash_ = character == '/';
  if (slash_ || isSpace(character)) return;
  tag_.attributes.push_back({std::string(1, character), here()});
  state_ = State::AttributeName;
  if (static_cast<int>(tag_.attributes.size()) > limits_.attributes)
    refuse("xml-limit", fmt::format("an element has over {} attributes", limits_.attributes),
           "is this an X3D file?");
}

void XmlScanner::finishTag() {
  if (!slash_ && ++depth_ > limits_.depth)
    refuse("xml-limit", fmt::format("elements are nested over {} deep", limits_.depth),
           "flatten the scene: viewers cannot open this");
  tags_.push_back(std::move(tag_));
  tag_ = {};
  if (!spare_.empty()) tag_ = std::move(spare_.back()), spare_.pop_back();
  startMarkup(State::Text);
}

void XmlScanner::stepBang(char character) {
  remember(character);
  if (state_ == State::DoctypeQuote) {
    if (character == quote_) state_ = State::Doctype;
    return;
  }
  if (state_ == State::Bang) {
    name_ += character;
    if (name_ == "--") return startMarkup(State::Comment);
    if (name_ == "[CDATA[") return startMarkup(State::CData);
    if (name_ == "DOCTYPE") return startMarkup(State::Doctype);
    if (character == '>') startMarkup(State::Text);
    return;
  }
  if (character == '"' || character == '\'') quote_ = character, state_ = State::DoctypeQuote;
  if (character == '>') startMarkup(State::Text);
  if (character == '[')
    refuse("xml-entity", "the DOCTYPE has an internal subset, which can declare entities",
           "remove what stands between [ and ]: a scene needs no declarations");
}

void XmlScanner::checkEncoding() {
  if (!instruction_.starts_with("xml") || instruction_.starts_with("xml-")) return;
  const std::size_t start = instruction_.find("encoding");
  if (start == instruction_.npos) return;
  const std::size_t open = instruction_.find_first_of("\"'", start);
  if (open == instruction_.npos) return;
  const std::string encoding =
      instruction_.substr(open + 1, instruction_.find(instruction_[open], open + 1) - open - 1);
  // In these every byte below 128 means what it means in ASCII, so that markup is found without decoding.
  static constexpr std::array<std::string_view, 4> kKnown{"UTF-8", "US-ASCII", "ASCII", "ISO-8859-1"};
  for (const auto& known : kKnown)
    if (base::equalIgnoringCase(encoding, known)) return;
  refuse("xml-encoding", "the encoding " + excerpt(encoding) + " is not read", "save the scene as UTF-8");
}

void XmlScanner::refuse(std::string_view rule, std::string message, std::string hint) {
  if (!refusal_)
    refusal_ = Refusal{state_ == State::Value ? tag_.attributes.back().where : here(), rule,
                       std::move(message), std::move(hint)};
}

}  // namespace cloudgen::check
