#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace contact::cli {

/// The text of a YAML file; `-` is the standard input. Throws Failure (kLocal) if it cannot be read
/// or has more than 16 MiB.
std::string ReadYaml(const std::string& path);

/// The documents of a text. Throws YAML::ParserException at the first mistake, or where it has more
/// than a million values, each counted as often as it is referred to.
std::vector<YAML::Node> LoadYaml(const std::string& text);

/// The first of them; null if there is none.
YAML::Node LoadFirstYaml(const std::string& text);

}  // namespace contact::cli
