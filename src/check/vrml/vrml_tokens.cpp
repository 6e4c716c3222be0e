// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/vrml_tokens.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::check {
namespace {

constexpr std::size_t kHeaderBytes = 100;

bool isBlank(char c) { return c == ' ' || c == ',' || c == '\n' || c == '\t' || c == '\r'; }

/// Which bytes end a word.
constexpr std::array<bool, 256> kEndsWord = [] {
  std::array<bool, 256> ends{};
  for (const char c : {' ', ',', '\n', '\t', '\r', '{', '}', '[', ']', '"', '#'})
    ends[static_cast<unsigned char>(c)] = true;
  return ends;
}();

TokenKind kindOf(char c) {
  switch (c) {
    case '{':
      return TokenKind::Open;
    case '}':
      return TokenKind::Close;
    case '[':
      return TokenKind::OpenList;
    case ']':
      return TokenKind::CloseList;
    case '"':
      return TokenKind::String;
    default:
      return TokenKind::Word;
  }
}

}  // namespace

void VrmlTokens::refill() {
  before_ += chunk_.size();
  chunk_ = source_.next();
  at_ = 0;
}

std::string VrmlTokens::header() const {
  const std::string_view start = chunk_.substr(0, kHeaderBytes);
  return std::string(start.substr(0, start.find_first_of("\r\n")));
}

void VrmlTokens::skipBlanks() {
  bool inComment = false;
  for (; !chunk_.empty(); ++at_) {
    if (at_ == chunk_.size()) refill();
    if (chunk_.empty()) return;
    if (inComment) at_ = std::min(chunk_.find('\n', at_), chunk_.size() - 1);
    const char c = chunk_[at_];
    if (c == '\n') ++line_, lineStart_ = offset() + 1, inComment = false;
    if (inComment || isBlank(c)) continue;
    if (c != '#') return;
    inComment = true;
  }
}

void VrmlTokens::readString() {
  bool escaped = false;
  for (++at_;; ++at_) {
    if (at_ == chunk_.size()) refill();
    broken_ |= chunk_.empty();
    tooLong_ |= next_.text.size() >= kLongest;
    if (broken_ || tooLong_) return;
    const char c = chunk_[at_];
    next_.text += c;
    if (c == '\n') ++line_, lineStart_ = offset() + 1;
    if (c == '"' && !escaped) return void(++at_);
    escaped = c == '\\' && !escaped;
  }
}

void VrmlTokens::readWord() {
  for (;;) {
    std::size_t end = at_;
    while (end < chunk_.size() && !kEndsWord[static_cast<unsigned char>(chunk_[end])]) ++end;
    next_.text.append(chunk_, at_, end - at_);
    at_ = end;
    tooLong_ |= next_.text.size() >= kLongest;
    if (end < chunk_.size() || tooLong_) return;
    refill();
    if (chunk_.empty()) return;
  }
}

void VrmlTokens::read() {
  skipBlanks();
  next_.kind = TokenKind::End;
  next_.text.clear();
  next_.where = {line_, offset() - lineStart_ + 1};
  if (chunk_.empty()) return;
  const char c = chunk_[at_];
  next_.kind = kindOf(c);
  if (next_.kind == TokenKind::Word) return readWord();
  next_.text += c;
  if (next_.kind == TokenKind::String)
    readString();
  else
    ++at_;
}

const Token& VrmlTokens::peek() {
  if (!peeked_) read();
  peeked_ = true;
  return next_;
}

Token VrmlTokens::take() {
  peek();
  peeked_ = false;
  return next_;
}

void VrmlTokens::takeInto(std::string& values) {
  peek();
  peeked_ = false;
  if (!values.empty()) values += ' ';
  values += next_.text;
}

}  // namespace cloudgen::check
