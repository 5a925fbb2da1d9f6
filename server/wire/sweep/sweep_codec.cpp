#include "wire/sweep/sweep_codec.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "wire/rules/rules.h"
#include "wire/sweep/sweep_fields.h"

namespace contact {
namespace {

void CheckKept(const v1::Sweep& sweep, std::int32_t cells, std::vector<Violation>* violations) {
  const Rules rules(violations);
  const int most = RuleOf<v1::Sweep>(v1::Sweep::kKeepTrajectoriesFieldNumber).max_entries();
  if (sweep.keep_trajectories_size() > most) {
    return rules.Break("keep_trajectories", fmt::format("has {} entries; must have at most {}",
                                                        sweep.keep_trajectories_size(), most));
  }
  std::set<std::int32_t> seen;
  for (int i = 0; i < sweep.keep_trajectories_size(); ++i) {
    const std::int32_t cell = sweep.keep_trajectories(i);
    const std::string field = fmt::format("keep_trajectories[{}]", i);
    if (cell < 0 || cell >= cells) {
      rules.Break(field, fmt::format("is {}; must be in [0, {}]", cell, cells - 1));
    } else if (!seen.insert(cell).second) {
      rules.Break(field, fmt::format("is {}, which is there already", cell));
    }
  }
  if (sweep.keep_trajectories_size() > 0 && sweep.base().output().ledger_only()) {
    rules.Break("keep_trajectories", "goes not with base.output.ledger_only");
  }
}

}  // namespace

DecodedSweep DecodeSweep(const v1::Sweep& message, const ScenarioLimits& limits) {
  DecodedSweep decoded;
  std::vector<Violation>* violations = &decoded.violations;
  decoded.axes = SweepAxes(message, limits.max_cells, violations);
  SweepFields fields(message, violations);
  decoded.metrics = SweepMetrics(message, violations);
  if (decoded.axes.cells() == 0) return decoded;
  CheckKept(message, decoded.axes.cells(), violations);
  if (!violations->empty()) return decoded;

  std::vector<double> values = decoded.axes.Values(0);
  DecodedScenario first = DecodeScenario(fields.Set(values), limits);
  for (Violation violation : first.violations) {
    if (fields.Sets(violation.field)) continue;  // This cell will fail, and tell why.
    violation.field = "base." + violation.field;
    violations->push_back(std::move(violation));
  }
  if (violations->empty()) decoded.metrics.CheckNames(first.scenario, violations);
  if (first.violations.empty()) decoded.first = std::move(first.scenario);
  return decoded;
}

}  // namespace contact
