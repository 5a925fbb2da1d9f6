#include "cli/input/scenario_file.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/base/failure.h"
#include "cli/base/message.h"
#include "cli/base/scalar.h"
#include "cli/input/yaml_document.h"
#include "cli/input/yaml_reader.h"
#include "wire/rules/field_path.h"
#include "wire/scenario/entry_names.h"
#include "wire/scenario_advice.h"

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Walks down a path and reads the value at its end, once for every entry that `[*]` stands for.
class Assignment {
 public:
  Assignment(const YAML::Node& value, std::vector<std::string>* overridden)
      : value_(value), overridden_(overridden) {}

  void Assign(std::span<const PathStep> path, const std::string& walked, Message* message) {
    const PathStep& step = path.front();
    const std::string here = JoinPath(walked, step.name);
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(step.name);
    if (field == nullptr) {
      const auto& type = *message->GetDescriptor();
      return Add(here, "unknown field", FieldHint(type, step.name));
    }
    if (step.index || !step.key.empty()) {
      AssignEntries(path, here, *field, message);
    } else if (path.size() == 1) {
      overridden_->push_back(here);
      Reader().ReadField(value_, here, *field, message);
    } else if (field->is_repeated()) {
      Add(here, "is a list", fmt::format("{0}[0], or {0}[*] for every entry", step.name));
    } else if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      Add(here, fmt::format("has no field '{}'", path[1].name), "");
    } else {
      Assign(path.subspan(1), here, message->GetReflection()->MutableMessage(message, field));
    }
  }

  std::vector<Diagnostic> Take() { return std::move(mistakes_); }

 private:
  void AssignEntries(std::span<const PathStep> path, const std::string& here,
                     const FieldDescriptor& field, Message* message) {
    if (!field.is_repeated()) return Add(here, "is no list", "leave the index out");
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || path.size() == 1) {
      return Add(here, "cannot be set entry by entry", "set a field of it, or the whole list");
    }
    const std::optional<int> index = IndexOf(path.front(), here, field, *message);
    if (!index) return;
    const auto* reflection = message->GetReflection();
    const bool every = *index == PathStep::kEvery;
    const int end = every ? reflection->FieldSize(*message, &field) : *index + 1;
    for (int i = every ? 0 : *index; i < end; ++i) {
      Assign(path.subspan(1), fmt::format("{}[{}]", here, i),
             reflection->MutableRepeatedMessage(message, &field, i));
    }
  }

  // The index that a step means in the list at `here`, or kEvery; nothing if it means no entry.
  std::optional<int> IndexOf(const PathStep& step, const std::string& here,
                             const FieldDescriptor& list, const Message& message) {
    if (!step.key.empty()) {
      const NamedEntry named = FindNamed(message, list, step.key);
      if (named.index >= 0) return named.index;
      Add(here, named.problem, named.hint);
      return std::nullopt;
    }
    const int size = message.GetReflection()->FieldSize(message, &list);
    if (*step.index < size) return step.index;
    Add(fmt::format("{}[{}]", here, *step.index), fmt::format("there are only {}", size), "");
    return std::nullopt;
  }

  YamlReader Reader() {
    return YamlReader([this](const YAML::Mark&, const std::string& field, const std::string& what,
                             const std::string& hint) { Add(field, what, hint); });
  }

  void Add(std::string field, std::string what, std::string hint) {
    mistakes_.push_back({.source = {},
                         .field = std::move(field),
                         .what = std::move(what),
                         .hint = std::move(hint)});
  }

  YAML::Node value_;
  std::vector<std::string>* overridden_;
  std::vector<Diagnostic> mistakes_;
};

YAML::Node ParseValue(const std::string& text, const std::string& assignment) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw Failure(ExitCode::kUsage, fmt::format("--set {}: {}", assignment, error.msg));
  }
}

// Sets the fields that an assignment names and adds their paths, with indices, to `overridden`.
// Returns the mistakes. Throws Failure (kUsage) if this is no assignment.
std::vector<Diagnostic> Override(const std::string& assignment, v1::Scenario* scenario,
                                 std::vector<std::string>* overridden) {
  const std::size_t equals = assignment.find('=');
  const std::vector<PathStep> path = ParsePath(assignment.substr(0, equals), true);
  if (equals == std::string::npos || path.empty()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--set {}: expected FIELD=VALUE, such as contacts[0].restitution=0.7",
                              assignment));
  }
  Assignment walk(ParseValue(assignment.substr(equals + 1), assignment), overridden);
  walk.Assign(path, "", scenario);
  return walk.Take();
}

constexpr std::string_view kOverride = "--set";

// True if `path` is `whole` or lies within it.
bool Within(std::string_view path, std::string_view whole) {
  if (!path.starts_with(whole)) return false;
  return path.size() == whole.size() || path[whole.size()] == '.' || path[whole.size()] == '[';
}

}  // namespace

ScenarioFile ScenarioFile::Open(const std::string& path, const VariableValues& variables) {
  return {path == "-" ? "<stdin>" : path, ReadYaml(path), variables,
          std::filesystem::path(path).parent_path().string()};
}

