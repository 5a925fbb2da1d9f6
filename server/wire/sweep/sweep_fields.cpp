#include "wire/sweep/sweep_fields.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/spelling.h"
#include "wire/rules/rules.h"
#include "wire/scenario/entry_names.h"

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

double SetNumber(const FieldDescriptor& field, double value, google::protobuf::Message* message) {
  const auto* reflection = message->GetReflection();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
    reflection->SetDouble(message, &field, value);
    return value;
  }
  const bool small = field.cpp_type() != FieldDescriptor::CPPTYPE_INT64;
  const double most = small ? std::numeric_limits<std::int32_t>::max() : 0x1p62;
  const double whole = std::clamp(std::round(value), -most, most);
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    reflection->SetEnumValue(message, &field, static_cast<int>(whole));
  } else if (small) {
    reflection->SetInt32(message, &field, static_cast<std::int32_t>(whole));
  } else {
    reflection->SetInt64(message, &field, static_cast<std::int64_t>(whole));
  }
  return whole;
}

// The index that a step means in a list of `message`, which is at `here`, or kEvery; nothing if no
// entry is meant.
std::optional<int> IndexOf(const PathStep& step, const std::string& here,
                           const FieldDescriptor& list, const google::protobuf::Message& message,
                           const std::function<void(std::string, std::string)>& fail) {
  if (!step.key.empty()) {
    const NamedEntry named = FindNamed(message, list, step.key);
    if (named.index >= 0) return named.index;
    fail(fmt::format("{}: {}", here, named.problem), named.hint);
    return std::nullopt;
  }
  const int size = message.GetReflection()->FieldSize(message, &list);
  if (*step.index < size && size > 0) return step.index;
  fail(fmt::format("{}: there are only {}", here, size), "");
  return std::nullopt;
}

}  // namespace

SweepFields::SweepFields(const v1::Sweep& sweep, std::vector<Violation>* violations)
    : scenario_(std::make_unique<v1::Scenario>(sweep.base())) {
  const int most = RuleOf<v1::Sweep::Axis>(v1::Sweep::Axis::kAlsoFieldNumber).max_entries();
  for (int i = 0; i < sweep.axes_size(); ++i) {
    const Rules rules(violations, "axes", i);
    const v1::Sweep::Axis& axis = sweep.axes(i);
    targets_.emplace_back();
    Read(axis.field(), [&rules](std::string description, std::string hint) {
      rules.Break("field", std::move(description), std::move(hint));
    });
    if (!rules.RequireAtMost("also", axis.also_size(), most)) continue;
    for (int j = 0; j < axis.also_size(); ++j) {
      Read(axis.also(j), [&rules, j](std::string description, std::string hint) {
        rules.Break(fmt::format("also[{}]", j), std::move(description), std::move(hint));
      });
    }
  }
}

void SweepFields::Read(const std::string& path, const Break& fail) {
  const std::vector<PathStep> steps = ParsePath(path, true);
  if (!steps.empty()) return Find(steps, "", scenario_.get(), fail);
  fail(path.empty() ? "is missing" : fmt::format("{} is no path", Quoted(path)),
       "name a number of the scenario, such as contacts[0].restitution");
}

void SweepFields::Find(std::span<const PathStep> path, const std::string& walked, Message* message,
                       const Break& fail) {
  const PathStep& step = path.front();
  const std::string here = walked.empty() ? step.name : walked + "." + step.name;
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(step.name);
  if (field == nullptr) {
    return fail(fmt::format("{}: unknown field", Quoted(here)),
                FieldHint(*message->GetDescriptor(), step.name));
  }
  if (step.index || !step.key.empty()) return FindEntries(path, here, *field, message, fail);
  if (path.size() == 1) return AddTarget(here, *field, message, fail);
  const auto* reflection = message->GetReflection();
  if (field->is_repeated()) {
    fail(here + " is a list", here + "[0], or [*] for every entry");
  } else if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
    fail(fmt::format("{} has no field {}", here, Quoted(path[1].name)), "");
  } else if (field->real_containing_oneof() != nullptr && !reflection->HasField(*message, field)) {
    fail(fmt::format("the base has no {}", here), "");
  } else {
    Find(path.subspan(1), here, reflection->MutableMessage(message, field), fail);
  }
}

void SweepFields::FindEntries(std::span<const PathStep> path, const std::string& here,
                              const FieldDescriptor& field, Message* message, const Break& fail) {
  if (!field.is_repeated() || field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE ||
      path.size() == 1) {
    return fail(here + " has no entries with numbers", "");
  }
  const std::optional<int> index = IndexOf(path.front(), here, field, *message, fail);
  if (!index) return;
  const auto* reflection = message->GetReflection();
  const bool every = *index == PathStep::kEvery;
  const int end = every ? reflection->FieldSize(*message, &field) : *index + 1;
  for (int i = every ? 0 : *index; i < end; ++i) {
    Find(path.subspan(1), fmt::format("{}[{}]", here, i),
         reflection->MutableRepeatedMessage(message, &field, i), fail);
  }
}

void SweepFields::AddTarget(const std::string& here, const FieldDescriptor& field, Message* message,
                            const Break& fail) {
  if (!IsNumber(field)) {
    fail(here + " is not a number, so it cannot vary", "");
  } else if (!paths_.insert(here).second) {
    fail(here + " has an axis already", "");
  } else {
    targets_.back().push_back({message, &field});
  }
}

const v1::Scenario& SweepFields::Set(std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    double set = values[i];
    for (const Target& target : targets_[i]) {
      set = SetNumber(*target.field, values[i], target.message);
    }
    values[i] = set;
  }
  return *scenario_;
}

}  // namespace contact
