// SPDX-License-Identifier: Apache-2.0
#include "shape/grammar.hpp"

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"

namespace cloudgen::shape {
namespace {

using nlohmann::json;

constexpr std::string_view kTurtle = "F+-&^\\/|[]><~";
constexpr int kDeepest = 32;
constexpr double kMostSymbols = 300'000;
constexpr std::size_t kMostBalls = 20'000, kLongest = 10'000;

bool isLetter(char symbol) { return (symbol >= 'A' && symbol <= 'Z') || (symbol >= 'a' && symbol <= 'z'); }

class Checked {
 public:
  explicit Checked(std::string where) : where_(std::move(where)) {}

  [[noreturn]] void refuse(const std::string& problem) const {
    throw base::InputError(where_, problem, "see schemas/lsystem.schema.json");
  }

  std::string word(std::string text, const std::string& name) const {
    std::erase(text, ' ');
    if (text.size() > kLongest) refuse(name + fmt::format(" has more than {} symbols", kLongest));
    int open = 0;
    for (const char symbol : text) {
      if (!isLetter(symbol) && kTurtle.find(symbol) == std::string_view::npos)
        refuse(fmt::format("{} has \"{}\", which the turtle does not know", name, symbol));
      open += symbol == '[' ? 1 : symbol == ']' ? -1 : 0;
      if (open < 0) break;
    }
    if (open != 0) refuse(name + " has brackets that do not match");
    return text;
  }

  char letter(const std::string& key) const {
    if (key.size() != 1 || !isLetter(key[0]) || key[0] == 'F')
      refuse("names \"" + key + "\", which is not one letter other than F");
    return key[0];
  }

  double within(double value, double low, double high, const std::string& name) const {
    if (!(value >= low && value <= high)) refuse(fmt::format("{} must be {:g} to {:g}", name, low, high));
    return value;
  }

 private:
  std::string where_;
};

/// The most symbols that a symbol becomes, itself counted.
double mostSymbols(const Grammar& grammar, char symbol, int depth,
                   std::map<std::pair<char, int>, double>& known) {
  const auto rules = grammar.productions.find(symbol);
  if (depth == 0 || rules == grammar.productions.end()) return 1;
  const auto [found, isNew] = known.try_emplace({symbol, depth}, 0);
  if (!isNew) return found->second;
  double most = 0;
  for (const Grammar::Production& production : rules->second) {
    double sum = 1;
    for (const char child : production.to) sum += mostSymbols(grammar, child, depth - 1, known);
    most = std::max(most, sum);
  }
  return known[{symbol, depth}] = most;
}

std::vector<Grammar::Production> productionsFrom(const json& rules, const Checked& checked, char symbol) {
  const std::string name = std::string("the production of ") + symbol;
  std::vector<Grammar::Production> productions;
  if (rules.is_string()) return {{1, checked.word(rules, name)}};
  for (const json& rule : rules)
    productions.push_back({checked.within(rule.value("weight", 1.0), 1e-6, 1e6, "weight"),
                           checked.word(rule.at("to").get<std::string>(), name)});
  if (productions.empty()) checked.refuse(name + " is empty");
  return productions;
}

/// Where the turtle stands, looking along its own y.
struct Turtle {
  glm::dvec3 place{0};
  glm::dquat heading{1, 0, 0, 0};
  double size = 1;
};

class Drawing {
 public:
  Drawing(const Grammar& grammar, std::uint64_t seed, std::uint64_t variant)
      : grammar_(grammar), seed_(seed), variant_(variant) {}

  void draw(const std::string& word, int depth, std::uint64_t address) {
    for (std::size_t i = 0; i < word.size(); ++i) {
      const std::uint64_t own = below(address, i);
      const auto rules = grammar_.productions.find(word[i]);
      if (depth > 0 && rules != grammar_.productions.end())
        draw(chosen(rules->second, own).to, depth - 1, own);
      else
        obey(word[i], own);
    }
  }
  std::vector<GrownBall> balls;

 private:
  static std::uint64_t below(std::uint64_t address, std::size_t child) {
    std::uint64_t mixed = (address ^ (child + 1)) * 0x9E3779B97F4A7C15ull;
    mixed = (mixed ^ (mixed >> 29)) * 0xBF58476D1CE4E5B9ull;
    return mixed ^ (mixed >> 32);
  }

