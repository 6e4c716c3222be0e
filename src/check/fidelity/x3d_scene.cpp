// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "base/error.hpp"
#include "check/fidelity/card_scene.hpp"
#include "check/fidelity/x3d_film.hpp"
#include "check/rules/numbers.hpp"
#include "check/tiles3d/content_path.hpp"
#include "check/xsd/xml_parser.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

using Attributes = std::span<const XmlAttribute>;

constexpr int kMostDepth = 400;  ///< of the graph, USE followed
constexpr std::size_t kMostFiles = 10'000;
constexpr int kMostInlines = 8;  ///< one within another
constexpr std::uint32_t kNone = UINT32_MAX;
constexpr float kMostNarrow = 0.3f;  ///< of what a card may be the widened picture

std::string_view value(Attributes attributes, std::string_view name) {
  for (const XmlAttribute& attribute : attributes)
    if (attribute.name == name) return attribute.value;
  return {};
}

std::vector<float> floatsOf(std::string_view text) {
  std::vector<float> out;
  forEachNumber<double>(text, [&](double number) { out.push_back(static_cast<float>(number)); });
  return out;
}

glm::vec3 vectorOf(std::string_view text, const glm::vec3& otherwise) {
  const auto numbers = floatsOf(text);
  return numbers.size() == 3 ? glm::vec3(numbers[0], numbers[1], numbers[2]) : otherwise;
}

/// T C R S -C, as X3D says; scale goes along the axes.
glm::mat4 matrixOf(Attributes attributes) {
  const glm::vec3 shift = vectorOf(value(attributes, "translation"), glm::vec3(0)),
                  scale = vectorOf(value(attributes, "scale"), glm::vec3(1)),
                  center = vectorOf(value(attributes, "center"), glm::vec3(0));
  const auto turn = floatsOf(value(attributes, "rotation"));
  glm::mat3 linear(1);
  if (turn.size() == 4) {
    const glm::vec3 axis(turn[0], turn[1], turn[2]);
    if (glm::length(axis) > 0) linear = glm::mat3_cast(glm::angleAxis(turn[3], glm::normalize(axis)));
  }
  for (int i = 0; i < 3; ++i) linear[i] *= scale[i];
  glm::mat4 matrix(linear);
  matrix[3] = glm::vec4(shift + center - linear * center, 1);
  return matrix;
}

/// The strings of an MFString: "a" "b".
std::vector<std::string> stringsOf(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t open = text.find('"'); open != text.npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == text.npos) break;
    out.emplace_back(text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
  }
  return out;
}

/// textures/cumulus.png is drawn as cumulus.
std::optional<base::Genus> genusOfSprites(std::string_view url) {
  const auto urls = stringsOf(url);
  if (urls.empty()) return std::nullopt;
  return base::genusFromName(std::filesystem::path(urls.front()).stem().string());
}

/// The nodes of a scene and of the files that it inlines, each of which is read once.
class Library {
 public:
  /// As the scene is so many seconds of the forecast after its start.
  Library(double seconds, const base::Progress& progress) : seconds_(seconds), progress_(progress) {}

  /// Adds a document's nodes. `folder` is what its Inlines are named from; without one they stay empty.
  /// Returns the node of its Scene, or kNone.
  std::uint32_t read(ByteSource& source, const std::string& where, const fs::path* folder);
  /// The Scene of a file that is named from a folder. Throws InputError unless it is a file in that folder.
  std::uint32_t inlined(const std::string& url, const std::string& where, const fs::path& folder);

  std::vector<CardNode> nodes;

 private:
  double seconds_;
  const base::Progress& progress_;
  std::map<std::string, std::uint32_t> files_;
  int depth_ = 0;
};

/// Takes the elements of one document.
class Reader {
 public:
  Reader(Library& library, std::string where, const fs::path* folder)
      : library_(library), nodes_(library.nodes), where_(std::move(where)), folder_(folder) {}

  void start(std::string_view name, Attributes attributes) {
    Element element{std::string(name), std::string(value(attributes, "DEF")), kNone};
    const std::string use(value(attributes, "USE"));
    film_.take(name, attributes);
    if (const auto kind = kindOf(name, attributes)) {
      element.node = use.empty() ? addNode(*kind, name, attributes) : find(use);
      if (!use.empty()) element.name.clear();
      if (name == "Scene" && scene_ == kNone) scene_ = element.node;
      if (name == "Inline" && use.empty()) inlineFile(element.node, value(attributes, "url"));
    } else if (name == "Appearance") {
      look_ = use.empty() ? std::nullopt : known(looks_, use);
    } else if (name == "ImageTexture") {
      const auto genus = use.empty() ? genusOfSprites(value(attributes, "url")) : known(textures_, use);
      if (!element.def.empty() && use.empty()) textures_[element.def] = genus;
      look_ = genus;
    } else if (name == "IndexedTriangleSet") {
      indices_.clear();
      forEachNumber<std::int64_t>(value(attributes, "index"),
                                  [&](std::int64_t index) { indices_.push_back(index); });
    } else if (name == "ColorRGBA") {
      colors_ = floatsOf(value(attributes, "color"));
    } else if (name == "Coordinate") {
      points_ = floatsOf(value(attributes, "point"));
    } else if (name == "MetadataFloat" && value(attributes, "name") == "optical_depth narrowing") {
      stated_ = floatsOf(value(attributes, "value"));
    } else if (name == "MetadataString" && value(attributes, "name") == "id genus rule") {
      record(stringsOf(value(attributes, "value")));
    }
    open_.push_back(std::move(element));
  }