ScenarioFile::ScenarioFile(std::string name, const std::string& text,
                           const VariableValues& variables, std::string folder)
    : name_(std::move(name)), tables_(std::move(folder)) {
  try {
    ReadDocument(text, variables);
  } catch (const YAML::Exception& error) {
    AddAt(error.mark, "", "malformed YAML: " + error.msg, "");
  }
}

void ScenarioFile::ReadDocument(const std::string& text, const VariableValues& variables) {
  const YamlText yaml = LoadYaml(text);
  if (!yaml.first.IsDefined() || yaml.first.IsNull()) {
    return AddAt(YAML::Mark::null_mark(), "", "is empty", "contactctl init writes an example");
  }
  root_.reset(yaml.first);
  if (yaml.second) AddAt(*yaml.second, "", "holds a second document", "a file is one scenario");
  const YamlReader::Report report = std::bind_front(&ScenarioFile::AddAt, this);
  const auto advise = [this](const YAML::Mark& mark, const std::string& field,
                             const std::string& what, const std::string& hint) {
    advice_.push_back(DiagnosticAt(name_, mark, field, what, hint));
  };
  variables_ = ResolveVariables(variables, report, advise, &root_);
  RequireKnown(variables, variables_);
  YamlReader(report, std::bind_front(&FileTables::Read, &tables_, report))
      .ReadMessage(root_, "", &scenario_);
  std::ranges::copy(tables_.mistakes(), std::back_inserter(diagnostics_));
  std::ranges::copy(tables_.advice(), std::back_inserter(advice_));
}

void ScenarioFile::Set(const std::string& assignment) {
  for (Diagnostic& mistake : Override(assignment, &scenario_, &overridden_)) {
    mistake.source = kOverride;
    if (variables_.contains(mistake.field)) {
      mistake.hint = fmt::format("--var {} gives the variable of this name its value", assignment);
    }
    diagnostics_.push_back(std::move(mistake));
  }
}

void ScenarioFile::Check(const ScenarioLimits& limits) {
  const std::vector<Diagnostic> mistakes = diagnostics_;
  const DecodedScenario decoded = DecodeScenario(scenario_, limits);
  for (const Violation& violation : decoded.violations) {
    if (!MayFollowFrom(mistakes, violation)) Add(violation);
  }
  if (!decoded.violations.empty()) return;
  for (const Violation& advice : Advise(scenario_, decoded.scenario)) {
    advice_.push_back(Place(advice));
  }
}

void ScenarioFile::Add(const Violation& violation) { diagnostics_.push_back(Place(violation)); }

Diagnostic ScenarioFile::Place(const Violation& violation) const {
  const std::string& field = violation.field;
  for (const std::string& path : overridden_) {
    if (!Within(field, path)) continue;
    return {.source = std::string(kOverride),
            .field = field,
            .what = WordsOf(violation, field == path),
            .hint = violation.hint};
  }
  if (std::optional<Diagnostic> placed = tables_.Place(violation)) return *placed;
  return DiagnosticIn(root_, name_, violation);
}

// A number out of its range is so whatever else is wrong, unless in the same message.
bool ScenarioFile::MayFollowFrom(const std::vector<Diagnostic>& mistakes,
                                 const Violation& violation) const {
  if (mistakes.empty()) return false;
  const auto beside = [&violation](const Diagnostic& mistake) {
    const std::string_view message = ParentPath(mistake.field);
    return mistake.field.empty() || Within(violation.field, mistake.field) ||
           (!message.empty() && Within(violation.field, message));
  };
  if (std::ranges::any_of(mistakes, beside)) return true;
  const FoundNode found = FindNode(root_, violation.field);
  return !found.exact || !found.node.IsScalar() || !ParseNumber(found.node.Scalar());
}

void ScenarioFile::AddAt(const YAML::Mark& mark, std::string field, std::string what,
                         std::string hint) {
  diagnostics_.push_back(
      DiagnosticAt(name_, mark, std::move(field), std::move(what), std::move(hint)));
}

std::vector<Diagnostic> ScenarioFile::diagnostics() const {
  std::vector<Diagnostic> sorted = diagnostics_;
  std::ranges::stable_sort(sorted, {}, [this](const Diagnostic& diagnostic) {
    return std::tuple(diagnostic.source == kOverride, diagnostic.source != name_, diagnostic.source,
                      diagnostic.line, diagnostic.column);
  });
  return sorted;
}

void TellAdvice(const ScenarioFile& file) {
  for (const Diagnostic& advice : file.advice()) {
    Tell("{}\n", Format(advice, "warning"));
  }
}

ScenarioFile Checked(ScenarioFile file, const std::vector<std::string>& overrides,
                     const ScenarioLimits& limits) {
  for (const std::string& assignment : overrides) file.Set(assignment);
  file.Check(limits);
  RequireNone(file.diagnostics());
  return file;
}

}  // namespace contact::cli
