// All kinds of random scenarios under one number: those of kinds.h, then the machines.
#pragma once

#include <string_view>

#include "simulation/kinds.h"
#include "simulation/kinds/machines.h"

namespace contact::testing {

inline int KindCount() { return kKinds + static_cast<int>(Machines().size()); }

inline std::string_view NameOfKind(int kind) {
  return kind < kKinds ? kKindNames[kind]
                       : Machines()[static_cast<std::size_t>(kind - kKinds)].name;
}

inline Scenario RollKind(int kind, unsigned seed) {
  if (kind < kKinds) return Dice(seed, static_cast<Kind>(kind)).Roll();
  return Roll(Machines()[static_cast<std::size_t>(kind - kKinds)], seed);
}

}  // namespace contact::testing
