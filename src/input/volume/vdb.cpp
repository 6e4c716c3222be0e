// SPDX-License-Identifier: Apache-2.0
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>

#include "base/error.hpp"
#include "input/trial.hpp"
#include "input/volume/coarse_volume.hpp"
#include "input/volume/volume_file.hpp"

namespace cloudgen::input {
namespace {

/// The library says on stdout what it thinks of files that are newer than it: they are refused before.
void checkHeader(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 12> header{};
  stream.read(header.data(), header.size());
  std::uint32_t version = 0;
  std::memcpy(&version, header.data() + 8, sizeof version);
  if (!stream || std::string_view(header.data(), 4) != " BDV")
    throw base::InputError(file, "is not OpenVDB", "write the cloud's density as a float grid");
  if (version > openvdb::OPENVDB_FILE_VERSION)
    throw base::InputError(file,
                           fmt::format("is of version {} of OpenVDB's format, over {}", version,
                                       static_cast<std::uint32_t>(openvdb::OPENVDB_FILE_VERSION)),
                           "write it with an older OpenVDB");
}

/// The grid of that name; else "density", else the first that holds floats.
openvdb::FloatGrid::Ptr gridFrom(const std::string& file, const std::string& wanted) {
  openvdb::io::File vdb(file);
  vdb.open(false);
  std::string name = wanted;
  if (name.empty() && vdb.hasGrid("density")) name = "density";
  for (auto it = vdb.beginName(); it != vdb.endName(); ++it) {
    if (!name.empty() && *it != name) continue;
    if (vdb.readGridMetadata(*it)->isType<openvdb::FloatGrid>())
      return openvdb::gridPtrCast<openvdb::FloatGrid>(vdb.readGrid(*it));
  }
  throw base::InputError(file,
                         wanted.empty() ? "has no grid of floats" : "has no grid of floats called " + wanted,
                         "write the cloud's density as a float grid");
}

base::Volume volumeFrom(const std::string& file, const std::string& wanted, bool zUp) {
  constexpr int kMostAcross = 1 << 16;
  const auto grid = gridFrom(file, wanted);
  if (grid->getGridClass() == openvdb::GRID_LEVEL_SET) openvdb::tools::sdfToFogVolume(*grid);
  const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
  if (box.empty())
    throw base::InputError(file, "has an empty grid", "write the cloud's density as a float grid");
  const openvdb::Coord extent = box.dim();
  const openvdb::Vec3d voxel = grid->voxelSize();
  glm::dvec3 size, finest;
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] > kMostAcross || extent[axis] <= 0 || !(voxel[axis] > 0) || !std::isfinite(voxel[axis]))
      throw base::InputError(file, "has a grid that is too wide to be a cloud", "crop it to the cloud");
    finest[axis] = voxel[axis];
    size[axis] = extent[axis] * voxel[axis];
  }
  const auto upright = [&](const glm::dvec3& p) { return zUp ? glm::dvec3(p.x, p.z, size.y - p.y) : p; };
  CoarseVolume volume(zUp ? glm::dvec3(size.x, size.z, size.y) : size,
                      zUp ? glm::dvec3(finest.x, finest.z, finest.y) : finest);
  for (auto it = grid->cbeginValueOn(); it; ++it) {
    const double density = *it;
    if (!(density > 0) || !std::isfinite(density)) continue;
    const openvdb::CoordBBox cells = it.getBoundingBox();
    glm::dvec3 lower, upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = (cells.min()[axis] - box.min()[axis]) * finest[axis];
      upper[axis] = (cells.max()[axis] - box.min()[axis] + 1) * finest[axis];
    }
    const glm::dvec3 a = upright(lower), b = upright(upper);
    volume.add({a.x, a.y, std::min(a.z, b.z)}, {b.x, b.y, std::max(a.z, b.z)}, density);
  }
  return std::move(volume).volume();
}

}  // namespace

base::Volume readVdb(const std::filesystem::path& file, const std::string& grid, bool zUp) {
  openvdb::initialize();
  const std::string name = file.string();
  checkHeader(name);
  tryInChild(name, "OpenVDB", [&] {
    try {
      volumeFrom(name, grid, zUp);
    } catch (const base::InputError&) {
    } catch (...) {
      std::raise(SIGABRT);  // what the library throws tells no more than that it is damaged
    }
  });
  return volumeFrom(name, grid, zUp);
}

}  // namespace cloudgen::input
