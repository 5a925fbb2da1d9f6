#pragma once

#include <string>

namespace contact::cli {

/// A JSON document as YAML, its fields in the same order. A reader of YAML 1.1 or 1.2 finds in it
/// what a reader of JSON finds: texts that look like something else are in quotes.
std::string YamlOfJson(const std::string& json);

}  // namespace contact::cli
