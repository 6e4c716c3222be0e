// SPDX-License-Identifier: Apache-2.0
#include "writer/page/page.hpp"

#include <fstream>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "writer/page/base64.hpp"
#include "writer/page/page_data.hpp"

namespace cloudgen::writer {
namespace fs = std::filesystem;

namespace {

constexpr const char* kPackFile = "scene.cgpack";
constexpr std::string_view kSceneSlot = "id=\"cloudgen-scene\">";
constexpr std::string_view kPackSlot = "id=\"cloudgen-pack\">";

std::string viewerTemplate() {
  const fs::path folder = base::viewerDir();
  if (folder.empty())
    throw base::NotBuiltError("--formats page", "the page was not built: npm was missing at build time",
                              "install npm and build again, or leave page out of --formats");
  return base::readFile(folder / "viewer.html");
}

/// Where the content of a slot goes: just behind its opening tag.
std::size_t slotIn(const std::string& page, std::string_view slot) {
  const std::size_t at = page.find(slot);
  if (at == std::string::npos)
    throw base::OutputError("viewer.html", "has no slot " + std::string(slot),
                            "build the page again from its sources");
  return at + slot.size();
}

/// The maps of verify that the page shows: those that are there.
std::vector<PageParts::Map> mapsIn(const fs::path& folder) {
  std::vector<PageParts::Map> maps;
  for (const auto& [name, file] :
       {std::pair{"cover", "verify/cover.png"}, std::pair{"optical depth", "verify/optical_depth.png"}})
    if (fs::exists(folder / file)) maps.push_back({name, file, base::readFile(folder / file, 16u << 20)});
  return maps;
}

/// Appends the file in base64, a megabyte or so at a time.
void appendBase64(std::ostream& out, const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string block(3u << 18, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    out << base64(std::string_view(block).substr(0, static_cast<std::size_t>(in.gcount())));
  if (in.bad() || !in.eof())
    throw base::OutputError(file.filename().string(), "cannot be read back for the page",
                            "check the disk and run again");
}

}  // namespace

void writePage(const scene::Scene& scene, const Destination& destination, std::uint64_t largestPackInPage) {
  const fs::path pack = destination.folder / kPackFile;
  std::error_code missing;
  const std::uint64_t bytes = fs::file_size(pack, missing);
  if (missing)
    throw base::OutputError("index.html", "the page shows the runtime pack, and it was not written",
                            "add pack to --formats, as in --formats pack,page");
  const std::string page = viewerTemplate();
  const std::size_t sceneAt = slotIn(page, kSceneSlot), packAt = slotIn(page, kPackSlot);
  if (packAt < sceneAt)
    throw base::OutputError("viewer.html", "its slots stand in the wrong order",
                            "build the page again from its sources");

  const bool inside = bytes <= largestPackInPage;
  PageParts parts{bytes, inside ? "" : kPackFile, destination.verification, {}};
  if (!parts.verification.empty()) parts.maps = mapsIn(destination.folder);
  destination.progress.step("page", 0);
  const fs::path target = destination.folder / "index.html";
  std::ofstream out(target, std::ios::binary | std::ios::trunc);
  out << std::string_view(page).substr(0, sceneAt) << pageData(scene, parts)
      << std::string_view(page).substr(sceneAt, packAt - sceneAt);
  if (inside) appendBase64(out, pack);
  out << std::string_view(page).substr(packAt);
  out.close();
  if (!out) {
    std::error_code ignored;
    fs::remove(target, ignored);
    throw base::OutputError(target.string(), "cannot be written",
                            "check the disk's free space and permissions");
  }
  destination.progress.step("page", 1);
}

void writePage(const scene::Scene& scene, const Destination& destination) {
  writePage(scene, destination, kLargestPackInPage);
}

}  // namespace cloudgen::writer
