// SPDX-License-Identifier: Apache-2.0
#include "writer/catalogue.hpp"

#include <set>

#include "base/error.hpp"

namespace cloudgen::writer {
namespace {

std::vector<std::string> namesOf(const std::vector<const Format*>& chosen) {
  std::vector<std::string> names;
  for (const Format* format : chosen) names.emplace_back(format->name);
  return names;
}

TEST(Catalogue, DefaultIsEveryFormatButThoseOnRequest) {
  std::vector<std::string> all;
  for (const Format& format : formats())
    if (!format.onlyOnRequest) all.emplace_back(format.name);
  EXPECT_FALSE(all.empty());
  EXPECT_EQ(namesOf(chosenFormats("default")), all);
  EXPECT_EQ(namesOf(chosenFormats("")), all);
}

TEST(Catalogue, ChoiceIsWrittenInTheCataloguesOrderAndOnce) {
  EXPECT_EQ(namesOf(chosenFormats("glb, x3d,glb")), (std::vector<std::string>{"x3d", "glb"}));
}

TEST(Catalogue, NoTwoFormatsShareANameOrAFile) {
  std::set<std::string_view> names, files;
  for (const Format& format : formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.description.empty());
    EXPECT_NE(format.write, nullptr);
    EXPECT_FALSE(format.files.empty());
    for (const std::string_view file : format.files) EXPECT_TRUE(files.insert(file).second) << file;
  }
  for (const auto& [name, what] : formatsNotBuilt()) EXPECT_TRUE(names.insert(name).second) << name;
}

TEST(Catalogue, AnUnknownNameGetsTheNearestOne) {
  try {
    chosenFormats("x3d,splat");
    FAIL();
  } catch (const base::UsageError& error) {
    EXPECT_EQ(error.failure(), base::Failure::Usage);
    EXPECT_NE(error.where().find("splat"), std::string::npos);
    EXPECT_EQ(error.hint(), "did you mean splats?");
  }
  EXPECT_THROW(chosenFormats("x3d,"), base::UsageError);
  EXPECT_THROW(chosenFormats("collada"), base::UsageError);
}

TEST(Catalogue, WhatIsNotBuiltIsNamedAsSuch) {
  for (const auto& [name, what] : formatsNotBuilt()) {
    try {
      chosenFormats("x3d," + std::string(name));
      ADD_FAILURE() << name;
    } catch (const base::NotBuiltError& error) {
      EXPECT_EQ(error.failure(), base::Failure::NotBuilt);
      EXPECT_NE(error.problem().find(what), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cloudgen::writer
