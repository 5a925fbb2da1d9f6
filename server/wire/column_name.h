#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace contact {

/// Name and unit of a column of a table. The views live as long as the contract's descriptors.
struct ColumnName {
  /// Such as `approach_velocity`.
  std::string_view name;
  /// SI unit, such as `m/s`; `1` for a number without dimension; empty for words.
  std::string_view unit;
};

/// The column of a field. The unit is that of its rule in the contract, such as `N·s/m^(n+1)`, else
/// the one that ends its name: `approach_velocity_m_per_s` becomes `approach_velocity` and `m/s`.
ColumnName ColumnOf(const google::protobuf::FieldDescriptor& field);

/// Header of a column in every table of server and clients: `velocity [m/s]`; the bare name where
/// `unit` is empty.
std::string ColumnHeader(std::string_view name, std::string_view unit);

}  // namespace contact
