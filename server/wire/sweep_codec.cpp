#include "wire/sweep_codec.h"

#include <utility>

#include "wire/sweep_fields.h"

namespace contact {

DecodedSweep DecodeSweep(const v1::Sweep& message, const ScenarioLimits& limits) {
  DecodedSweep decoded;
  std::vector<Violation>* violations = &decoded.violations;
  decoded.axes = SweepAxes(message, limits.max_cells, violations);
  SweepFields fields(message, violations);
  decoded.metrics = SweepMetrics(message, violations);
  if (decoded.axes.cells() == 0 || !violations->empty()) return decoded;

  std::vector<double> values = decoded.axes.Values(0);
  const DecodedScenario first = DecodeScenario(fields.Set(values), limits);
  for (Violation violation : first.violations) {
    if (fields.Sets(violation.field)) continue;  // This cell will fail, and tell why.
    violation.field = "base." + violation.field;
    violations->push_back(std::move(violation));
  }
  if (violations->empty()) decoded.metrics.CheckNames(first.scenario, violations);
  return decoded;
}

}  // namespace contact
