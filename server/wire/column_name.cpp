#include "wire/column_name.h"

#include <fmt/format.h>

#include <utility>

#include "wire/rules/field_rule.h"

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

// How names in the contract end, and the unit that this means; longer endings first.
constexpr std::pair<std::string_view, std::string_view> kUnits[] = {{"_n_s_per_m", "N·s/m"},
                                                                    {"_kg_per_m3", "kg/m^3"},
                                                                    {"_rad_per_s", "rad/s"},
                                                                    {"_m_per_s2", "m/s^2"},
                                                                    {"_m_per_s", "m/s"},
                                                                    {"_s_per_m", "s/m"},
                                                                    {"_n_per_m", "N/m"},
                                                                    {"_rad", "rad"},
                                                                    {"_hz", "Hz"},
                                                                    {"_pa", "Pa"},
                                                                    {"_kg", "kg"},
                                                                    {"_m", "m"},
                                                                    {"_s", "s"},
                                                                    {"_j", "J"},
                                                                    {"_n", "N"}};

}  // namespace

ColumnName ColumnOf(const FieldDescriptor& field) {
  const std::string_view name = field.name();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING ||
      field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    return {name, ""};
  }
  if (const std::string& unit = RuleOf(field).unit(); !unit.empty()) return {name, unit};
  for (const auto& [ending, unit] : kUnits) {
    if (name.ends_with(ending)) return {name.substr(0, name.size() - ending.size()), unit};
  }
  return {name, "1"};
}

std::string ColumnHeader(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

}  // namespace contact
