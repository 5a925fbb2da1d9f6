#include "cli/input/yaml_place.h"

#include <cstddef>
#include <span>
#include <utility>

#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

YAML::Node Child(const YAML::Node& node, const std::string& name) {
  if (!node.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  for (const auto& entry : node) {
    if (entry.first.IsScalar() && entry.first.Scalar() == name) return entry.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

FoundNode Find(const YAML::Node& node, std::span<const PathStep> path) {
  if (path.empty()) return {node, true};
  const YAML::Node child = Child(node, path.front().name);
  if (!child.IsDefined()) return {node, false};
  if (!path.front().index) return Find(child, path.subspan(1));
  const auto index = static_cast<std::size_t>(*path.front().index);
  if (!child.IsSequence() || index >= child.size()) return {child, false};
  return Find(child[index], path.subspan(1));
}

}  // namespace

std::string JoinPath(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

FoundNode FindNode(const YAML::Node& root, const std::string& path) {
  return Find(root, ParsePath(path));
}

Diagnostic DiagnosticAt(std::string source, const YAML::Mark& mark, std::string field,
                        std::string what, std::string hint) {
  return {.source = std::move(source),
          .line = mark.line + 1,
          .column = mark.column + 1,
          .field = std::move(field),
          .what = std::move(what),
          .hint = std::move(hint)};
}

}  // namespace contact::cli
