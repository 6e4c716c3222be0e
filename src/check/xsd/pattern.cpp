// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/pattern.hpp"

#include <algorithm>
#include <bitset>
#include <charconv>
#include <map>

namespace cloudgen::check {
namespace {

using Bytes = std::bitset<128>;

constexpr std::size_t kPartLimit = 20000, kStateLimit = 8000;
constexpr int kDepthLimit = 100;

/// Thrown and caught in this file.
struct Unknown {};

Bytes single(char c) { return Bytes().set(static_cast<std::size_t>(static_cast<unsigned char>(c))); }

Bytes range(char from, char to) {
  Bytes bytes;
  for (int c = from; c <= to; ++c) bytes.set(static_cast<std::size_t>(c));
  return bytes;
}

Bytes blanks() { return single(' ') | single('\t') | single('\n') | single('\r'); }

/// A piece of a nondeterministic automaton (Thompson 1968): where it starts and where it ends.
struct Piece {
  std::size_t start, end;
};

struct Part {
  Bytes bytes;  ///< what leads on to `to`; empty: nothing does
  std::size_t to = 0;
  std::vector<std::size_t> free;  ///< reached without a byte
};

/// Reads the expression and builds the automaton on the way.
class PatternReader {
 public:
  explicit PatternReader(std::string_view text) : text_(text) {}

  Piece read() {
    const Piece all = alternatives();
    if (at_ != text_.size()) throw Unknown{};
    return all;
  }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  std::size_t add() {
    if (parts_.size() >= kPartLimit) throw Unknown{};
    parts_.emplace_back();
    return parts_.size() - 1;
  }
  void join(std::size_t from, std::size_t to) { parts_[from].free.push_back(to); }
  bool more() const { return at_ < text_.size(); }
  bool takeIf(char c) { return more() && text_[at_] == c && ++at_; }
  char take() {
    if (!more() || static_cast<unsigned char>(text_[at_]) >= 128) throw Unknown{};
    return text_[at_++];
  }

  Piece alternatives() {
    if (++depth_ > kDepthLimit) throw Unknown{};
    const Piece all{add(), add()};
    do {
      const Piece branch = sequence();
      join(all.start, branch.start), join(branch.end, all.end);
    } while (takeIf('|'));
    --depth_;
    return all;
  }

  Piece sequence() {
    const std::size_t start = add();
    Piece all{start, start};
    while (more() && text_[at_] != '|' && text_[at_] != ')') {
      const Piece next = quantified();
      join(all.end, next.start);
      all.end = next.end;
    }
    return all;
  }

  /// An atom as often as the quantifier behind it says. Each repetition reads the atom's text again.
  Piece quantified() {
    const std::size_t begin = at_;
    Piece once = atom();
    std::size_t least = 1, most = 1;
    bool endless = false;
    if (takeIf('*'))
      least = 0, endless = true;
    else if (takeIf('+'))
      endless = true;
    else if (takeIf('?'))
      least = 0;
    else if (takeIf('{'))
      counts(least, most, endless);
    const std::size_t after = at_;
    const std::size_t start = add();
    Piece all{start, start};
    if (least == 0 && (endless || most > 0)) {
      const std::size_t end = add();
      join(start, once.start), join(start, end), join(once.end, end);
      all.end = end;
      if (endless) join(once.end, once.start);
    } else if (most > 0) {
      join(start, once.start);
      all.end = once.end;
    }
    for (std::size_t count = 1; count < std::max(least, endless ? least : most); ++count) {
      at_ = begin;
      once = atom();
      join(all.end, once.start);
      const std::size_t end = add();
      if (count >= least) join(all.end, end);
      join(once.end, end);
      all.end = end;
    }
    if (endless && least > 0) join(once.end, once.start);
    at_ = after;
    return all;
  }

  std::size_t number() {
    std::size_t value = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || value > 1000) throw Unknown{};
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  void counts(std::size_t& least, std::size_t& most, bool& endless) {
    least = most = number();
    if (takeIf(',')) {
      endless = more() && text_[at_] == '}';
      if (!endless) most = number();
    }
    if (!takeIf('}') || most < least) throw Unknown{};
  }

  Piece atom() {
    if (takeIf('(')) {
      const Piece inner = alternatives();
      if (!takeIf(')')) throw Unknown{};
      return inner;
    }
    const Piece one{add(), add()};
    parts_[one.start].bytes = oneByte();
    parts_[one.start].to = one.end;
    return one;
  }

  Bytes oneByte() {
    const char c = take();
    if (c == '\\') return escaped();
    if (c == '[') return bracketed();
    if (c == '.') return ~(single('\n') | single('\r'));
    if (std::string_view("*+?{})]").find(c) != std::string_view::npos) throw Unknown{};
    return single(c);
  }

  Bytes escaped() {
    const char c = take();
    if (c == 's') return blanks();
    if (c == 'S') return ~blanks();
    if (c == 'd') return range('0', '9');
    if (c == 'n') return single('\n');
    if (c == 'r') return single('\r');
    if (c == 't') return single('\t');
    if (std::string_view("\\|.-^?*+{}()[]").find(c) == std::string_view::npos) throw Unknown{};
    return single(c);
  }

