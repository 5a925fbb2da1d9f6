#include "cli/input/variables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/scalar.h"
#include "cli/input/yaml_document.h"

namespace contact::cli {
namespace {

constexpr char kVariables[] = "variables";

bool IsName(std::string_view text) {
  const auto letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  return !text.empty() && letter(static_cast<unsigned char>(text.front())) &&
         std::ranges::all_of(text,
                             [&](unsigned char c) { return letter(c) || std::isdigit(c) != 0; });
}

// The name in a text that is `${name}` and nothing else; empty for any other text.
std::string WholeName(std::string_view text) {
  if (!text.starts_with("${") || text.find('}') != text.size() - 1) return "";
  return std::string(text.substr(2, text.size() - 3));
}

// Puts values into all scalars of a document, each once however many aliases it has, and notes
// where they went.
class Resolver {
 public:
  Resolver(const VariableValues& values, const YamlReader::Report& report)
      : values_(values), report_(report) {
    for (const auto& [name, value] : values) fields_[name];
  }

  // `path` is that of the node.
  void Resolve(const YAML::Node& node, const std::string& path) {
    if (node.IsMap()) {
      for (const auto& entry : node) {
        Resolve(entry.second, JoinPath(path, entry.first.IsScalar() ? entry.first.Scalar() : ""));
      }
    } else if (node.IsSequence()) {
      int index = 0;
      for (const auto& entry : node) Resolve(entry, fmt::format("{}[{}]", path, index++));
    } else if (node.IsScalar()) {
      ResolveScalar(node, path);
    }
  }

  // True if some scalar has the variable in it.
  bool Uses(const std::string& name) const { return used_.contains(name); }

  VariableFields Take() { return std::move(fields_); }

 private:
  void ResolveScalar(YAML::Node node, const std::string& path) {
    const auto seen = whole_.find(node.Mark().pos);
    if (seen != whole_.end()) return AddField(seen->second, path);
    if (node.Scalar().find("${") == std::string::npos) return;
    const std::string& name = whole_[node.Mark().pos] = WholeName(node.Scalar());
    AddField(name, path);
    const std::optional<std::string> text = Text(node);
    if (text) {
      node = *text;  // Keeps the node's place.
    } else {
      node = YAML::Node(YAML::NodeType::Null);  // One mistake is enough.
    }
  }

  void AddField(const std::string& name, const std::string& path) {
    if (const auto found = fields_.find(name); found != fields_.end()) {
      found->second.push_back(path);
    }
  }

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
                KnownVariables(name, fields_));
        return std::nullopt;
      }
      used_.insert(name);
      text += found->second;
      rest.remove_prefix(end + 1);
    }
    return text.append(rest);
  }

  const VariableValues& values_;
  const YamlReader::Report& report_;
  // By the place of a scalar that had variables: the one that was all of it, or empty.
  std::map<int, std::string> whole_;
  std::set<std::string> used_;
  VariableFields fields_;
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

void AdviseOnUnused(const YAML::Node& mapping, const Resolver& resolver,
                    const YamlReader::Report& advise) {
  for (const auto& entry : mapping) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (!IsName(name) || resolver.Uses(name)) continue;
    advise(entry.first.Mark(), fmt::format("{}.{}", kVariables, name), "is used nowhere",
           fmt::format("${{{}}} stands for its value", name));
  }
}

}  // namespace

VariableValues ParseVariables(const std::vector<std::string>& assignments) {
  return ParseAssignments(assignments, "--var", "VARIABLE=VALUE, such as restitution=0.7");
}

VariableFields ResolveVariables(const VariableValues& given, const YamlReader::Report& report,
                                const YamlReader::Report& advise, YAML::Node* document) {
  if (!document->IsMap() || !std::as_const(*document)[kVariables].IsDefined()) return {};
  const YAML::Node mapping = (*document)[kVariables];
  VariableValues values = Defaults(mapping, report);
  document->remove(kVariables);
  for (const auto& [name, value] : given) {
    const auto found = values.find(name);
    if (found != values.end()) found->second = value;
  }
  Resolver resolver(values, report);
  resolver.Resolve(*document, "");
  if (mapping.IsMap()) AdviseOnUnused(mapping, resolver, advise);
  return resolver.Take();
}

void RequireKnown(const VariableValues& given, const VariableFields& known) {
  for (const auto& [name, value] : given) {
    if (known.contains(name)) continue;
    throw Failure(ExitCode::kUsage, fmt::format("--var {}: unknown variable {} — {}", name,
                                                Quoted(name), KnownVariables(name, known)));
  }
}

std::string KnownVariables(const std::string& name, const VariableFields& known) {
  std::vector<std::string_view> names;
  for (const auto& [each, fields] : known) names.push_back(each);
  return DidYouMean(
      name, names,
      names.empty() ? "the file has none" : fmt::format("there are {}", fmt::join(names, ", ")));
}

}  // namespace contact::cli
