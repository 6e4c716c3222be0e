// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/file.hpp"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/error.hpp"
#include "input/netcdf/classic_header.hpp"
#include "input/trial.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::size_t kMostValues = std::size_t{1} << 26;
constexpr std::size_t kMostChunkBytes = std::size_t{1} << 30;
constexpr std::size_t kCacheBytes = std::size_t{1} << 25;
constexpr std::size_t kMostAttributeLength = std::size_t{1} << 16;
constexpr int kMostGroupDepth = 16;

/// Roomier than NC_MAX_NAME says, since netCDF-C does not always heed it.
using NameBuffer = std::array<char, 16 * NC_MAX_NAME>;

std::mutex& libraryMutex() {
  static std::mutex mutex;
  return mutex;
}

Storage storageOf(nc_type type) {
  switch (type) {
    case NC_CHAR:
      return Storage::Text;
    case NC_BYTE:
      return Storage::Byte;
    case NC_UBYTE:
      return Storage::UnsignedByte;
    case NC_SHORT:
      return Storage::Short;
    case NC_INT:
      return Storage::Int;
    case NC_USHORT:
    case NC_UINT:
    case NC_INT64:
    case NC_UINT64:
      return Storage::WideInteger;
    case NC_FLOAT:
    case NC_DOUBLE:
      return Storage::Floating;
    default:
      return Storage::Other;
  }
}

std::string trimmed(std::string text) {
  const auto isBlank = [](char c) { return c == '\0' || c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && isBlank(text.back())) text.pop_back();
  const auto first = std::find_if_not(text.begin(), text.end(), isBlank);
  return {first, text.end()};
}

std::string textIn(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::string() : trimmed(found->second.text);
}

std::optional<double> numberIn(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  if (found == attributes.end() || found->second.numbers.empty()) return std::nullopt;
  return found->second.numbers.front();
}

std::string kindName(int format) {
  switch (format) {
    case NC_FORMAT_CLASSIC:
      return "classic";
    case NC_FORMAT_64BIT_OFFSET:
      return "64-bit offset";
    case NC_FORMAT_64BIT_DATA:
      return "64-bit data";
    default:
      return "netCDF-4";
  }
}

/// The value that netCDF-C writes where nobody wrote; bytes have none.
std::optional<double> defaultFill(Storage storage) {
  switch (storage) {
    case Storage::Short:
      return NC_FILL_SHORT;
    case Storage::Int:
      return NC_FILL_INT;
    case Storage::WideInteger:
      return static_cast<double>(NC_FILL_INT64);
    case Storage::Floating:
      return NC_FILL_DOUBLE;
    default:
      return std::nullopt;
  }
}

/// Tells which stored numbers are no values, and unpacks the others.
class Unpacking {
 public:
  explicit Unpacking(const Variable& variable) {
    if (const auto factor = variable.number("scale_factor")) factor_ = *factor;
    if (const auto offset = variable.number("add_offset")) offset_ = *offset;
    if (variable.text("_Unsigned") == "true") {
      if (variable.storage == Storage::Byte) modulus_ = 256;
      if (variable.storage == Storage::Short) modulus_ = 65536;
    }
    for (const char* name : {"_FillValue", "missing_value"})
      if (const auto found = variable.attributes.find(name); found != variable.attributes.end())
        for (const double number : found->second.numbers) missing_.push_back(asUnsigned(number));
    if (!variable.attributes.contains("_FillValue"))
      if (const auto fill = defaultFill(variable.storage)) missing_.push_back(*fill);
    const bool packed = variable.storage != Storage::Floating;
    const auto limit = [&](const char* name, std::size_t index, double& bound) {
      const auto found = variable.attributes.find(name);
      if (found == variable.attributes.end() || found->second.numbers.size() <= index) return;
      bound = found->second.numbers[index];
      if (!(packed && found->second.floating)) bound = asUnsigned(bound) * factor_ + offset_;
    };
    limit("valid_min", 0, least_);
    limit("valid_max", 0, most_);
    limit("valid_range", 0, least_);
    limit("valid_range", 1, most_);
    if (least_ > most_) std::swap(least_, most_);
    if (!(least_ <= most_)) least_ = -kInfinity, most_ = kInfinity;
  }

  double value(double stored) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double raw = asUnsigned(stored);
    for (const double missing : missing_)
      if (raw == missing || static_cast<float>(raw) == static_cast<float>(missing)) return kNone;
    const double value = raw * factor_ + offset_;
    // What is outside by rounding only stays.
    const double slack = 1e-6 * std::max(1e-30, std::abs(value));
    return value < least_ - slack || value > most_ + slack ? kNone : value;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double asUnsigned(double number) const { return number < 0 ? number + modulus_ : number; }

  double factor_ = 1, offset_ = 0, modulus_ = 0, least_ = -kInfinity, most_ = kInfinity;
  std::vector<double> missing_;
};

}  // namespace

