#include "cli/input/override.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <optional>
#include <span>
#include <utility>

#include "cli/base/failure.h"
#include "cli/input/yaml_reader.h"
#include "wire/rules/field_path.h"
#include "wire/scenario/entry_names.h"

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
    const std::string here = walked.empty() ? step.name : walked + "." + step.name;
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

}  // namespace

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

}  // namespace contact::cli
