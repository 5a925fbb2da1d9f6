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

constexpr std::array<std::string_view, 4> kRoots{"cycles", "final_bodies", "summary",
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
  if (sweep.metrics_size() > most) {
    Rules(violations)
        .Break("metrics",
               fmt::format("holds {}; must hold at most {}", sweep.metrics_size(), most));
    return;
  }
  for (int i = 0; i < sweep.metrics_size(); ++i) {
    const Rules rules(violations, "metrics", i);
    const std::string& text = sweep.metrics(i);
    const std::vector<PathStep> steps = Whole(ParsePath(text, true));
    Path& path = paths_.emplace_back();
    if (steps.empty() || std::ranges::find(kRoots, steps.front().name) == kRoots.end()) {
      rules.Break("", fmt::format("{} is no number of a result", Quoted(text)), RootHint());
      continue;
    }
    const Descriptor* type = v1::Job::descriptor();
    for (const PathStep& step : steps) {
      const FieldDescriptor* field = type == nullptr ? nullptr : type->FindFieldByName(step.name);
      if (field == nullptr) {
        rules.Break("", fmt::format("{}: unknown field {}", Quoted(text), Quoted(step.name)),
                    type == nullptr ? "" : FieldHint(*type, step.name));
        break;
      }
      const bool entry = step.index.has_value() || !step.key.empty();
      if (field->is_repeated() != entry || step.index == PathStep::kEvery) {
        rules.Break("",
                    fmt::format("{}: {} {}", Quoted(text), step.name,
                                field->is_repeated() ? "is a list" : "is no list"),
                    field->is_repeated() ? "say which entry, by index or name" : "");
        break;
      }
      type = field->message_type();
      path.push_back({field, step.index, step.key});
    }
    if (path.size() == steps.size() &&
        (type != nullptr || path.back().field->cpp_type() == FieldDescriptor::CPPTYPE_STRING)) {
      rules.Break("", Quoted(text) + " is not a number", "name a number in it");
    }
  }
}

void SweepMetrics::CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Step& root = paths_[i].front();
    if (root.key.empty()) continue;
    std::vector<std::string_view> names;
    if (root.field->name() == "cycles") {
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
    if (!step.field->is_repeated()) {
      switch (step.field->cpp_type()) {
        case FieldDescriptor::CPPTYPE_MESSAGE:
          at = &reflection->GetMessage(*at, step.field);
          continue;
        case FieldDescriptor::CPPTYPE_INT32:
          return reflection->GetInt32(*at, step.field);
        case FieldDescriptor::CPPTYPE_INT64:
          return static_cast<double>(reflection->GetInt64(*at, step.field));
        case FieldDescriptor::CPPTYPE_ENUM:
          return reflection->GetEnumValue(*at, step.field);
        default:
          return reflection->GetDouble(*at, step.field);
      }
    }
    const int size = reflection->FieldSize(*at, step.field);
    const auto entry = [&](int i) { return &reflection->GetRepeatedMessage(*at, step.field, i); };
    int index = step.index.value_or(0);
    if (!step.key.empty()) {
      const FieldDescriptor* name = NameField(*step.field->message_type());
      const auto is_it = [&](int i) {
        return entry(i)->GetReflection()->GetString(*entry(i), name) == step.key;
      };
      while (index < size && !is_it(index)) ++index;
    }
    if (index >= size) return kNaN;
    at = entry(index);
  }
  return kNaN;
}

}  // namespace contact
