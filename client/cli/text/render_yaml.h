#pragma once

#include <string>

namespace contact::cli {

/// A JSON document as YAML, its fields in the same order. Readers of YAML 1.1 and 1.2 read the same
/// values as a reader of JSON: a text that looks like a value of another type is in quotes. Throws
/// nlohmann::json::exception if `json` is no JSON.
std::string YamlOfJson(const std::string& json);

}  // namespace contact::cli
