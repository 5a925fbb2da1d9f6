#include "cli/figures/run/run_energy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace contact::cli {
namespace {

using Values = std::vector<double>;

const Values& Column(const Recording& recording, const std::string& name) {
  const SampleColumn* column = recording.Find(name);
  if (column != nullptr) return column->values;
  throw Failure(ExitCode::kUsage, "this run recorded no trajectory; see output.ledger_only");
}

void AddKinetic(const Scenario& scenario, const Recording& recording, Values* energy) {
  for (const auto& body : scenario.bodies) {
    if (body.fixed) continue;
    const Values& velocity = Column(recording, body.name + ".velocity");
    for (std::size_t i = 0; i < energy->size(); ++i) {
      (*energy)[i] += 0.5 * body.mass * velocity[i] * velocity[i];
    }
  }
}

void AddContacts(const Scenario& scenario, const Recording& recording, Values* energy) {
  for (const auto& contact : scenario.contacts) {
    const Values& deformation = Column(recording, contact.name + ".deformation");
    for (std::size_t i = 0; i < energy->size(); ++i) {
      (*energy)[i] += ElasticEnergy(contact.stiffness, contact.exponent, deformation[i]);
    }
  }
}

void AddSupports(const Scenario& scenario, const Recording& recording, Values* energy) {
  const auto position = [&](int body) -> const Values& {
    return Column(recording, scenario.bodies[static_cast<std::size_t>(body)].name + ".position");
  };
  for (const auto& support : scenario.supports) {
    const Values ground(support.other < 0 ? energy->size() : 0);
    const Values& body = position(support.body);
    const Values& other = support.other < 0 ? ground : position(support.other);
    for (std::size_t i = 0; i < energy->size(); ++i) {
      const double stretch = body[i] - other[i] - support.rest_position;
      (*energy)[i] += 0.5 * support.stiffness * stretch * stretch;
    }
  }
}

bool IsConstant(const Load& load) {
  return load.begin == 0 && std::isinf(load.end) && load.slope == 0 && load.amplitude == 0;
}

void AddConstantLoads(const Scenario& scenario, const Recording& recording, Values* energy) {
  for (const Load& load : scenario.loads) {
    if (!IsConstant(load)) continue;
    const std::string& body = scenario.bodies[static_cast<std::size_t>(load.body)].name;
    const Values& position = Column(recording, body + ".position");
    for (std::size_t i = 0; i < energy->size(); ++i) (*energy)[i] -= load.constant * position[i];
  }
}

}  // namespace

std::vector<std::pair<std::string, Values>> MechanicalEnergy(const Scenario& scenario,
                                                             const Recording& recording) {
  const Values zero(Column(recording, "time").size());
  std::vector<std::pair<std::string, Values>> parts{{"kinetic", zero}, {"contacts", zero}};
  AddKinetic(scenario, recording, &parts[0].second);
  AddContacts(scenario, recording, &parts[1].second);
  if (!scenario.supports.empty()) {
    parts.emplace_back("supports", zero);
    AddSupports(scenario, recording, &parts.back().second);
  }
  if (std::ranges::any_of(scenario.loads, IsConstant)) {
    parts.emplace_back("constant loads", zero);
    AddConstantLoads(scenario, recording, &parts.back().second);
  }
  Values sum = zero;
  for (const auto& [name, values] : parts) {
    std::ranges::transform(sum, values, sum.begin(), std::plus());
  }
  parts.emplace_back("sum", std::move(sum));
  return parts;
}

}  // namespace contact::cli
