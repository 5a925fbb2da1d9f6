#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "cli/input/diagnostic.h"

namespace contact::cli {

/// Where a field stands in a document, or would stand.
struct FoundNode {
  /// The innermost node on the way to the field that the document has.
  YAML::Node node;
  /// True if `node` is the field itself.
  bool exact;
};

/// The path of a field `name` of the message at `path`, which is empty for the document.
std::string JoinPath(const std::string& path, const std::string& name);

/// Finds the field with a path such as `bodies[0].mass_kg` in a document.
FoundNode FindNode(const YAML::Node& root, const std::string& path);

/// A mistake at a place of the document that is called `source`.
Diagnostic DiagnosticAt(std::string source, const YAML::Mark& mark, std::string field,
                        std::string what, std::string hint);

}  // namespace contact::cli
