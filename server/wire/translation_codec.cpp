#include "wire/translation_codec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "base/spelling.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

using translate::Tool;
using translate::ToolParameter;
using v1::TranslateModelRequest;

// Of velocities and parameters, which stand in lists, where the contract states no range.
const Range kVelocity{.low = 1e-9, .high = 1e6, .text = "in [1e-9, 1e6]"};
const Range kFirstParameter{.low = 1e-15, .high = 1e30, .text = "in [1e-15, 1e30]"};
const Range kParameter{.low = 0, .high = 1e30, .text = "in [0, 1e30]"};

std::string Entry(std::string_view list, std::string_view key) {
  return fmt::format("{}[{}]", list, key);
}

// The tool with this name; null and a note in the rules if there is none.
const Tool* ReadTool(const Rules& rules, const std::string& field, const std::string& name) {
  const Tool* tool = translate::FindTool(name);
  if (tool == nullptr) {
    rules.Break(field, fmt::format("is {}, which is no model", Quoted(name)),
                translate::ToolHint(name));
  }
  return tool;
}

void ReadTargets(const Rules& rules, const TranslateModelRequest& request,
                 DecodedTranslation* decoded) {
  const auto& most = RuleOf<TranslateModelRequest>(TranslateModelRequest::kModelsFieldNumber);
  if (!rules.RequireAtMost("models", request.models_size(), most.max_entries())) return;
  for (int i = 0; i < request.models_size(); ++i) {
    decoded->targets.push_back(
        ReadTool(rules, Entry("models", std::to_string(i)), request.models(i)));
  }
  if (request.models().empty() && !request.has_from()) {
    for (const Tool& tool : translate::Tools()) decoded->targets.push_back(&tool);
  }
}

// The setup of all velocities but for these.
translate::Setup ReadSetup(const Rules& rules, const TranslateModelRequest& request) {
  const double mass = rules.Read(request, TranslateModelRequest::kMassKgFieldNumber);
  const double gravity = rules.Read(request, TranslateModelRequest::kGravityMPerS2FieldNumber);
  return {.collision = {.mass = mass, .load = mass * gravity},
          .radius = rules.Read(request, TranslateModelRequest::kRadiusMFieldNumber),
          .step = rules.Read(request, TranslateModelRequest::kStepSFieldNumber)};
}

void ReadSetups(const Rules& rules, const TranslateModelRequest& request,
                DecodedTranslation* decoded) {
  constexpr std::string_view kField = "velocities_m_per_s";
  const int given = request.velocities_m_per_s_size();
  const translate::Setup setup = ReadSetup(rules, request);
  const auto& most =
      RuleOf<TranslateModelRequest>(TranslateModelRequest::kVelocitiesMPerSFieldNumber);
  if (given == 0) rules.Break(kField, "is missing", "give one");
  if (given > 1 && !request.has_from()) {
    rules.Break(kField, fmt::format("holds {}; must hold 1 without from", given));
  }
  if (!rules.RequireAtMost(kField, given, most.max_entries())) return;
  for (int i = 0; i < given; ++i) {
    const double velocity = request.velocities_m_per_s(i);
    rules.Require(Entry(kField, std::to_string(i)), velocity, kVelocity);
    decoded->setups.push_back(setup);
    decoded->setups.back().collision.velocity = velocity;
  }
}

void ReadWanted(const Rules& rules, const TranslateModelRequest::Wanted& message,
                translate::Wanted* wanted) {
  using Message = TranslateModelRequest::Wanted;
  wanted->restitution = rules.Read(message, Message::kRestitutionFieldNumber);
  wanted->stiffness = rules.Read(message, Message::kStiffnessFieldNumber);
  wanted->exponent = rules.Read(message, Message::kExponentFieldNumber);
  wanted->duration = rules.Read(message, Message::kContactTimeSFieldNumber);
  if (message.has_stiffness() == message.has_contact_time_s()) {
    rules.Break("", "must have either stiffness or contact_time_s");
  }
}

// The values in the order of the tool's parameters.
void ReadValues(const Rules& rules, const TranslateModelRequest::Given& message, const Tool& tool,
                std::vector<double>* values) {
  for (const ToolParameter& parameter : tool.parameters) {
    const std::string field = Entry("values", parameter.name);
    const auto found = message.values().find(std::string(parameter.name));
    const bool given = found != message.values().end();
    values->push_back(given ? found->second : 0);
    if (!given) rules.Break(field, fmt::format("is missing; its unit is {}", parameter.unit));
    if (given)
      rules.Require(field, found->second, values->size() == 1 ? kFirstParameter : kParameter);
  }
  for (const auto& entry : message.values()) {
    if (std::ranges::find(tool.parameters, entry.first, &ToolParameter::name) !=
        tool.parameters.end()) {
      continue;
    }
    std::vector<std::string_view> names;
    for (const ToolParameter& parameter : tool.parameters) names.push_back(parameter.name);
    rules.Break(Entry("values", Shortened(entry.first)),
                fmt::format("is no parameter of {}", tool.name),
                fmt::format("its parameters are {}", fmt::join(names, ", ")));
  }
}

