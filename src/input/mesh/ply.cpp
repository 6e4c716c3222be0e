// SPDX-License-Identifier: Apache-2.0
// Stanford PLY (Turk 1994): a text header that names elements and the types of their properties, then the
// elements as text or binary of either byte order.
#include <bit>
#include <cstring>

#include "input/mesh/mesh_builder.hpp"
#include "input/mesh/mesh_file.hpp"
#include "input/mesh/words.hpp"

namespace cloudgen::input::mesh {
namespace {

enum class Type { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };
enum class Encoding { Text, Little, Big };

struct Property {
  std::string name;
  Type type = Type::Float;
  std::optional<Type> counted;  ///< of a list: the type of its count
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

std::optional<Type> typeOf(std::string_view name) {
  static const std::map<std::string_view, Type> kTypes{
      {"char", Type::Int8},   {"int8", Type::Int8},     {"uchar", Type::UInt8},   {"uint8", Type::UInt8},
      {"short", Type::Int16}, {"int16", Type::Int16},   {"ushort", Type::UInt16}, {"uint16", Type::UInt16},
      {"int", Type::Int32},   {"int32", Type::Int32},   {"uint", Type::UInt32},   {"uint32", Type::UInt32},
      {"float", Type::Float}, {"float32", Type::Float}, {"double", Type::Double}, {"float64", Type::Double}};
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

struct Header {
  Encoding encoding = Encoding::Text;
  std::vector<Element> elements;
};

Header readHeader(Words& words, MeshBuilder& builder, const std::string& where) {
  Header header;
  if (!words.nextLine() || words.word() != "ply") builder.refuse("does not begin with ply");
  while (words.nextLine()) {
    builder.where = fmt::format("{}, line {}", where, words.line());
    const std::string_view kind = words.word();
    if (kind == "end_header") return header;
    if (kind == "format") {
      const std::string_view name = words.word();
      if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
        builder.refuse("has a format that PLY does not know");
      header.encoding = name == "ascii"                  ? Encoding::Text
                        : name == "binary_little_endian" ? Encoding::Little
                                                         : Encoding::Big;
    } else if (kind == "element") {
      const std::string name(words.word());
      const auto count = words.whole();
      if (!count || *count < 0) builder.refuse("has an element without a count");
      header.elements.push_back({name, *count, {}});
    } else if (kind == "property") {
      Property property;
      std::optional<Type> type = Type::Float;
      std::string_view word = words.word();
      if (word == "list") {
        property.counted = typeOf(words.word());
        if (!property.counted) builder.refuse("has a list of a type that PLY does not know");
        word = words.word();
      }
      type = typeOf(word);
      if (!type || header.elements.empty()) builder.refuse("has a property of a type that PLY does not know");
      property.type = *type;
      property.name = words.word();
      header.elements.back().properties.push_back(std::move(property));
    }
  }
  builder.refuse("ends within its header");
}

/// The values that follow the header, one by one.
class Values {
 public:
  Values(Encoding encoding, Words words, const MeshBuilder& builder)
      : encoding_(encoding), words_(words), bytes_(words.rest()), builder_(builder) {}

  /// To be called before each element.
  void beginElement() {
    if (encoding_ == Encoding::Text && !words_.nextFilledLine())
      builder_.refuse("ends before its last element");
  }

  double next(Type type) {
    if (encoding_ == Encoding::Text) {
      const auto value = words_.number();
      if (!value) builder_.refuse("has a value that is no number");
      return *value;
    }
    switch (type) {
      case Type::Int8:
        return binary<std::int8_t>();
      case Type::UInt8:
        return binary<std::uint8_t>();
      case Type::Int16:
        return binary<std::int16_t>();
      case Type::UInt16:
        return binary<std::uint16_t>();
      case Type::Int32:
        return binary<std::int32_t>();
      case Type::UInt32:
        return binary<std::uint32_t>();
      case Type::Float:
        return binary<float>();
      case Type::Double:
        break;
    }
    return binary<double>();
  }

 private:
  template <class T>
  double binary() {
    if (bytes_.size() < sizeof(T)) builder_.refuse("ends before its last element");
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    if ((encoding_ == Encoding::Little) != (std::endian::native == std::endian::little))
      std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  Encoding encoding_;
  Words words_;
  std::string_view bytes_;
  const MeshBuilder& builder_;
};

/// Takes one element. A list is as long as its count says, but no longer than the file.
void readElement(const Element& element, Values& values, MeshBuilder& builder) {
  glm::dvec3 point(0);
  std::vector<std::int64_t> corners;
  values.beginElement();
  for (const Property& property : element.properties) {
    if (property.counted) {
      const bool wanted = property.name == "vertex_indices" || property.name == "vertex_index";
      const double count = values.next(*property.counted);
      for (double k = 0; k < count; ++k) {
        const double value = values.next(property.type);
        if (wanted) corners.push_back(value >= 0 && value < 1e15 ? static_cast<std::int64_t>(value) : -1);
        if (corners.size() > kMostTriangles) builder.refuse("has a face of millions of corners");
      }
      continue;
    }
    const double value = values.next(property.type);
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
      point[property.name[0] - 'x'] = value;
  }
  if (element.name == "vertex") builder.addPoint(point);
  if (element.name == "face") builder.addPolygon(corners);
}

}  // namespace

base::Mesh readPly(std::string_view bytes, const std::string& where) {
  MeshBuilder builder(where);
  Words words(bytes);
  const Header header = readHeader(words, builder, where);
  Values values(header.encoding, words, builder);
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (long long i = 0; i < element.count; ++i) {
      builder.where = fmt::format("{}, {} {}", where, element.name, i);
      readElement(element, values, builder);
    }
  }
  builder.where = where;
  return builder.finished();
}

}  // namespace cloudgen::input::mesh
