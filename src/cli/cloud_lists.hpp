// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "pipeline/layer_record.hpp"
#include "scene/scene.hpp"

namespace cloudgen::cli {

/// Writes clouds.csv (a line a cloud) and layers.csv (a line a model layer that has clouds) into a folder.
/// Numbers read back as the same ones; what is unknown is empty. Throws OutputError.
void writeCloudLists(const std::filesystem::path& folder, const scene::Scene& scene,
                     const std::vector<pipeline::LayerRecord>& layers);

/// A cloud of the clouds.csv of a folder, by its id. Reads line by line. Throws InputError: no such file, not
/// such a list, damaged, or no such cloud in it.
scene::CloudRecord findCloud(const std::filesystem::path& folder, std::uint64_t id);

/// The layer that a cloud was made from, of the layers.csv of the same folder. Throws InputError as
/// findCloud.
pipeline::LayerRecord findLayer(const std::filesystem::path& folder, const scene::CloudRecord& cloud);

}  // namespace cloudgen::cli
