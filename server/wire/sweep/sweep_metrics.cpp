#include "wire/sweep/sweep_metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "wire/rules/field_path.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr std::array<std::string_view, 5> kRoots{"cycles", "groups", "final_bodies", "summary",
                                                 "convergence"};

// What names an entry: its body or its contact.
const FieldDescriptor* NameField(const Descriptor& entry) {
  const FieldDescriptor* name = entry.FindFieldByName("name");
  return name != nullptr ? name : entry.FindFieldByName("contact");
}

// A name alone may be a field of the summary.
std::vector<PathStep> Whole(std::vector<PathStep> path) {
  if (path.size() == 1 && std::ranges::find(kRoots, path.front().name) == kRoots.end()) {
    path.insert(path.begin(), PathStep{.name = "summary"});
  }
  return path;
}

std::string RootHint() {
  return fmt::format("metrics begin with {}, or are a field of summary", fmt::join(kRoots, ", "));
}

}  // namespace

SweepMetrics::SweepMetrics(const v1::Sweep& sweep, std::vector<Violation>* violations) {
  const int most = RuleOf<v1::Sweep>(v1::Sweep::kMetricsFieldNumber).max_entries();
  if (!Rules(violations).RequireAtMost("metrics", sweep.metrics_size(), most)) return;
  for (int i = 0; i < sweep.metrics_size(); ++i) {
    paths_.push_back(Find(sweep.metrics(i), Rules(violations, "metrics", i)));
  }
}

SweepMetrics::Path SweepMetrics::Find(const std::string& text, const Rules& rules) {
  Path path;
  const std::vector<PathStep> steps = Whole(ParsePath(text, true));
  if (steps.empty() || std::ranges::find(kRoots, steps.front().name) == kRoots.end()) {
    rules.Break("", fmt::format("{} is no number of a result", Quoted(text)), RootHint());
    return path;
  }
  const Descriptor* type = v1::Job::descriptor();
  for (const PathStep& step : steps) {
    const FieldDescriptor* field = type == nullptr ? nullptr : type->FindFieldByName(step.name);
    if (field == nullptr) {
      rules.Break("", fmt::format("{}: unknown field {}", Quoted(text), Quoted(step.name)),
                  type == nullptr ? "" : FieldHint(*type, step.name));
      return path;
    }
    const bool entry = step.index.has_value() || !step.key.empty();
    if (field->is_repeated() != entry || step.index == PathStep::kEvery) {
      rules.Break("",
                  fmt::format("{}: {} {}", Quoted(text), step.name,
                              field->is_repeated() ? "is a list" : "is no list"),
                  field->is_repeated() ? "say which entry, by index or name" : "");
      return path;
    }
    type = field->message_type();
    path.push_back({field, step.index, step.key});
  }
  if (!IsNumber(*path.back().field)) {
    rules.Break("", Quoted(text) + " is not a number", "name a number in it");
  }
  return path;
}

void SweepMetrics::CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Step& root = paths_[i].front();
    if (root.key.empty()) continue;
    std::vector<std::string_view> names;
    if (root.field->name() != "final_bodies") {
      for (const Contact& contact : scenario.contacts) names.push_back(contact.name);
    } else {
      for (const Body& body : scenario.bodies) names.push_back(body.name);
    }
    if (std::ranges::find(names, root.key) != names.end()) continue;
    Rules(violations, "metrics", static_cast<int>(i))
        .Break("", fmt::format("the base has no {}", Quoted(root.key)),
               DidYouMean(root.key, names));
  }
}

std::vector<double> SweepMetrics::Of(const v1::Job& result) const {
  std::vector<double> values;
  values.reserve(paths_.size());
  for (const Path& path : paths_) values.push_back(Value(path, result));
  return values;
}

double SweepMetrics::Value(const Path& path, const Message& message) {
  const Message* at = &message;
  for (const Step& step : path) {
    const auto* reflection = at->GetReflection();
    if (step.field->is_repeated()) {
      at = Entry(step, *at);
      if (at == nullptr) return kNaN;
    } else if (IsNumber(*step.field)) {
      const bool unset = step.field->has_presence() && !reflection->HasField(*at, step.field);
      if (unset) return kNaN;
      return NumberIn(*at, *step.field);
    } else {
      at = &reflection->GetMessage(*at, step.field);
    }
  }
  return kNaN;
}

const Message* SweepMetrics::Entry(const Step& step, const Message& message) {
  const auto* reflection = message.GetReflection();
  const FieldDescriptor* name = step.key.empty() ? nullptr : NameField(*step.field->message_type());
  const int size = reflection->FieldSize(message, step.field);
  for (int i = step.index.value_or(0); i < size; ++i) {
    const Message& entry = reflection->GetRepeatedMessage(message, step.field, i);
    if (name == nullptr || entry.GetReflection()->GetString(entry, name) == step.key) return &entry;
  }
  return nullptr;
}

}  // namespace contact
