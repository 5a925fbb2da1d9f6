#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

#include "cli/input/diagnostic.h"
#include "wire/rules/violation.h"

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

/// What a broken rule says of a field that the author has `given` or not: the rules look at
/// messages, in which a required number that is 0 is one that is missing.
std::string WordsOf(const Violation& violation, bool given);

/// A mistake at a place of the document that is called `source`.
Diagnostic DiagnosticAt(std::string source, const YAML::Mark& mark, std::string field,
                        std::string what, std::string hint);

/// A broken rule, or advice, where its field stands in a document, or would stand.
Diagnostic DiagnosticIn(const YAML::Node& root, std::string source, const Violation& violation);

}  // namespace contact::cli
