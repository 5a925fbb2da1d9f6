#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "contact/v1/scenario.pb.h"

namespace contact {

/// The type of the field at a path in a scenario, if it is an enum; else null.
const google::protobuf::EnumDescriptor* EnumAt(std::string_view path);

/// Name of an axis in tables and figures: its label, else its field.
const std::string& AxisName(const v1::Sweep::Axis& axis);

/// The word that a value of an axis stands for, such as `EXACT`; empty for a number, and for a
/// number that the enum has not.
std::string_view AxisWord(const v1::Sweep::Axis& axis, double value);

}  // namespace contact
