#include "cli/input/sweep_rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/scalar.h"
#include "cli/input/no_limits.h"
#include "cli/input/yaml_reader.h"
#include "wire/rules/field_rule.h"
#include "wire/scenario_advice.h"
#include "wire/sweep/axis_words.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

bool IsNumberAt(const std::string& path) {
  const auto* field = FieldAt(path);
  return field != nullptr && !field->is_repeated() && IsNumber(*field);
}

}  // namespace

std::optional<double> AxisValue(const std::string& path, const std::string& text) {
  const auto* field = FieldAt(path);
  const auto* type = field == nullptr ? nullptr : field->enum_type();
  const auto* word = type == nullptr ? nullptr : FindWord(*type, text);
  return word == nullptr ? ParseNumber(text) : word->number();
}

std::optional<VariableAxis> FindVariableAxis(const std::string& field,
                                             const VariableFields& variables) {
  constexpr std::string_view kVariable = "var:";
  if (!field.starts_with(kVariable)) return std::nullopt;
  const std::string name = field.substr(kVariable.size());
  const auto found = variables.find(name);
  if (found == variables.end()) {
    return VariableAxis{.problem = fmt::format("unknown variable {}", Quoted(name)),
                        .hint = KnownVariables(name, variables)};
  }
  VariableAxis axis;
  std::ranges::copy_if(found->second, std::back_inserter(axis.fields), IsNumberAt);
  if (!axis.fields.empty()) return axis;
  return VariableAxis{.problem = fmt::format("{} is the whole value of no number", Quoted(name)),
                      .hint = fmt::format("an axis sets fields such as mass_kg: ${{{}}}", name)};
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
