#include "cli/input/sweep_rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <cstdio>
#include <string_view>

#include "cli/base/scalar.h"
#include "cli/input/no_limits.h"
#include "wire/rules/field_path.h"
#include "wire/scenario_advice.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

// The type of the field at a path in a scenario, if it is an enum.
const google::protobuf::EnumDescriptor* EnumAt(const std::string& path) {
  const google::protobuf::Descriptor* message = v1::Scenario::descriptor();
  const google::protobuf::FieldDescriptor* field = nullptr;
  for (const PathStep& step : ParsePath(path)) {
    field = message == nullptr ? nullptr : message->FindFieldByName(step.name);
    if (field == nullptr) return nullptr;
    message = field->message_type();
  }
  return field == nullptr ? nullptr : field->enum_type();
}

}  // namespace

std::optional<double> AxisValue(const std::string& path, const std::string& text) {
  const auto* type = EnumAt(path);
  const auto* word = type == nullptr ? nullptr : type->FindValueByName(text);
  return word == nullptr ? ParseNumber(text) : word->number();
}

std::vector<Diagnostic> CheckSweep(const v1::Sweep& sweep, const ScenarioFile* base,
                                   const std::function<Diagnostic(const Violation&)>& place) {
  const auto place_anywhere = [&](Violation violation) {
    constexpr std::string_view kBase = "base.";
    if (base == nullptr || !violation.field.starts_with(kBase)) return place(violation);
    violation.field.erase(0, kBase.size());
    return base->Place(violation);
  };
  const DecodedSweep plan = DecodeSweep(sweep, kNoLimits);
  std::vector<Diagnostic> mistakes;
  for (const Violation& violation : plan.violations) mistakes.push_back(place_anywhere(violation));
  if (!mistakes.empty()) return mistakes;
  for (const Violation& advice : Advise(sweep, plan)) {
    fmt::print(stderr, "{}\n", Format(place_anywhere(advice), "warning"));
  }
  return {};
}

}  // namespace contact::cli
