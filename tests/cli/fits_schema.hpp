// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace cloudgen::test {

/// A failure of the running test for everything in a document that is not as a file of schemas/ says.
inline void expectFitsSchema(const nlohmann::json& document, const std::string& schemaFile) {
  std::ifstream stream(std::string(CLOUDGEN_SOURCE_DIR) + "/schemas/" + schemaFile);
  const auto text = nlohmann::json::parse(stream);
  valijson::Schema schema;
  valijson::SchemaParser parser;
  const valijson::adapters::NlohmannJsonAdapter schemaAdapter(text), documentAdapter(document);
  parser.populateSchema(schemaAdapter, schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  EXPECT_TRUE(validator.validate(schema, documentAdapter, &results)) << schemaFile;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) ADD_FAILURE() << error.description;
}

}  // namespace cloudgen::test
