// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "base/error.hpp"
#include "cli/cloud_lists.hpp"
#include "cli/command.hpp"
#include "cli/explanation.hpp"

namespace cloudgen::cli {
namespace {

struct ExplainLine {
  std::string folder, id;
  bool json = false;
};

std::uint64_t idFromText(const std::string& text) {
  std::uint64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc{} || end != text.data() + text.size())
    throw base::UsageError(text.substr(0, 40), "is not the id of a cloud",
                           "ids are whole numbers: the first column of clouds.csv in the scene's folder");
  return id;
}

int explain(const ExplainLine& line) {
  const scene::CloudRecord cloud = findCloud(line.folder, idFromText(line.id));
  const pipeline::LayerRecord layer = findLayer(line.folder, cloud);
  print(line.json ? explanationJson(cloud, layer).dump(2) : explanationText(cloud, layer));
  return 0;
}

}  // namespace

std::function<int()> setupExplain(CLI::App& options, const Terminal&) {
  const auto line = std::make_shared<ExplainLine>();
  options.add_option("DIR", line->folder, "the folder of a scene")->required();
  options
      .add_option("CLOUD_ID", line->id, "a cloud of it, by the id that clouds.csv and the scene files give")
      ->required();
  options.add_flag("--json", line->json, "for machines: schemas/explain.schema.json");
  return [line] { return explain(*line); };
}

}  // namespace cloudgen::cli