  void end() {
    const Element element = std::move(open_.back());
    open_.pop_back();
    if (element.name == "Appearance") {
      if (!element.def.empty()) looks_[element.def] = look_;
      shapeLook_ = look_;
    }
    if (element.node == kNone) return;
    if (element.name == "Shape") closeShape(nodes_[element.node]);
    // A name is known once its node is closed: no node can hold itself.
    if (!element.name.empty() && !element.def.empty()) named_[element.def] = element.node;
    // What is watched is drawn elsewhere, by its name.
    if (!open_.empty() && open_.back().name == "LoadSensor") return;
    for (auto parent = open_.rbegin(); parent != open_.rend(); ++parent) {
      if (parent->node == kNone) continue;
      adopt(parent->node, element.node);
      return;
    }
  }

  std::uint32_t scene() const { return scene_; }
  void pose(double seconds) { film_.pose(seconds, named_, nodes_); }

 private:
  struct Element {
    std::string name, def;
    std::uint32_t node;
  };

  static std::optional<CardNodeKind> kindOf(std::string_view name, Attributes attributes) {
    if (name == "Scene" || name == "Group" || name == "Inline") return CardNodeKind::Group;
    if (name == "Switch") return CardNodeKind::Choice;
    if (name == "Transform") return CardNodeKind::Transform;
    if (name == "LOD") return CardNodeKind::FirstLevel;
    if (name == "Shape") return CardNodeKind::Shape;
    if (name != "Billboard") return std::nullopt;
    // One with an axis turns about that alone: from above it stays as it is.
    const bool everyAxis = vectorOf(value(attributes, "axisOfRotation"), glm::vec3(0, 1, 0)) == glm::vec3(0);
    return everyAxis ? CardNodeKind::Billboard : CardNodeKind::Group;
  }

