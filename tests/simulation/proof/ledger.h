#pragma once

#include <cstdint>

#include "testing/cases.h"

namespace contact::testing {

/// What a run reports, without the passes of the search, which fill the memory in long campaigns.
struct Ledger final : Record {
  std::int64_t passes = 0;
  void OnIteration(const Iteration&) override { ++passes; }
  void OnGrowth(const Group&) override {}
};

inline Ledger RunForLedger(const Scenario& scenario) {
  Ledger ledger;
  ledger.outcome = Run(scenario, ledger);
  return ledger;
}

}  // namespace contact::testing
