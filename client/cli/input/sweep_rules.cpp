#include "cli/input/sweep_rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <cstdio>
#include <limits>

#include "cli/base/scalar.h"
#include "wire/rules/field_path.h"
#include "wire/scenario_advice.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

// How much is too much is for the server to say; it has to fit into memory here, though.
constexpr ScenarioLimits kLimits{.max_bodies = std::numeric_limits<std::int32_t>::max(),
                                 .max_contacts = std::numeric_limits<std::int32_t>::max(),
                                 .max_samples = std::numeric_limits<std::int64_t>::max(),
                                 .max_cells = 1'000'000};

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

std::vector<Diagnostic> CheckSweep(const v1::Sweep& sweep,
                                   const std::function<Diagnostic(const Violation&)>& place) {
  const DecodedSweep plan = DecodeSweep(sweep, kLimits);
  std::vector<Diagnostic> mistakes;
  for (const Violation& violation : plan.violations) mistakes.push_back(place(violation));
  if (!mistakes.empty()) return mistakes;
  for (const Violation& advice : Advise(sweep, plan)) {
    fmt::print(stderr, "{}\n", Format(place(advice), "warning"));
  }
  return {};
}

}  // namespace contact::cli