  std::uint32_t addNode(CardNodeKind kind, std::string_view name, Attributes attributes) {
    CardNode node;
    node.kind = kind;
    if (name == "Transform") node.matrix = matrixOf(attributes);
    if (name == "Switch") {
      node.choice = -1;
      forEachNumber<std::int64_t>(value(attributes, "whichChoice"),
                                  [&](std::int64_t choice) { node.choice = choice; });
    }
    node.isFile = name == "Inline";
    if (name == "Shape") {
      indices_.clear(), colors_.clear(), points_.clear(), stated_.clear();
      shapeLook_.reset();
    }
    nodes_.push_back(std::move(node));
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  void inlineFile(std::uint32_t node, std::string_view url) {
    const auto urls = stringsOf(url);
    if (!folder_ || urls.empty()) return;
    const std::uint32_t scene = library_.inlined(urls.front(), where_, *folder_);
    if (scene != kNone) adopt(node, scene);
  }

  std::uint32_t find(const std::string& use) const {
    const auto found = named_.find(use);
    return found == named_.end() ? kNone : found->second;
  }

  static std::optional<base::Genus> known(const std::map<std::string, std::optional<base::Genus>>& names,
                                          const std::string& name) {
    const auto found = names.find(name);
    return found == names.end() ? std::nullopt : found->second;
  }

  void record(const std::vector<std::string>& values) {
    for (auto element = open_.rbegin(); element != open_.rend(); ++element) {
      if (element->name != "Transform") continue;
      CardNode& node = nodes_[element->node];
      node.isCloud = true;
      if (values.size() > 1) node.recorded = base::genusFromName(values[1]);
      return;
    }
  }

  void adopt(std::uint32_t index, std::uint32_t child) {
    CardNode& parent = nodes_[index];
    // What is near enough to choose by itself has the file at hand.
    if (parent.kind == CardNodeKind::Choice && nodes_[child].isFile)
      parent.choice = static_cast<std::int64_t>(parent.children.size());
    if (parent.kind == CardNodeKind::Group && nodes_[child].isFile) parent.isFile = true;
    parent.children.push_back(child);
    parent.depth = std::max(parent.depth, nodes_[child].depth + 1);
    if (parent.depth > kMostDepth)
      throw base::InputError(where_, "nests its nodes too deeply", "is it a scene of cloudgen?");
  }

  /// Makes cards of the triangles of a Shape with sprites.
  void closeShape(CardNode& shape) {
    shape.drawn = shapeLook_;
    if (!shape.drawn || indices_.empty()) return;
    const auto fail = [&] {
      throw base::InputError(where_, "has a cloud whose triangles are no cards of four corners",
                             "name a scene.x3d that cloudgen wrote, or its folder");
    };
    const std::size_t cards = points_.size() / 12;
    if (points_.size() % 12 != 0 || colors_.size() != 16 * cards || indices_.size() % 3 != 0) fail();
    shape.cards.resize(cards);
    for (std::size_t i = 0; i < cards; ++i) {
      const auto corner = [&](std::size_t k) {
        const float* p = points_.data() + 12 * i + 3 * k;
        return glm::vec3(p[0], p[1], p[2]);
      };
      Card& card = shape.cards[i];
      card.center = 0.5f * (corner(0) + corner(2));
      card.right = 0.5f * (corner(1) - corner(0));
      card.up = 0.5f * (corner(3) - corner(0));
      const bool isStated = 2 * i + 1 < stated_.size();
      card.opticalDepth = opticalDepthOf(colors_[16 * i + 3], isStated ? stated_[2 * i] : 0);
      if (isStated && card.opticalDepth == stated_[2 * i])
        card.narrowing = std::clamp(stated_[2 * i + 1], kMostNarrow, 1.0f);
    }
    for (std::size_t t = 0; t < indices_.size(); t += 3) {
      const std::int64_t a = indices_[t], b = indices_[t + 1], c = indices_[t + 2];
      if (a < 0 || b < 0 || c < 0 || a / 4 != b / 4 || a / 4 != c / 4 ||
          static_cast<std::size_t>(a / 4) >= cards)
        fail();
      // Going round the corners once is the front, three quarters at a time the back.
      const auto turned = (b - a + 4) % 4 + (c - b + 4) % 4 + (a - c + 4) % 4;
      Card& card = shape.cards[static_cast<std::size_t>(a / 4)];
      (turned == 4 ? card.front : card.back) = true;
    }
  }

  Library& library_;
  std::vector<CardNode>& nodes_;
  std::string where_;
  const fs::path* folder_;
  std::uint32_t scene_ = kNone;
  std::vector<Element> open_;
  X3dFilm film_;
  std::map<std::string, std::uint32_t> named_;
  std::map<std::string, std::optional<base::Genus>> looks_, textures_;
  std::optional<base::Genus> look_, shapeLook_;
  std::vector<std::int64_t> indices_;
  std::vector<float> colors_, points_, stated_;
};

std::uint32_t Library::read(ByteSource& source, const std::string& where, const fs::path* folder) {
  Reader reader(*this, where, folder);
  ValidationResult result;
  FindingList findings(where, result);
  const XmlVisitor visitor{
      [&](std::string_view element, Position, Attributes attributes) { reader.start(element, attributes); },
      [&] { reader.end(); }};
  parseXml(source, visitor, findings, progress_);
  if (!result.findings.empty())
    throw base::InputError(where, result.findings.front().message, "see `cloudgen validate`");
  if (seconds_ != 0) reader.pose(seconds_);
  return reader.scene();
}

std::uint32_t Library::inlined(const std::string& url, const std::string& where, const fs::path& folder) {
  const std::string path = contentPath(url);
  if (path.empty())
    throw base::InputError(where, fmt::format("inlines {}, which is not in its folder", excerpt(url)),
                           "name a scene.x3d that cloudgen wrote, or its folder");
  const fs::path file = folder / path;
  const auto [known, isNew] = files_.try_emplace(file.lexically_normal().string(), kNone);
  if (!isNew) return known->second;
  if (files_.size() > kMostFiles || depth_ == kMostInlines)
    throw base::InputError(where, "inlines too many files, or too deeply", "is it a scene of cloudgen?");
  ByteSource source(file);
  const fs::path within = file.parent_path();
  ++depth_;
  known->second = read(source, file.string(), &within);
  --depth_;
  return known->second;
}

WrittenScene read(ByteSource& source, const std::string& where, const std::string& name,
                  const fs::path* folder, double seconds, const base::Progress& progress) {
  Library library(seconds, progress);
  library.read(source, where, folder);
  WrittenScene scene{name, "x3d", {}, {}, {}, 0};
  flatten(library.nodes, where, scene);
  constexpr float kMostOpaque = 0.9995f;  // written with three decimals at least
  boundSaturated(scene, kMostOpaque);
  return scene;
}

}  // namespace

WrittenScene readX3dScene(const fs::path& file, const base::Progress& progress, double seconds) {
  ByteSource source(file);
  const fs::path folder = file.parent_path();
  return read(source, file.string(), file.filename().string(), &folder, seconds, progress);
}

WrittenScene readX3dScene(std::string_view bytes, const std::string& where, double seconds) {
  ByteSource source(bytes);
  return read(source, where, where, nullptr, seconds, {});
}

}  // namespace cloudgen::check