void ReadGiven(const Rules& root, const TranslateModelRequest::Given& message,
               DecodedTranslation* decoded) {
  const Rules rules = root.In("from");
  decoded->from = ReadTool(rules, "model", message.model());
  if (decoded->from == nullptr) return;
  const Tool& tool = *decoded->from;
  ReadValues(rules, message, tool, &decoded->values);
  if (decoded->setups.empty()) return;
  const std::string_view missing = Missing(tool, decoded->setups.front());
  if (!missing.empty()) {
    root.Break(missing == "step" ? "step_s" : "radius_m",
               fmt::format("is missing; {} needs it", tool.name));
  }
  if (!rules.empty()) return;
  for (const translate::Setup& setup : decoded->setups) {
    if (CanJudge(tool, decoded->values, setup)) continue;
    return rules.Break("values", "have no spring or damper, or damp nearly everything");
  }
}

v1::ModelTranslation::Delivered EncodeDelivered(const translate::Translation& found) {
  v1::ModelTranslation::Delivered message;
  message.set_restitution_alone(found.alone.restitution);
  message.set_restitution(found.loaded.restitution);
  message.set_velocity_ratio(found.loaded.velocity_ratio);
  message.set_contact_time_s(found.loaded.duration);
  message.set_deformation_m(found.loaded.deformation);
  message.set_peak_force_n(found.loaded.peak_force);
  message.set_largest_pull_n(found.loaded.pull);
  return message;
}

void EncodeParameters(const translate::Translation& found, v1::ModelTranslation* message) {
  const Tool& tool = *found.tool;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    auto& parameter = *message->add_parameters();
    parameter.set_name(std::string(tool.parameters[i].name));
    parameter.set_value(found.values[i]);
    parameter.set_unit(std::string(tool.parameters[i].unit));
  }
}

}  // namespace

DecodedTranslation DecodeTranslation(const TranslateModelRequest& request) {
  DecodedTranslation decoded;
  const Rules rules(&decoded.violations);
  ReadTargets(rules, request, &decoded);
  ReadSetups(rules, request, &decoded);
  if (request.has_wanted()) {
    ReadWanted(rules.In("wanted"), request.wanted(), &decoded.wanted);
  } else if (request.has_from()) {
    ReadGiven(rules, request.from(), &decoded);
  } else {
    rules.Break("contact", "is missing", "give wanted or from");
  }
  return decoded;
}

v1::ModelTranslation EncodeTranslation(const translate::Translation& found, double velocity) {
  v1::ModelTranslation message;
  const Tool& tool = *found.tool;
  message.set_model(std::string(tool.name));
  message.set_title(std::string(tool.title));
  message.set_source(std::string(tool.source));
  message.set_velocity_m_per_s(velocity);
  if (!found.values.empty()) {
    EncodeParameters(found, &message);
    message.set_line(LineOf(tool, found.values));
    *message.mutable_delivered() = EncodeDelivered(found);
  }
  if (found.textbook) message.set_textbook_restitution(*found.textbook);
  if (found.stepped) {
    message.mutable_at_step()->set_least(found.stepped->least);
    message.mutable_at_step()->set_mean(found.stepped->mean);
    message.mutable_at_step()->set_most(found.stepped->most);
  }
  if (!found.missing.empty()) message.add_warnings(fmt::format("needs the {}", found.missing));
  for (const std::string& warning : found.warnings) message.add_warnings(warning);
  return message;
}

v1::ListModelsResponse EncodeModels() {
  v1::ListModelsResponse response;
  for (const Tool& tool : translate::Tools()) {
    v1::ContactModel& model = *response.add_models();
    model.set_name(std::string(tool.name));
    model.set_title(std::string(tool.title));
    model.set_source(std::string(tool.source));
    model.set_needs_radius(tool.needs_radius);
    model.set_needs_step(tool.needs_step);
    for (const ToolParameter& parameter : tool.parameters) {
      auto& added = *model.add_parameters();
      added.set_name(std::string(parameter.name));
      added.set_unit(std::string(parameter.unit));
    }
  }
  return response;
}

}  // namespace contact
