// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::input::grib {

struct Part {
  std::uint64_t offset = 0, length = 0;
};

/// Where a field lies: the sections of a GRIB1 message, or of one field of a GRIB2 message (which may hold
/// several), by their numbers; those that are not there have no length.
struct FieldLocation {
  std::shared_ptr<const std::filesystem::path> file;
  int edition = 0;
  std::uint64_t message = 0, messageOffset = 0;  ///< counted from 1; bytes from the start of the file
  std::array<Part, 8> sections;

  /// "file.grib2, message 12 at byte 345".
  std::string name() const;
};

/// What a field says of itself: its sections without the data.
struct FieldHead {
  FieldLocation location;
  int discipline = 0;  ///< edition 2
  /// Fields of one message share those that are not repeated.
  std::shared_ptr<const std::string> identification;  ///< section 1; of edition 1 the product too
  std::shared_ptr<const std::string> grid;            ///< section 3 (edition 1: 2; empty where it has none)
  std::shared_ptr<const std::string> product;         ///< section 4 of edition 2
};

/// True if these are the first bytes of a GRIB file.
bool startsLikeGrib(std::string_view firstBytes);

/// Finds every field of a file by the lengths that messages and sections state; reads no data. Throws
/// InputError when the file cannot be read, a message is cut short, or its sections do not add up.
std::vector<FieldHead> locateFields(const std::filesystem::path& file);

/// The whole sections of a field. Throws InputError if the file has changed since.
std::array<std::string, 8> readSections(const FieldLocation& location);

}  // namespace cloudgen::input::grib