std::string Variable::text(const std::string& attribute) const { return textIn(attributes, attribute); }

std::optional<double> Variable::number(const std::string& attribute) const {
  return numberIn(attributes, attribute);
}

void File::check(int status, const std::string& what) const {
  if (status == NC_NOERR) return;
  throw base::InputError(name_, fmt::format("{} ({})", what, nc_strerror(status)), "fetch the file again");
}

File::File(const std::filesystem::path& path) : path_(std::filesystem::absolute(path)), name_(path.string()) {
  const bool classic = checkClassicHeader(path_, name_);
  const std::lock_guard lock(libraryMutex());
  if (!classic)
    tryInChild(name_, "HDF5", [this] {
      open();
      touchValues();
    });
  open();
}

void File::open() {
  check(nc_open(path_.c_str(), NC_NOWRITE, &id_), "cannot be opened as netCDF");
  try {
    int format = 0;
    check(nc_inq_format(id_, &format), "is of an unknown kind");
    kind_ = kindName(format);
    readGroup(id_, 0);
  } catch (...) {
    nc_close(id_);
    throw;
  }
}

/// Reads the first and the last value of each variable, for what that may wake.
void File::touchValues() const {
  for (const Variable& variable : variables_) {
    std::vector<std::size_t> first(std::max<std::size_t>(variable.dimensions.size(), 1), 0), last = first;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
      last[i] = std::max<std::size_t>(dimensions_[variable.dimensions[i]].length, 1) - 1;
    double ignored = 0;
    if (!variable.isNumeric()) continue;
    nc_get_var1_double(variable.group, variable.id, first.data(), &ignored);
    nc_get_var1_double(variable.group, variable.id, last.data(), &ignored);
  }
}

File::~File() {
  const std::lock_guard lock(libraryMutex());
  nc_close(id_);
}

void File::readGroup(int group, int depth) {
  int count = 0;
  check(nc_inq_dimids(group, &count, nullptr, 0), "has damaged dimensions");
  std::vector<int> ids(static_cast<std::size_t>(std::max(count, 0)));
  check(nc_inq_dimids(group, &count, ids.data(), 0), "has damaged dimensions");
  for (const int id : ids) {
    NameBuffer name{};
    std::size_t length = 0;
    check(nc_inq_dim(group, id, name.data(), &length), "has a damaged dimension");
    if (dimensionOfId_.emplace(id, dimensions_.size()).second) dimensions_.push_back({name.data(), length});
  }
  int attributes = 0;
  check(nc_inq_natts(group, &attributes), "has damaged attributes");
  if (depth == 0) attributes_ = readAttributes(group, NC_GLOBAL, attributes);
  check(nc_inq_varids(group, &count, nullptr), "has damaged variables");
  ids.resize(static_cast<std::size_t>(std::max(count, 0)));
  check(nc_inq_varids(group, &count, ids.data()), "has damaged variables");
  for (const int id : ids) readVariable(group, id);
  if (depth >= kMostGroupDepth || nc_inq_grps(group, &count, nullptr) != NC_NOERR) return;
  ids.resize(static_cast<std::size_t>(std::max(count, 0)));
  check(nc_inq_grps(group, &count, ids.data()), "has damaged groups");
  for (const int id : ids) readGroup(id, depth + 1);
}

void File::readVariable(int group, int id) {
  NameBuffer name{};
  std::array<int, NC_MAX_VAR_DIMS> dimensions{};
  nc_type type = NC_NAT;
  int rank = 0, attributes = 0;
  check(nc_inq_varndims(group, id, &rank), "has a damaged variable");
  if (rank < 0 || rank > NC_MAX_VAR_DIMS) check(NC_EMAXDIMS, "has a damaged variable");
  check(nc_inq_var(group, id, name.data(), &type, &rank, dimensions.data(), &attributes),
        "has a damaged variable");
  Variable variable{group, id, name.data(), storageOf(type), {}, {}};
  for (int i = 0; i < rank; ++i) {
    const auto found = dimensionOfId_.find(dimensions[static_cast<std::size_t>(i)]);
    if (found == dimensionOfId_.end())
      check(NC_EBADDIM, fmt::format("has a damaged variable {}", variable.name));
    variable.dimensions.push_back(found->second);
  }
  variable.attributes = readAttributes(group, id, attributes);
  int layout = NC_CONTIGUOUS;
  std::array<std::size_t, NC_MAX_VAR_DIMS> chunk{};
  if (kind_ == "netCDF-4" && rank > 0 && nc_inq_var_chunking(group, id, &layout, chunk.data()) == NC_NOERR &&
      layout == NC_CHUNKED) {
    double bytes = 8;
    for (int i = 0; i < rank; ++i) bytes *= static_cast<double>(chunk[static_cast<std::size_t>(i)]);
    if (bytes > static_cast<double>(kMostChunkBytes)) variable.storage = Storage::Other;
    nc_set_var_chunk_cache(group, id, kCacheBytes, 1009, 0.75F);
  }
  variables_.push_back(std::move(variable));
}

