// SPDX-License-Identifier: Apache-2.0
// The rules of the house as data: who may use whom.
#pragma once

#include <array>
#include <set>
#include <string_view>

namespace cloudgen::house {

/// Source files under `folder` may include headers of `mayUse` (and their own). The longest folder that fits
/// counts.
struct Room {
  std::string_view folder;
  std::set<std::string_view> mayUse;
};

inline const std::array kRooms{
    Room{"src/base/", {}},
    Room{"src/field/", {"base"}},
    Room{"src/input/", {"base", "field"}},
    Room{"src/shape/", {"base"}},
    Room{"src/light/", {"base", "shape"}},
    Room{"src/image/", {"base", "shape", "light"}},
    Room{"src/motion/", {"base", "field", "shape"}},
    Room{"src/scene/", {"base", "shape", "light", "image"}},
    Room{"src/pipeline/", {"base", "field", "shape", "light", "image", "motion", "scene"}},
    // A writer sees the scene and what the scene is made of.
    Room{"src/writer/", {"base", "scene", "shape", "light", "image"}},
    // A second opinion: what reads the written bytes shares no code with what wrote them.
    Room{"src/check/", {"base", "field"}},
    // What an application embeds: the standard library and FlatBuffers.
    Room{"src/runtime/", {}},
    Room{"src/cli/",
         {"base", "field", "input", "shape", "light", "image", "scene", "pipeline", "writer", "check", "runtime"}},
    // A program of its own: what an application that embeds the runtime looks like.
    Room{"src/fly/", {"base", "image", "runtime"}},
};

/// Headers that begin with `header` are private to files that begin with one of `owners`.
struct Library {
  std::string_view header;
  std::set<std::string_view> owners;
};

inline const std::array kLibraries{
    Library{"eccodes", {"src/input/grib/"}},
    Library{"grib_api", {}},
    Library{"netcdf", {"src/input/netcdf/"}},
    Library{"udunits2", {"src/input/netcdf/"}},
    Library{"libxml/", {"src/check/xsd/"}},
    Library{"tiny_gltf", {"src/writer/gltf/glb_file.cpp", "src/input/mesh/gltf.cpp"}},
    Library{"CGAL/", {"src/shape/solid.cpp"}},
    Library{"openvdb/", {"src/input/volume/vdb.cpp"}},
    Library{"OpenImageIO/", {"src/image/"}},
    Library{"Imath/", {"src/image/"}},
    Library{"tbb/", {"src/base/"}},
    Library{"oneapi/", {"src/base/"}},
    Library{"proj", {"src/base/"}},
    Library{"Random123/", {"src/base/"}},
    Library{"libnova/", {"src/light/"}},
    Library{"valijson/", {"src/pipeline/"}},
    Library{"flatbuffers/", {"src/writer/pack/", "src/check/pack/", "src/runtime/"}},
    Library{"runtime_pack_generated", {"src/writer/pack/", "src/check/pack/", "src/runtime/"}},
    Library{"EGL/", {"src/runtime/gles/"}},
    Library{"GLES3/", {"src/runtime/gles/", "src/fly/"}},
    Library{"CLI/", {"src/cli/", "src/fly/"}},
    Library{"zlib.h", {"src/base/gzip.cpp"}},
    Library{"CL/", {}},
    Library{"Magick", {}},
};

/// Only readers and writers of a format speak JSON.
inline const std::set<std::string_view> kJsonOwners{"src/shape/recipe.cpp",
                                                    "src/shape/grammar.cpp",
                                                    "src/pipeline/recipes.cpp",
                                                    "src/image/sprite_",
                                                    "src/input/",
                                                    "src/writer/",
                                                    "src/check/gltf/",
                                                    "src/check/tiles3d/",
                                                    "src/check/report/",
                                                    "src/cli/",
                                                    "src/fly/"};

/// Ends a process that it has forked for itself; nothing else but src/cli/ ends one.
inline constexpr std::string_view kChildProcess = "src/input/trial.cpp";

inline constexpr int kMostLines = 600;

}  // namespace cloudgen::house
