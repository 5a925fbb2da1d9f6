#include "wire/sweep/sweep_fields.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/spelling.h"

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

}  // namespace

SweepFields::SweepFields(const v1::Sweep& sweep, std::vector<Violation>* violations)
    : scenario_(std::make_unique<v1::Scenario>(sweep.base())) {
  for (int i = 0; i < sweep.axes_size(); ++i) {
    const Rules rules(violations, "axes", i);
    const std::string& field = sweep.axes(i).field();
    const std::vector<PathStep> path = ParsePath(field);
    targets_.emplace_back();
    if (path.empty()) {
      rules.Break("field",
                  field.empty() ? "is missing" : fmt::format("{} is no path", Quoted(field)),
                  "name a number of the scenario, such as contacts[0].restitution");
    } else {
      Find(path, "", scenario_.get(), rules);
    }
  }
}

void SweepFields::Find(std::span<const PathStep> path, const std::string& walked, Message* message,
                       const Rules& rules) {
  const PathStep& step = path.front();
  const std::string here = walked.empty() ? step.name : walked + "." + step.name;
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(step.name);
  if (field == nullptr) {
    return rules.Break("field", fmt::format("{}: unknown field", Quoted(here)),
                       FieldHint(*message->GetDescriptor(), step.name));
  }
  if (step.index) return FindEntries(path, here, *field, message, rules);
  if (path.size() == 1) return AddTarget(here, *field, message, rules);
  const auto* reflection = message->GetReflection();
  if (field->is_repeated()) {
    rules.Break("field", here + " is a list", here + "[0], or [*] for every entry");
  } else if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
    rules.Break("field", fmt::format("{} has no field {}", here, Quoted(path[1].name)));
  } else if (field->real_containing_oneof() != nullptr && !reflection->HasField(*message, field)) {
    rules.Break("field", fmt::format("the base has no {}", here));
  } else {
    Find(path.subspan(1), here, reflection->MutableMessage(message, field), rules);
  }
}

void SweepFields::FindEntries(std::span<const PathStep> path, const std::string& here,
                              const FieldDescriptor& field, Message* message, const Rules& rules) {
  if (!field.is_repeated() || field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE ||
      path.size() == 1) {
    return rules.Break("field", here + " has no entries with numbers");
  }
  const auto* reflection = message->GetReflection();
  const int size = reflection->FieldSize(*message, &field);
  const int index = *path.front().index;
  if (index >= size || size == 0) {
    return rules.Break("field", fmt::format("{}: there are only {}", here, size));
  }
  const bool every = index == PathStep::kEvery;
  for (int i = every ? 0 : index; i < (every ? size : index + 1); ++i) {
    Find(path.subspan(1), fmt::format("{}[{}]", here, i),
         reflection->MutableRepeatedMessage(message, &field, i), rules);
  }
}

void SweepFields::AddTarget(const std::string& here, const FieldDescriptor& field, Message* message,
                            const Rules& rules) {
  if (!IsNumber(field)) {
    rules.Break("field", here + " is not a number, so it cannot vary");
  } else if (!paths_.insert(here).second) {
    rules.Break("field", here + " has an axis already");
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
