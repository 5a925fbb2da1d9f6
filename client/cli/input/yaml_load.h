#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

namespace contact::cli {

/// The text of a YAML file; `-` is the standard input. Throws Failure (kLocal) if it cannot be read
/// or has more than 16 MiB.
std::string ReadYaml(const std::string& path);

/// What a text holds.
struct YamlText {
  /// The first document; null if there is none.
  YAML::Node first;
  /// Where a second one begins; nothing if there is none.
  std::optional<YAML::Mark> second = {};
};

/// Reads a text. Throws YAML::ParserException at the first mistake in two documents, or where they
/// have more than a million values, each counted as often as it is referred to.
YamlText LoadYaml(const std::string& text);

}  // namespace contact::cli
