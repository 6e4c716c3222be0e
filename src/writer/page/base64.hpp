// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cloudgen::writer {

/// The bytes in base64 with padding (RFC 4648, section 4). Texts of parts join to the text of the whole when
/// every part but the last is a multiple of three bytes long.
std::string base64(std::string_view bytes);

}  // namespace cloudgen::writer