/// Overlong ones and those of types that cloudgen does not use are left out.
Attributes File::readAttributes(int group, int variable, int count) const {
  Attributes attributes;
  for (int i = 0; i < count; ++i) {
    NameBuffer name{};
    nc_type type = NC_NAT;
    std::size_t length = 0;
    check(nc_inq_attname(group, variable, i, name.data()), "has a damaged attribute");
    check(nc_inq_att(group, variable, name.data(), &type, &length), "has a damaged attribute");
    if (length == 0 || length > kMostAttributeLength) continue;
    Attribute attribute;
    const Storage storage = storageOf(type);
    const auto checkRead = [&](int status) {
      check(status, fmt::format("has a damaged attribute {}", name.data()));
    };
    if (storage == Storage::Text) {
      attribute.text.resize(length);
      checkRead(nc_get_att_text(group, variable, name.data(), attribute.text.data()));
    } else if (type == NC_STRING) {
      std::vector<char*> texts(length, nullptr);
      checkRead(nc_get_att_string(group, variable, name.data(), texts.data()));
      if (texts.front()) attribute.text = std::string(texts.front()).substr(0, kMostAttributeLength);
      nc_free_string(length, texts.data());
    } else if (storage != Storage::Other) {
      attribute.floating = storage == Storage::Floating;
      attribute.numbers.resize(length);
      checkRead(nc_get_att_double(group, variable, name.data(), attribute.numbers.data()));
    } else {
      continue;
    }
    attributes.emplace(name.data(), std::move(attribute));
  }
  return attributes;
}

const Variable* File::find(std::string_view name) const {
  for (const Variable& variable : variables_)
    if (variable.name == name) return &variable;
  return nullptr;
}

std::string File::text(const std::string& globalAttribute) const {
  return textIn(attributes_, globalAttribute);
}

std::optional<double> File::number(const std::string& globalAttribute) const {
  return numberIn(attributes_, globalAttribute);
}

std::size_t File::size(const Variable& variable) const {
  std::size_t size = 1;
  for (const std::size_t dimension : variable.dimensions) {
    const std::size_t length = dimensions_[dimension].length;
    if (length > 0 && size > std::numeric_limits<std::size_t>::max() / length)
      throw base::InputError(where(variable), "has absurd dimensions", "fetch the file again");
    size *= length;
  }
  return size;
}

std::string File::where(const Variable& variable) const {
  return fmt::format("{}, variable {}", name_, variable.name);
}

std::vector<double> File::stored(const Variable& variable, std::span<const std::size_t> start,
                                 std::span<const std::size_t> count) const {
  std::size_t size = 1;
  for (const std::size_t length : count) {
    if (length == 0) return {};
    if (length > kMostValues / size)
      throw base::InputError(where(variable), "is too large to be read at once", "cut the file into parts");
    size *= length;
  }
  std::vector<double> numbers(size);
  const std::lock_guard lock(libraryMutex());
  // Netcdf-C wants a place to point to even where there are no dimensions.
  const std::size_t none = 0;
  const int status = nc_get_vara_double(variable.group, variable.id, start.empty() ? &none : start.data(),
                                        count.empty() ? &none : count.data(), numbers.data());
  if (status != NC_NOERR && status != NC_ERANGE)
    throw base::InputError(where(variable), fmt::format("cannot be read ({})", nc_strerror(status)),
                           "fetch the file again");
  return numbers;
}

std::vector<double> File::values(const Variable& variable, std::span<const std::size_t> start,
                                 std::span<const std::size_t> count) const {
  std::vector<double> numbers = stored(variable, start, count);
  const Unpacking unpacking(variable);
  for (double& number : numbers) number = unpacking.value(number);
  return numbers;
}

std::vector<double> File::values(const Variable& variable) const {
  std::vector<std::size_t> count;
  for (const std::size_t dimension : variable.dimensions) count.push_back(dimensions_[dimension].length);
  return values(variable, std::vector<std::size_t>(count.size(), 0), count);
}

std::vector<std::string> File::texts(const Variable& variable) const {
  if (variable.storage != Storage::Text || variable.dimensions.empty()) return {};
  const std::size_t length = dimensions_[variable.dimensions.back()].length, total = size(variable);
  if (length == 0 || total > kMostValues) return {};
  std::string all(total, '\0');
  const std::lock_guard lock(libraryMutex());
  check(nc_get_var_text(variable.group, variable.id, all.data()), "has damaged text");
  std::vector<std::string> rows;
  for (std::size_t place = 0; place < total; place += length) rows.push_back(all.substr(place, length));
  return rows;
}

}  // namespace cloudgen::input::netcdf
