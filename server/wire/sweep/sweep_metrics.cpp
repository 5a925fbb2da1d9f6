#include "wire/sweep/sweep_metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/reflection.h>

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr std::array<std::string_view, 6> kRoots{"cycles",  "groups",      "final_bodies",
                                                 "summary", "convergence", "series"};

// Numbers of a result that say nothing of a run without a cycle: those of the search for μ.
constexpr std::array<std::string_view, 6> kOfCycles{
    "convergence", "iterations",          "episodes",
    "growths",     "growths_no_progress", "worst_identity_residual"};

bool IsOfCycles(const FieldDescriptor& field) {
  return std::ranges::find(kOfCycles, field.name()) != kOfCycles.end();
}

// The number whose name is nearest to a word; null if none is near.
const FieldDescriptor* FindNear(const Descriptor& type, std::string_view word) {
  std::vector<std::string_view> names;
  for (int i = 0; i < type.field_count(); ++i) {
    if (IsNumber(*type.field(i))) names.push_back(type.field(i)->name());
  }
  return type.FindFieldByName(std::string(Nearest(word, names)));
}

bool IsListOfReals(const FieldDescriptor& field) {
  return field.is_repeated() && field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
}

// What names an entry: its body or its contact.
const FieldDescriptor* NameField(const Descriptor& entry) {
  const FieldDescriptor* name = entry.FindFieldByName("name");
  return name != nullptr ? name : entry.FindFieldByName("contact");
}

// True for a cycle or group that the end of the run cuts. One that rests is not cut.
template <class Row>
bool IsCut(const Message& entry) {
  const auto* row = google::protobuf::DynamicCastToGenerated<const Row>(&entry);
  if (row == nullptr) return false;
  if (row->status() == v1::Cycle::CUT || row->status() == v1::Cycle::UNFINISHED) return true;
  return row->end() == v1::Cycle::RUN_END && row->status() != v1::Cycle::SETTLED;
}

bool IsCutRow(const Message& entry) { return IsCut<v1::Cycle>(entry) || IsCut<v1::Group>(entry); }

// A name alone may be a field of the summary.
std::vector<PathStep> Whole(std::vector<PathStep> path) {
  if (path.size() == 1 && std::ranges::find(kRoots, path.front().name) == kRoots.end()) {
    path.insert(path.begin(), PathStep{.name = "summary"});
  }
  return path;
}

// Hint for a field that `type` has not. What somebody takes for a number of the whole result may be
// one of each cycle, group or body.
std::string MetricHint(const Descriptor& type, const std::string& name) {
  if (&type != v1::RunSummary::descriptor() || FindNear(type, name)) return FieldHint(type, name);
  for (const char* list : {"cycles", "groups", "final_bodies"}) {
    const Descriptor& entry = *v1::Job::descriptor()->FindFieldByName(list)->message_type();
    const FieldDescriptor* near = FindNear(entry, name);
    if (near == nullptr) continue;
    return fmt::format("did you mean '{0}.max.{1}', or {0}[NAME].last.{1} of one?", list,
                       near->name());
  }
  return FieldHint(type, name);
}

std::string RootHint() {
  return fmt::format("metrics begin with {}, or are a field of summary", fmt::join(kRoots, ", "));
}

}  // namespace

SweepMetrics::SweepMetrics(const v1::Sweep& sweep, std::vector<Violation>* violations) {
  const int most = RuleOf<v1::Sweep>(v1::Sweep::kMetricsFieldNumber).max_entries();
  if (!Rules(violations).RequireAtMost("metrics", sweep.metrics_size(), most)) return;
  for (int i = 0; i < sweep.metrics_size(); ++i) {
    const Rules rules(violations, "metrics", i);
    const std::vector<PathStep> steps = ParsePath(sweep.metrics(i), true);
    if (steps.empty() || steps.front().name != "series") {
      paths_.push_back(Find(sweep.metrics(i), rules));
    } else if (auto metric = FindSeriesMetric(steps, sweep.metrics(i), rules)) {
      paths_.emplace_back();
      series_.push_back(*std::move(metric));
    }
  }
}

SweepMetrics::Path SweepMetrics::Find(const std::string& text, const Rules& rules) {
  const std::vector<PathStep> steps = Whole(ParsePath(text, true));
  if (!steps.empty() && std::ranges::find(kRoots, steps.front().name) != kRoots.end()) {
    return Follow(steps, text, rules);
  }
  rules.Break("", fmt::format("{} is no number of a result", Quoted(text)), RootHint());
  return {};
}

SweepMetrics::Path SweepMetrics::Follow(std::span<const PathStep> steps, const std::string& text,
                                        const Rules& rules) {
  Path path;
  const Descriptor* type = v1::Job::descriptor();
  while (!steps.empty()) {
    const PathStep& step = steps.front();
    const FieldDescriptor* field = type == nullptr ? nullptr : type->FindFieldByName(step.name);
    if (field == nullptr) {
      rules.Break("", fmt::format("{}: unknown field {}", Quoted(text), Quoted(step.name)),
                  type == nullptr ? "" : MetricHint(*type, step.name));
      return path;
    }
    steps = steps.subspan(1);
    const std::optional<Pick> pick =
        field->is_repeated() && !step.index ? PickOf(steps) : std::nullopt;
    const bool named = !step.key.empty() && field->message_type() != nullptr;
    const bool entry = step.index.has_value() || named || pick.has_value();
    if (field->is_repeated() != entry || step.index == PathStep::kEvery) {
      rules.Break("",
                  fmt::format("{}: {} {}", Quoted(text), step.name,
                              field->is_repeated() ? "is a list" : "is no list"),
                  field->is_repeated() ? "say which entry, by index or name, or .first, .last, "
                                         ".max, .min or .count of all"
                                       : "");
      return path;
    }
    if (pick) steps = steps.subspan(1);
    path.push_back({field, step.index, step.key, pick.value_or(Pick::kFirst)});
    type = path.back().pick == Pick::kCount ? nullptr : field->message_type();
  }
  const FieldDescriptor& last = *path.back().field;
  if (path.back().pick != Pick::kCount && !IsNumber(last) && !IsListOfReals(last)) {
    rules.Break("", Quoted(text) + " is not a number", "name a number in it");
  }
  return path;
}