  Bytes bracketed() {
    const bool negated = takeIf('^');
    Bytes bytes;
    for (bool first = true; first || !takeIf(']'); first = false) {
      const char c = take();
      if (c == '[' || (c == ']' && first)) throw Unknown{};
      if (c == '\\') {
        bytes |= escaped();
        if (more() && text_[at_] == '-' && at_ + 1 < text_.size() && text_[at_ + 1] != ']') throw Unknown{};
      } else if (c != '-' && more() && text_[at_] == '-' && at_ + 1 < text_.size() && text_[at_ + 1] != ']') {
        ++at_;
        const char to = take();
        if (to == '\\' || to == '[' || to < c) throw Unknown{};
        bytes |= range(c, to);
      } else {
        bytes |= single(c);
      }
    }
    return negated ? ~bytes : bytes;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<Part> parts_;
};

}  // namespace

/// Subset construction over the parts; blanks are collapsed by the automaton itself: each of its states is a
/// set of parts and whether blanks were seen since.
class PatternCompiler {
 public:
  explicit PatternCompiler(std::string_view expression) : reader_(expression) {
    const Piece whole = reader_.read();
    end_ = whole.end;
    makeClasses();
    pattern_.next_.assign(pattern_.classes_, 0);
    pattern_.accepting_ = {false};
    texts_ = {""};
    sets_.push_back({});
    // Blanks at the front are dropped: the start stays the start.
    stateOf({closed({whole.start}), false}, "");
    index_.clear();  // and is not come back to: later blanks count
    for (std::size_t state = 1; state < sets_.size(); ++state) expand(state);
    if (!found_) throw Unknown{};
    for (std::uint32_t& next : pattern_.next_) next *= static_cast<std::uint32_t>(pattern_.classes_);
  }

  Pattern take() { return std::move(pattern_); }

 private:
  using Set = std::vector<std::size_t>;
  struct State {
    Set parts;
    bool blank = false;
    auto operator<=>(const State&) const = default;
  };

  void makeClasses() {
    const std::vector<Part>& parts = reader_.parts();
    std::map<std::vector<bool>, std::uint8_t> known;
    pattern_.classOf_.fill(0);  // class 0: what ASCII text never has, and leads nowhere
    representative_.assign(1, '\0');
    pattern_.classes_ = 1;
    std::vector<Bytes> distinct;
    for (const Part& part : parts)
      if (part.bytes.any() && std::find(distinct.begin(), distinct.end(), part.bytes) == distinct.end())
        distinct.push_back(part.bytes);
    for (std::size_t c = 1; c < 128; ++c) {
      std::vector<bool> in{blanks()[c], c == ' '};
      if (in[0]) in[1] = true;  // all blanks become a space
      for (const Bytes& bytes : distinct) in.push_back(bytes[in[0] ? std::size_t{' '} : c]);
      const auto [found, isNew] = known.try_emplace(in, static_cast<std::uint8_t>(pattern_.classes_));
      if (isNew) {
        ++pattern_.classes_;
        representative_.push_back(in[0] ? ' ' : static_cast<char>(c));
      }
      pattern_.classOf_[c] = found->second;
    }
  }

  Set closed(Set parts) const {
    std::vector<bool> seen(reader_.parts().size());
    Set all;
    while (!parts.empty()) {
      const std::size_t part = parts.back();
      parts.pop_back();
      if (seen[part]) continue;
      seen[part] = true;
      all.push_back(part);
      for (const std::size_t next : reader_.parts()[part].free) parts.push_back(next);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  Set after(const Set& parts, char byte) const {
    Set next;
    for (const std::size_t part : parts)
      if (reader_.parts()[part].bytes[static_cast<std::size_t>(byte)])
        next.push_back(reader_.parts()[part].to);
    return closed(std::move(next));
  }

  std::uint32_t stateOf(State state, const std::string& text) {
    if (state.parts.empty()) return 0;
    const auto found = index_.find(state);
    if (found != index_.end()) return found->second;
    if (sets_.size() >= kStateLimit) throw Unknown{};
    const auto number = static_cast<std::uint32_t>(sets_.size());
    const bool accepts = std::binary_search(state.parts.begin(), state.parts.end(), end_);
    if (accepts && !found_) found_ = true, pattern_.shortest_ = text;  // states are found in order of length
    pattern_.accepting_.push_back(accepts);
    pattern_.next_.resize(pattern_.next_.size() + pattern_.classes_, 0);
    texts_.push_back(text);
    index_.emplace(state, number);
    sets_.push_back(std::move(state));
    return number;
  }

  void expand(std::size_t number) {
    const State state = sets_[number];
    const std::string text = texts_[number];
    for (std::size_t kind = 1; kind < pattern_.classes_; ++kind) {
      const char byte = representative_[kind];
      std::uint32_t next = 0;
      if (byte == ' ')  // counts when something follows
        next = number == 1 || state.blank ? static_cast<std::uint32_t>(number)
                                          : stateOf({state.parts, true}, text + ' ');
      else
        next =
            stateOf({after(state.blank ? after(state.parts, ' ') : state.parts, byte), false}, text + byte);
      pattern_.next_[number * pattern_.classes_ + kind] = next;
    }
  }

  PatternReader reader_;
  std::size_t end_ = 0;
  Pattern pattern_;
  std::string representative_;
  std::vector<State> sets_;
  std::vector<std::string> texts_;
  std::map<State, std::uint32_t> index_;
  bool found_ = false;
};

std::optional<Pattern> Pattern::compiled(std::string_view expression) {
  try {
    return PatternCompiler(expression).take();
  } catch (const Unknown&) {
    return {};
  }
}

bool Pattern::accepts(std::string_view value) const {
  std::size_t row = classes_;
  for (const char byte : value) row = next_[row + classOf_[static_cast<unsigned char>(byte)]];
  return accepting_[row / classes_];
}

}  // namespace cloudgen::check
