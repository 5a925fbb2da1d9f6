#include "cli/export/data_table.h"

#include <fmt/format.h>

#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "cli/export/meanings.h"
#include "wire/column_name.h"

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

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
    if (found.unit.empty()) column.values = std::vector<std::string>();
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
