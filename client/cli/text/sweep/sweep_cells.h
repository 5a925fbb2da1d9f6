#pragma once

#include <map>

#include "contact/v1/event.pb.h"

namespace contact::cli {

/// The cells of a sweep that have been computed, by their index.
using SweepCells = std::map<int, v1::SweepCell>;

}  // namespace contact::cli
