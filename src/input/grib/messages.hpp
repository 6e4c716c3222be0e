// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cloudgen::input::grib {

struct Part {
  std::uint64_t offset = 0, length = 0;
};

/// Where a field lies: a whole GRIB1 message, or the sections of one field of a GRIB2 message (which may hold
/// several).
struct FieldLocation {
  std::filesystem::path file;
  int edition = 0;
  std::uint64_t message = 0, messageOffset = 0;  ///< counted from 1; bytes from the start of the file
  std::vector<Part> sections;                    ///< of the file, in order

  /// "file.grib2, message 12 at byte 345".
  std::string name() const;
};

/// True if these are the first bytes of a GRIB file.
bool startsLikeGrib(std::string_view firstBytes);

/// Finds every field of a file by the lengths that messages and sections state; reads no data. Throws
/// InputError when the file cannot be read, a message is cut short, or its sections do not add up.
std::vector<FieldLocation> locateFields(const std::filesystem::path& file);

/// The field as a message of its own. Throws InputError if the file has changed since.
std::string readField(const FieldLocation& location);

}  // namespace cloudgen::input::grib
