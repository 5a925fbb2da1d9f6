#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "contact/v1/scenario.pb.h"

namespace contact {

/// The field at a path in a scenario, whether or not its entries are there; null if there is none.
const google::protobuf::FieldDescriptor* FieldAt(std::string_view path);

/// Name of an axis in tables and figures: its label, else its field.
const std::string& AxisName(const v1::Sweep::Axis& axis);

/// The word that a value of an axis stands for, such as `EXACT`; empty for a number, and for a
/// number that the enum has not.
std::string_view AxisWord(const v1::Sweep::Axis& axis, double value);

}  // namespace contact
