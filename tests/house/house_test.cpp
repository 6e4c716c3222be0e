// SPDX-License-Identifier: Apache-2.0
// Who may use whom, who may print, and other rules that hold for all files; and that the checker sees what
// breaks them.
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "house/rules.hpp"

namespace {

using cloudgen::house::violationsIn;

const std::string kLicence = "// SPDX-License-Identifier: Apache-2.0\n";

/// The rules that `content` breaks as the file `file`, in the order of its lines.
std::vector<std::string> rulesBroken(std::string_view file, const std::string& content) {
  std::vector<std::string> rules;
  for (const auto& violation : violationsIn(file, content)) rules.push_back(violation.rule);
  return rules;
}

using Rules = std::vector<std::string>;

TEST(House, StandsByItsRules) {
  const std::filesystem::path root = CLOUDGEN_SOURCE_DIR;
  const auto files = cloudgen::house::sourceFiles(root);
  ASSERT_GT(files.size(), 200u) << "the walk over the repository found too little";
  std::string report;
  for (const std::string& file : files)
    for (const auto& violation : violationsIn(file, cloudgen::base::readFile(root / file)))
      report += cloudgen::house::text(violation) + "\n";
  EXPECT_EQ(report, "");
}

TEST(HouseChecker, SeesRoomsThatUseRoomsAboveThem) {
  EXPECT_EQ(rulesBroken("src/base/a.cpp", kLicence + "#include \"field/grid.hpp\"\n"), Rules{"room"});
  EXPECT_EQ(rulesBroken("src/field/a.cpp", kLicence + "#include \"cli/command.hpp\"\n"), Rules{"room"});
  EXPECT_EQ(rulesBroken("src/check/gltf/a.cpp", kLicence + "#include \"writer/gltf/glb_file.hpp\"\n"),
            Rules{"room"});
  EXPECT_EQ(rulesBroken("src/check/a.cpp", kLicence + "#include \"scene/scene.hpp\"\n"), Rules{"room"});
  EXPECT_EQ(rulesBroken("src/writer/x3d/a.cpp", kLicence + "  #  include \"pipeline/pipeline.hpp\"\n"),
            Rules{"room"});
  EXPECT_EQ(rulesBroken("src/attic/a.cpp", kLicence + "#include \"base/error.hpp\"\n"), Rules{"room"});
  EXPECT_EQ(
      rulesBroken("src/field/a.cpp", kLicence + "#include \"base/error.hpp\"\n#include \"field/grid.hpp\"\n"),
      Rules{});
  EXPECT_EQ(rulesBroken("src/field/a.cpp", kLicence + "#include \"grid.hpp\"\n"), Rules{"include"});
}

TEST(HouseChecker, SeesLibrariesOutsideOfTheirRoom) {
  EXPECT_EQ(rulesBroken("src/pipeline/a.cpp", kLicence + "#include <eccodes.h>\n"), Rules{"library"});
  EXPECT_EQ(rulesBroken("src/input/described/a.cpp", kLicence + "#include <eccodes.h>\n"), Rules{"library"});
  EXPECT_EQ(rulesBroken("src/writer/gltf/cards.cpp", kLicence + "#include <tiny_gltf.h>\n"),
            Rules{"library"});
  EXPECT_EQ(rulesBroken("src/writer/x3d/a.cpp", kLicence + "#include <libxml/tree.h>\n"), Rules{"library"});
  EXPECT_EQ(rulesBroken("src/light/a.cpp", kLicence + "#include <tbb/parallel_for.h>\n"), Rules{"library"});
  EXPECT_EQ(rulesBroken("src/field/grid.hpp", kLicence + "#include <nlohmann/json.hpp>\n"), Rules{"library"});
  EXPECT_EQ(rulesBroken("src/input/grib/a.cpp", kLicence + "#include <eccodes.h>\n"), Rules{});
}

TEST(HouseChecker, SeesPrintingChanceAndLeaving) {
  EXPECT_EQ(
      rulesBroken("src/light/a.cpp", kLicence + "std::printf(\"x\");\nstd::cerr << 1;\nfmt::print(\"x\");\n"),
      (Rules{"print", "print", "print"}));
  EXPECT_EQ(rulesBroken("src/cli/a.cpp", kLicence + "std::printf(\"x\");\n"), Rules{});
  EXPECT_EQ(rulesBroken("src/shape/a.cpp", kLicence + "int x = rand();\nstd::mt19937 y;\n"),
            (Rules{"chance", "chance"}));
  EXPECT_EQ(rulesBroken("src/shape/a.cpp",
                        kLicence + "std::snprintf(b, 4, \"x\");\nint operand(int);  // rand(), exit(1)\n"),
            Rules{});
  EXPECT_EQ(rulesBroken("src/shape/a.cpp", kLicence + "std::exit(1);\n"), Rules{"exit"});
}

TEST(HouseChecker, SeesLicenceLengthAndPaths) {
  EXPECT_EQ(rulesBroken("src/base/a.cpp", "int x;\n"), Rules{"licence"});
  EXPECT_EQ(rulesBroken("templates/viewer/src/a.ts", "const x = 1;\n"), Rules{"licence"});
  std::string longFile = kLicence;
  for (int i = 0; i < 600; ++i) longFile += "int x;\n";
  EXPECT_EQ(rulesBroken("tests/a.cpp", longFile), Rules{"length"});
  EXPECT_EQ(rulesBroken("README.md", std::string("see /ho") + "me/somebody/x\n"), Rules{"path"});
  EXPECT_EQ(rulesBroken("a.json", std::string("{\"file\": \"/wo") + "rk/x\"}\n"), Rules{"path"});
  EXPECT_EQ(rulesBroken("a.md", "https://example.org/home/page and ../home/x\n"), Rules{});
}

}  // namespace
