#include "cli/export/data_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/reflection.h>

#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "wire/column_name.h"

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// A field of a message as a column. Name and unit come from the field's name in the contract.
struct Meaning {
  std::string_view field;
  std::string_view description;
  std::string_view name = {};  // Another name for the column than the field has.
};

// A row of the ledger.
constexpr Meaning kCycle[] = {
    {"contact", "name of the contact"},
    {"number", "place of the cycle among those of its contact"},
    {"kind", "how the cycle began"},
    {"end", "how the cycle ended"},
    {"status", "what became of the restitution asked for"},
    {"iterations", "corrections of mu made for the episode"},
    {"episode", "cycles with the same number were solved together"},
    {"start_time_s", "time at which compression began"},
    {"turn_time_s", "time at which restitution began"},
    {"end_time_s", "time at which the cycle ended"},
    {"delta_start_m", "deformation at the start"},
    {"delta_max_m", "largest deformation"},
    {"delta_end_m", "deformation at the end"},
    {"approach_velocity_m_per_s", "deformation velocity at the start"},
    {"separation_velocity_m_per_s", "deformation velocity at the end"},
    {"mu", "hysteresis damping factor"},
    {"mu_over_k_s_per_m", "hysteresis damping factor over stiffness"},
    {"alpha", "mu times approach velocity over stiffness"},
    {"work_compression_j", "work of the contact force in compression"},
    {"work_restitution_j", "work of the contact force in restitution"},
    {"dissipated_compression_j", "energy lost in compression"},
    {"dissipated_restitution_j", "energy lost in restitution"},
    {"external_work_compression_j", "work of the equivalent external force in compression"},
    {"external_work_restitution_j", "work of the equivalent external force in restitution"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"restitution_out", "energy restitution coefficient of the cycle"},
    {"peak_force_n", "largest contact force"},
    {"tension_time_s", "time for which the contact force pulled"},
    {"identity_residual", "imbalance of energy over work_compression"},
    {"group", "number of its group, 0 for none"},
    {"newton_restitution", "relative velocity after over that before"},
};

// A group of cycles.
constexpr Meaning kGroup[] = {
    {"contact", "name of the contact"},
    {"number", "place of the group among those of its contact"},
    {"first_cycle", "number of its first cycle"},
    {"cycles", "how many cycles it has"},
    {"encounter", "place of its encounter among those of its contact"},
    {"start_time_s", "time at which its first cycle began"},
    {"end_time_s", "time at which its last cycle ended"},
    {"end", "how its last cycle ended"},
    {"mu", "hysteresis damping factor of all its cycles"},
    {"work_compression_j", "work of the contact force in all its compressions"},
    {"work_restitution_j", "work of the contact force in all its restitutions"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"restitution_out", "energy restitution coefficient of the group"},
    {"status", "what became of the restitution asked for"},
    {"growth", "why it took in its neighbour last"},
    {"residual", "imbalance of energy over work_compression"},
    {"too_much_mu", "nearest mu that gave too much restitution"},
    {"too_much_restitution", "restitution at too_much_mu"},
    {"too_little_mu", "nearest mu that gave too little restitution"},
    {"too_little_restitution", "restitution at too_little_mu"},
    {"beside_cut", "whether with a later end of the run its mu may be another"},
    {"other_roots", "larger mu that give that restitution, too"},
};

// A pass of the search for μ, and
constexpr Meaning kIteration[] = {
    {"episode", "cycles with the same number were solved together"},
    {"number", "corrections made so far", "pass"},
    {"start_time_s", "time at which the episode starts"},
    {"accepted", "1 for the pass whose trajectory is the accepted one"},
};

// a group of cycles in it.
constexpr Meaning kUnknown[] = {
    {"contact", "name of the contact"},
    {"number", "place of its first cycle among those of its contact", "cycle"},
    {"mu", "hysteresis damping factor of this pass"},
    {"restitution_out", "energy restitution coefficient that it gave"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"residual", "W_r/W_c + restitution_in^2"},
    {"bracket_low", "largest mu known to give too much restitution"},
    {"bracket_high", "smallest mu known to give too little restitution"},
    {"update", "how the next mu is found"},
};

