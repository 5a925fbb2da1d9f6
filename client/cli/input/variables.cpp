#include "cli/input/variables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/assignments.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

constexpr char kVariables[] = "variables";

bool IsName(std::string_view text) {
  const auto letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  return !text.empty() && letter(static_cast<unsigned char>(text.front())) &&
         std::ranges::all_of(text,
                             [&](unsigned char c) { return letter(c) || std::isdigit(c) != 0; });
}

std::vector<std::string_view> NamesOf(const VariableValues& values) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

// Hint for an unknown variable: the nearest name, or all names.
std::string Instead(const std::string& name, const VariableValues& known) {
  const std::vector<std::string_view> names = NamesOf(known);
  return DidYouMean(
      name, names,
      names.empty() ? "the file has none" : fmt::format("there are {}", fmt::join(names, ", ")));
}

// Puts values into all scalars of a document, each once however many aliases it has.
class Resolver {
 public:
  Resolver(const VariableValues& values, const YamlReader::Report& report)
      : values_(values), report_(report) {}

  void Resolve(YAML::Node node) {
    if (node.IsMap()) {
      for (const auto& entry : node) Resolve(entry.second);
    } else if (node.IsSequence()) {
      for (const auto& entry : node) Resolve(entry);
    } else if (node.IsScalar() && node.Scalar().find("${") != std::string::npos &&
               seen_.insert(node.Mark().pos).second) {
      const std::optional<std::string> text = Text(node);
      if (text) {
        node = *text;  // Keeps the node's place.
      } else {
        node = YAML::Node(YAML::NodeType::Null);  // One mistake is enough.
      }
    }
  }

 private:
  // The text with values in it. Nothing if it names an unknown variable, which is reported.
  std::optional<std::string> Text(const YAML::Node& node) {
    std::string_view rest = node.Scalar();
    std::string text;
    for (std::size_t at = rest.find("${"); at != std::string_view::npos; at = rest.find("${")) {
      text += rest.substr(0, at);
      rest.remove_prefix(at + 2);
      if (text.ends_with('$')) {
        text += '{';
        continue;
      }
      const std::size_t end = rest.find('}');
      const std::string name(rest.substr(0, end));
      if (end == std::string_view::npos) {
        report_(node.Mark(), "", fmt::format("no }} ends the variable {}", Quoted(name)), "");
        return std::nullopt;
      }
      const auto found = values_.find(name);
      if (found == values_.end()) {
        report_(node.Mark(), "", fmt::format("undefined variable {}", Quoted(name)),
                Instead(name, values_));
        return std::nullopt;
      }
      text += found->second;
      rest.remove_prefix(end + 1);
    }
    return text.append(rest);
  }

  const VariableValues& values_;
  const YamlReader::Report& report_;
  std::set<int> seen_;
};

// The values that stand in the mapping itself.
VariableValues Defaults(const YAML::Node& mapping, const YamlReader::Report& report) {
  VariableValues values;
  if (mapping.IsNull()) return values;
  if (!mapping.IsMap()) {
    report(mapping.Mark(), kVariables, "expected a mapping of names to values", "");
    return values;
  }
  for (const auto& entry : mapping) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string path = fmt::format("{}.{}", kVariables, name);
    if (!IsName(name)) {
      report(entry.first.Mark(), kVariables, fmt::format("{} is no name", Quoted(name)),
             "names are letters, digits and _");
    } else if (!entry.second.IsScalar()) {
      report(entry.second.Mark(), path, "expected a number, a word or a text", "");
    } else if (!values.emplace(name, entry.second.Scalar()).second) {
      report(entry.first.Mark(), path, "is given twice", "");
    }
  }
  return values;
}

}  // namespace

void AddVariableFlag(CLI::App& command, std::vector<std::string>* assignments) {
  command
      .add_option("--var", *assignments,
                  "Give a variable of the file another value, such as restitution=0.7; repeatable")
      ->type_name("VARIABLE=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

VariableValues ParseVariables(const std::vector<std::string>& assignments) {
  return ParseAssignments(assignments, "--var", "VARIABLE=VALUE, such as restitution=0.7");
}

VariableValues ResolveVariables(const VariableValues& given, const YamlReader::Report& report,
                                YAML::Node* document) {
  if (!document->IsMap() || !std::as_const(*document)[kVariables].IsDefined()) return {};
  VariableValues values = Defaults((*document)[kVariables], report);
  document->remove(kVariables);
  for (const auto& [name, value] : given) {
    const auto found = values.find(name);
    if (found != values.end()) found->second = value;
  }
  Resolver(values, report).Resolve(*document);
  return values;
}

void RequireKnown(const VariableValues& given, const VariableValues& known) {
  for (const auto& [name, value] : given) {
    if (known.contains(name)) continue;
    throw Failure(ExitCode::kUsage, fmt::format("--var {}: unknown variable {} — {}", name,
                                                Quoted(name), Instead(name, known)));
  }
}

}  // namespace contact::cli
