#include "cli/export/data_table.h"

#include <fmt/format.h>

#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr char kMuUnit[] = "N s/m^(n+1)";  // n is the exponent of the contact.

// How a field of a message is exported. The contract writes units into names; here they stand
// beside them.
struct Meaning {
  std::string_view field;
  std::string_view name;
  std::string_view unit;
  std::string_view description;
};

constexpr Meaning kCycle[] = {
    {"contact", "contact", "", "name of the contact"},
    {"number", "number", "1", "place of the cycle among those of its contact"},
    {"kind", "kind", "", "how the cycle began"},
    {"end", "end", "", "how the cycle ended"},
    {"status", "status", "", "what became of the restitution asked for"},
    {"iterations", "iterations", "1", "corrections of mu made for the episode"},
    {"episode", "episode", "1", "cycles with the same number were solved together"},
    {"start_time_s", "start_time", "s", "time at which compression began"},
    {"turn_time_s", "turn_time", "s", "time at which restitution began"},
    {"end_time_s", "end_time", "s", "time at which the cycle ended"},
    {"delta_start_m", "delta_start", "m", "deformation at the start"},
    {"delta_max_m", "delta_max", "m", "largest deformation"},
    {"delta_end_m", "delta_end", "m", "deformation at the end"},
    {"approach_velocity_m_per_s", "approach_velocity", "m/s", "deformation velocity at the start"},
    {"separation_velocity_m_per_s", "separation_velocity", "m/s",
     "deformation velocity at the end"},
    {"mu", "mu", kMuUnit, "hysteresis damping factor"},
    {"mu_over_k_s_per_m", "mu_over_k", "s/m", "hysteresis damping factor over stiffness"},
    {"alpha", "alpha", "1", "mu times approach velocity over stiffness"},
    {"work_compression_j", "work_compression", "J", "work of the contact force in compression"},
    {"work_restitution_j", "work_restitution", "J", "work of the contact force in restitution"},
    {"dissipated_compression_j", "dissipated_compression", "J", "energy lost in compression"},
    {"dissipated_restitution_j", "dissipated_restitution", "J", "energy lost in restitution"},
    {"external_work_compression_j", "external_work_compression", "J",
     "work of the equivalent external force in compression"},
    {"external_work_restitution_j", "external_work_restitution", "J",
     "work of the equivalent external force in restitution"},
    {"restitution_in", "restitution_in", "1", "energy restitution coefficient asked for"},
    {"restitution_out", "restitution_out", "1", "energy restitution coefficient of the cycle"},
    {"peak_force_n", "peak_force", "N", "largest contact force"},
    {"tension_time_s", "tension_time", "s", "time for which the contact force pulled"},
    {"identity_residual", "identity_residual", "1", "imbalance of energy over work_compression"},
};

constexpr Meaning kIteration[] = {
    {"episode", "episode", "1", "cycles with the same number were solved together"},
    {"number", "pass", "1", "corrections made so far"},
    {"start_time_s", "start_time", "s", "time at which the episode starts"},
    {"accepted", "accepted", "1", "1 for the pass whose trajectory is the accepted one"},
};

constexpr Meaning kUnknown[] = {
    {"contact", "contact", "", "name of the contact"},
    {"number", "cycle", "1", "place of the cycle among those of its contact"},
    {"mu", "mu", kMuUnit, "hysteresis damping factor of this pass"},
    {"restitution_out", "restitution_out", "1", "energy restitution coefficient that it gave"},
    {"restitution_in", "restitution_in", "1", "energy restitution coefficient asked for"},
    {"residual", "residual", "1", "W_r/W_c + restitution_in^2"},
    {"bracket_low", "bracket_low", kMuUnit, "largest mu known to give too much restitution"},
    {"bracket_high", "bracket_high", kMuUnit, "smallest mu known to give too little restitution"},
    {"update", "update", "", "how the next mu is found"},
};

constexpr Meaning kBody[] = {
    {"name", "name", "", "name of the body"},
    {"position_m", "position", "m", "position of the centre at the end of the run"},
    {"velocity_m_per_s", "velocity", "m/s", "velocity at the end of the run"},
};

constexpr std::pair<std::string_view, std::string_view> kQuantities[] = {
    {"time", "simulated time"},
    {"position", "position of the centre"},
    {"velocity", "velocity"},
    {"deformation", "deformation (overlap)"},
    {"deformation_velocity", "rate of change of the deformation"},
    {"contact_force", "contact force"},
    {"external_force", "equivalent external force"},
};

std::vector<DataColumn> Columns(std::span<const Meaning> meanings) {
  std::vector<DataColumn> columns;
  for (const Meaning& meaning : meanings) {
    DataColumn column{std::string(meaning.name), std::string(meaning.unit),
                      std::string(meaning.description), std::vector<double>()};
    if (meaning.unit.empty()) column.values = std::vector<std::string>();
    columns.push_back(std::move(column));
  }
  return columns;
}

double Number(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? 1 : 0;
    default:
      return reflection.GetDouble(message, &field);
  }
}

std::string Word(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    return reflection.GetString(message, &field);
  }
  const auto* value = reflection.GetEnum(message, &field);
  return value->number() == 0 ? "" : value->name();
}

// Adds the fields of a message to the columns that begin at `columns`.
void AddRow(const Message& message, std::span<const Meaning> meanings, DataColumn* columns) {
  for (const Meaning& meaning : meanings) {
    const FieldDescriptor& field =
        *message.GetDescriptor()->FindFieldByName(std::string(meaning.field));
    auto& values = (columns++)->values;
    if (auto* numbers = std::get_if<std::vector<double>>(&values)) {
      numbers->push_back(Number(message, field));
    } else {
      std::get<std::vector<std::string>>(values).push_back(Word(message, field));
    }
  }
}

std::string Description(const SampleColumn& column) {
  const std::size_t dot = column.name.rfind('.');
  std::string_view words = column.quantity;
  for (const auto& [quantity, description] : kQuantities) {
    if (quantity == column.quantity) words = description;
  }
  if (dot == std::string::npos) return std::string(words);
  return fmt::format("{} of {}", words, column.name.substr(0, dot));
}

}  // namespace

std::string DataColumn::Header() const {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

DataTable SeriesTable(Recording&& recording) {
  DataTable table{"series", "time", {}};
  for (SampleColumn& column : recording.columns) {
    std::string description = Description(column);
    table.columns.push_back({std::move(column.name), std::move(column.unit), std::move(description),
                             std::move(column.values)});
  }
  return table;
}

DataTable CyclesTable(const v1::Job& job) {
  DataTable table{"cycles", "cycle", Columns(kCycle)};
  for (const v1::Cycle& cycle : job.cycles()) AddRow(cycle, kCycle, table.columns.data());
  return table;
}

DataTable IterationsTable(const std::vector<v1::Iteration>& iterations) {
  DataTable table{"iterations", "iteration", Columns(kIteration)};
  for (DataColumn& column : Columns(kUnknown)) table.columns.push_back(std::move(column));
  for (const v1::Iteration& iteration : iterations) {
    for (const v1::Iteration::Unknown& unknown : iteration.unknowns()) {
      AddRow(iteration, kIteration, table.columns.data());
      AddRow(unknown, kUnknown, table.columns.data() + std::size(kIteration));
    }
  }
  return table;
}

DataTable BodiesTable(const v1::Job& job) {
  DataTable table{"bodies", "body", Columns(kBody)};
  for (const v1::FinalBody& body : job.final_bodies()) AddRow(body, kBody, table.columns.data());
  return table;
}

}  // namespace contact::cli