// A body at the end of the run.
constexpr Meaning kBody[] = {
    {"name", "name of the body"},
    {"position_m", "position of the centre at the end of the run"},
    {"velocity_m_per_s", "velocity at the end of the run"},
};

// The quantities of a series.
constexpr std::pair<std::string_view, std::string_view> kQuantities[] = {
    {"time", "simulated time"},
    {"position", "position of the centre"},
    {"velocity", "velocity"},
    {"deformation", "deformation (overlap)"},
    {"deformation_velocity", "rate of change of the deformation"},
    {"contact_force", "contact force"},
    {"external_force", "equivalent external force"},
};

const FieldDescriptor& Field(const google::protobuf::Descriptor& type, const Meaning& meaning) {
  return *type.FindFieldByName(std::string(meaning.field));
}

// Empty columns for these fields of a type of message.
std::vector<DataColumn> Columns(const google::protobuf::Descriptor& type,
                                std::span<const Meaning> meanings) {
  std::vector<DataColumn> columns;
  for (const Meaning& meaning : meanings) {
    const ColumnName found = ColumnOf(Field(type, meaning));
    DataColumn column{std::string(meaning.name.empty() ? found.name : meaning.name),
                      std::string(found.unit), std::string(meaning.description),
                      std::vector<double>()};
    if (found.unit.empty() || Field(type, meaning).is_repeated())
      column.values = std::vector<std::string>();
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
      if (field.has_presence() && !reflection.HasField(message, &field))
        return std::numeric_limits<double>::quiet_NaN();
      return reflection.GetDouble(message, &field);
  }
}

std::string Word(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  if (field.is_repeated()) {
    return fmt::format("{}",
                       fmt::join(reflection.GetRepeatedFieldRef<double>(message, &field), " "));
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    return reflection.GetString(message, &field);
  }
  const auto* value = reflection.GetEnum(message, &field);
  return value->number() == 0 ? "" : value->name();
}

// Adds the fields of a message to the columns that begin at `columns`.
void AddRow(const Message& message, std::span<const Meaning> meanings, DataColumn* columns) {
  for (const Meaning& meaning : meanings) {
    const FieldDescriptor& field = Field(*message.GetDescriptor(), meaning);
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

std::string DataColumn::Header() const { return ColumnHeader(name, unit); }

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
  DataTable table{"cycles", "cycle", Columns(*v1::Cycle::descriptor(), kCycle)};
  for (const v1::Cycle& cycle : job.cycles()) AddRow(cycle, kCycle, table.columns.data());
  return table;
}

DataTable GroupsTable(const v1::Job& job) {
  DataTable table{"groups", "group", Columns(*v1::Group::descriptor(), kGroup)};
  for (const v1::Group& group : job.groups()) AddRow(group, kGroup, table.columns.data());
  return table;
}

DataTable IterationsTable(const std::vector<v1::Iteration>& iterations) {
  DataTable table{"iterations", "iteration", Columns(*v1::Iteration::descriptor(), kIteration)};
  for (DataColumn& column : Columns(*v1::Iteration::Unknown::descriptor(), kUnknown))
    table.columns.push_back(std::move(column));
  for (const v1::Iteration& iteration : iterations) {
    for (const v1::Iteration::Unknown& unknown : iteration.unknowns()) {
      AddRow(iteration, kIteration, table.columns.data());
      AddRow(unknown, kUnknown, table.columns.data() + std::size(kIteration));
    }
  }
  return table;
}

DataTable BodiesTable(const v1::Job& job) {
  DataTable table{"bodies", "body", Columns(*v1::FinalBody::descriptor(), kBody)};
  for (const v1::FinalBody& body : job.final_bodies()) AddRow(body, kBody, table.columns.data());
  return table;
}

}  // namespace contact::cli
