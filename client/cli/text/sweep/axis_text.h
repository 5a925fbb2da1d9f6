#pragma once

#include <string>

#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// A value of an axis for people: the word of an enum, such as `EXACT`, else the number with so
/// many significant digits. 0 digits: as few as give the same double back.
std::string AxisText(const v1::Sweep::Axis& axis, double value, int digits = 0);

}  // namespace contact::cli