std::optional<SweepMetrics::Pick> SweepMetrics::PickOf(std::span<const PathStep> steps) {
  constexpr std::array<std::pair<std::string_view, Pick>, 5> kPicks{{{"first", Pick::kFirst},
                                                                     {"last", Pick::kLast},
                                                                     {"max", Pick::kMax},
                                                                     {"min", Pick::kMin},
                                                                     {"count", Pick::kCount}}};
  if (steps.empty() || steps.front().index || !steps.front().key.empty()) return std::nullopt;
  for (const auto& [word, pick] : kPicks) {
    if (word == steps.front().name) return pick;
  }
  return std::nullopt;
}

void SweepMetrics::CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const {
  auto series = series_.begin();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Rules rules(violations, "metrics", static_cast<int>(i));
    if (paths_[i].empty()) {
      CheckChannel(*series++, scenario, rules);
    } else if (!paths_[i].front().key.empty()) {
      CheckName(paths_[i].front(), scenario, rules);
    }
  }
}

void SweepMetrics::CheckName(const Step& root, const Scenario& scenario, const Rules& rules) {
  std::vector<std::string_view> names;
  if (root.field->name() != "final_bodies") {
    for (const Contact& contact : scenario.contacts) names.push_back(contact.name);
  } else {
    for (const Body& body : scenario.bodies) names.push_back(body.name);
  }
  if (std::ranges::find(names, root.key) != names.end()) return;
  rules.Break("", fmt::format("the base has no {}", Quoted(root.key)), DidYouMean(root.key, names));
}

std::vector<SweepMetrics::Metric> SweepMetrics::Of(const v1::Job& result,
                                                   const SeriesTally& series) const {
  std::vector<Metric> metrics;
  metrics.reserve(paths_.size());
  std::size_t of_samples = 0;
  for (const Path& path : paths_) {
    if (path.empty()) {
      metrics.push_back({.value = series.Of(of_samples++)});
      continue;
    }
    metrics.push_back(Value(path, result));
    if (result.cycles().empty() && IsOfCycles(*path.back().field)) {
      metrics.back().source = v1::SweepCell::NO_CONTACT;
    }
  }
  return metrics;
}

SweepMetrics::Metric SweepMetrics::Value(std::span<const Step> path, const Message& message) {
  const auto* reflection = message.GetReflection();
  const FieldDescriptor& field = *path.front().field;
  if (IsListOfReals(field)) return ValueOfReals(path.front(), message);
  if (field.is_repeated()) return ValueOfList(path, message);
  if (IsNumber(field)) {
    const bool unset = field.has_presence() && !reflection->HasField(message, &field);
    return {.value = unset ? kNaN : NumberIn(message, field)};
  }
  return Value(path.subspan(1), reflection->GetMessage(message, &field));
}

SweepMetrics::Metric SweepMetrics::ValueOfList(std::span<const Step> path, const Message& message) {
  const Step& step = path.front();
  const auto* reflection = message.GetReflection();
  const FieldDescriptor* name = step.key.empty() ? nullptr : NameField(*step.field->message_type());
  Metric found;
  int count = 0;        // Of the entries that are meant.
  bool hidden = false;  // A cut entry may exceed what the others have.
  for (int i = 0; i < reflection->FieldSize(message, step.field); ++i) {
    const Message& entry = reflection->GetRepeatedMessage(message, step.field, i);
    if (name != nullptr && entry.GetReflection()->GetString(entry, name) != step.key) continue;
    ++count;
    if (step.pick == Pick::kCount || i < step.index.value_or(0)) continue;
    Metric next = Value(path.subspan(1), entry);
    if (IsCutRow(entry)) next.source = v1::SweepCell::CUT;
    if (step.pick == Pick::kFirst) return next;
    hidden |= step.pick != Pick::kLast && IsCutRow(entry) && std::isnan(next.value);
    if (IsChosen(step.pick, next.value, found.value)) found = next;
  }
  if (step.pick == Pick::kCount) return {.value = static_cast<double>(count)};
  if (hidden) found.source = v1::SweepCell::CUT;
  const bool of_contacts = step.field->message_type() != v1::FinalBody::descriptor();
  if (count == 0 && of_contacts) found.source = v1::SweepCell::NO_CONTACT;
  return found;
}

SweepMetrics::Metric SweepMetrics::ValueOfReals(const Step& step, const Message& message) {
  const auto reals = message.GetReflection()->GetRepeatedFieldRef<double>(message, step.field);
  if (step.pick == Pick::kCount) return {.value = static_cast<double>(reals.size())};
  Metric found;
  for (int i = step.index.value_or(0); i < reals.size(); ++i) {
    if (step.pick == Pick::kFirst) return {.value = reals.Get(i)};
    if (IsChosen(step.pick, reals.Get(i), found.value)) found.value = reals.Get(i);
  }
  return found;
}

// Of two numbers of which one is NaN the other is chosen.
bool SweepMetrics::IsChosen(Pick pick, double next, double before) {
  if (pick == Pick::kLast || std::isnan(before)) return true;
  return pick == Pick::kMax ? next > before : next < before;
}

}  // namespace contact