  const Grammar::Production& chosen(const std::vector<Grammar::Production>& productions,
                                    std::uint64_t address) {
    double whole = 0;
    for (const Grammar::Production& production : productions) whole += production.weight;
    double draw = whole * base::RandomStream(seed_, variant_, base::Purpose::GrammarRule, address).uniform();
    for (const Grammar::Production& production : productions) {
      if (draw < production.weight) return production;
      draw -= production.weight;
    }
    return productions.back();
  }

  void turn(double degrees, const glm::dvec3& about) {
    now_.heading = glm::normalize(now_.heading * glm::angleAxis(degrees * std::numbers::pi / 180, about));
  }

  void obey(char symbol, std::uint64_t address) {
    const double angle = grammar_.angleDegrees;
    switch (symbol) {
      case 'F':
        now_.place += now_.heading * glm::dvec3(0, now_.size, 0);
        return;
      case '+':
        return turn(angle, {0, 0, 1});
      case '-':
        return turn(-angle, {0, 0, 1});
      case '&':
        return turn(angle, {1, 0, 0});
      case '^':
        return turn(-angle, {1, 0, 0});
      case '\\':
        return turn(angle, {0, 1, 0});
      case '/':
        return turn(-angle, {0, 1, 0});
      case '|':
        return turn(180, {0, 0, 1});
      case '[':
        return kept_.push_back(now_);
      case ']':
        now_ = kept_.back();
        return kept_.pop_back();
      case '>':
        now_.size = std::max(1e-6, now_.size * grammar_.shrink);
        return;
      case '<':
        now_.size = std::min(1e6, now_.size / grammar_.shrink);
        return;
      case '~': {
        base::RandomStream stream(seed_, variant_, base::Purpose::GrammarTurn, address);
        turn(stream.uniform(-angle, angle), {0, 0, 1});
        return turn(stream.uniform(-angle, angle), {1, 0, 0});
      }
      default:
        break;
    }
    const auto ground = grammar_.ground.find(symbol);
    if (ground != grammar_.ground.end() && balls.size() < kMostBalls)
      balls.push_back({now_.place, ground->second.radius * now_.size});
  }

  const Grammar& grammar_;
  std::uint64_t seed_, variant_;
  Turtle now_;
  std::vector<Turtle> kept_;
};

}  // namespace

Grammar grammarFromJson(const std::string& text, const std::string& where) {
  const Checked checked(where);
  try {
    const json file = json::parse(text);
    if (file.at("cloudgen_lsystem") != 1) checked.refuse("is not of version 1 of cloudgen's L-systems");
    Grammar grammar;
    grammar.axiom = checked.word(file.at("axiom"), "the axiom");
    grammar.depth = static_cast<int>(checked.within(file.at("depth"), 0, kDeepest, "depth"));
    grammar.angleDegrees = checked.within(file.at("angle_degrees"), 0, 180, "angle_degrees");
    grammar.shrink = checked.within(file.value("shrink", 0.8), 0.05, 1, "shrink");
    for (const auto& [key, rules] : file.at("productions").items()) {
      const char symbol = checked.letter(key);
      grammar.productions[symbol] = productionsFrom(rules, checked, symbol);
    }
    for (const auto& [key, ground] : file.at("ground").items())
      grammar.ground[checked.letter(key)] = {checked.within(ground.at("radius"), 1e-3, 1e3, "radius")};
    double symbols = 0;
    std::map<std::pair<char, int>, double> known;
    for (const char symbol : grammar.axiom) symbols += mostSymbols(grammar, symbol, grammar.depth, known);
    if (symbols > kMostSymbols)
      throw base::InputError(where, fmt::format("can make {:g} symbols, over {:g}", symbols, kMostSymbols),
                             "lower its depth");
    const std::vector<GrownBall> balls = grow(grammar, 1, 0);
    if (std::none_of(balls.begin(), balls.end(), [](const GrownBall& ball) { return ball.center.y >= 0; }))
      checked.refuse("draws nothing above its start: no ground symbol is left there at its depth");
    return grammar;
  } catch (const json::exception& error) {
    checked.refuse(std::string("is not an L-system (") + error.what() + ")");
  }
}

std::vector<GrownBall> grow(const Grammar& grammar, std::uint64_t seed, std::uint64_t variant) {
  Drawing drawing(grammar, seed, variant);
  drawing.draw(grammar.axiom, grammar.depth, 0);
  return std::move(drawing.balls);
}

}  // namespace cloudgen::shape
