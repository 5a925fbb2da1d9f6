#include "wire/scenario/scenario_codec.h"

#include <fmt/format.h>

#include <algorithm>

#include "wire/rules/rules.h"
#include "wire/scenario/body_codec.h"
#include "wire/scenario/contact_codec.h"
#include "wire/scenario/load_codec.h"

namespace contact {
namespace {

constexpr int kDefaultSamples = 1000;

std::vector<Support> DecodeSupports(const v1::Scenario& message, const std::vector<Body>& bodies,
                                    const BodyNames& names, std::vector<Violation>* violations) {
  std::vector<Support> supports;
  for (int i = 0; i < message.supports_size(); ++i) {
    const Rules rules(violations, "supports", i);
    const v1::Support& support = message.supports(i);
    const int body = names.Find(support.body(), "body", rules);
    RequireMovable(bodies, body, rules);
    const int other = support.other().empty() ? kNone : names.Find(support.other(), "other", rules);
    if (other != kNone && other == body) {
      rules.Break("other", "is the body itself", "leave it out for a support to the ground");
    }
    using Field = v1::Support;
    supports.push_back({.body = body,
                        .other = other,
                        .stiffness = rules.Read(support, Field::kStiffnessNPerMFieldNumber),
                        .damping = rules.Read(support, Field::kDampingNSPerMFieldNumber),
                        .rest_position = rules.Read(support, Field::kRestPositionMFieldNumber)});
  }
  return supports;
}

UpdateRule DecodeUpdate(v1::Solver::Update update) {
  switch (update) {
    case v1::Solver::PAPER_NEWTON:
      return UpdateRule::kPaperNewton;
    case v1::Solver::PAPER_RATIO:
      return UpdateRule::kPaperRatio;
    case v1::Solver::PAPER_BISECTION:
      return UpdateRule::kPaperBisection;
    default:
      return UpdateRule::kNewtonCoupled;
  }
}

// The method, how μ is corrected, and what a cycle's phases are.
void DecodeProcess(const v1::Solver& message, const Rules& rules, SolverOptions* options) {
  rules.RequireAvailable("method", message.method(), {v1::Solver::ADAPTIVE, v1::Solver::RK4});
  const double step = rules.Read(message, v1::Solver::kStepSFieldNumber);
  if (message.method() == v1::Solver::RK4) {
    options->fixed_step = step;
  } else if (message.has_step_s()) {
    rules.Break("step_s", "is given, but goes only with method RK4", "remove it");
  }
  rules.RequireAvailable("update", message.update(),
                         {v1::Solver::NEWTON_COUPLED, v1::Solver::PAPER_NEWTON,
                          v1::Solver::PAPER_RATIO, v1::Solver::PAPER_BISECTION});
  options->update = DecodeUpdate(message.update());
  rules.RequireAvailable("phase_split", message.phase_split(),
                         {v1::Solver::PEAK_DEFORMATION, v1::Solver::PEAK_FORCE});
  if (message.phase_split() == v1::Solver::PEAK_FORCE) {
    options->phase_split = PhaseSplit::kPeakForce;
  }
}

// Newton's sensitivities hold only where F δ̇ = 0 at the split.
void RequireSplitSolvable(const Scenario& scenario, const Rules& rules) {
  if (scenario.solver.phase_split != PhaseSplit::kPeakForce ||
      scenario.solver.update != UpdateRule::kNewtonCoupled) {
    return;
  }
  for (const Contact& contact : scenario.contacts) {
    if (contact.damping != DampingLaw::kEnergyRestitution) continue;
    rules.Break("phase_split", "is PEAK_FORCE, which update NEWTON_COUPLED cannot solve",
                "take update PAPER_RATIO, or phase_split PEAK_DEFORMATION");
    return;
  }
}

SolverOptions DecodeSolver(const v1::Solver& message, const Rules& rules) {
  SolverOptions options;
  options.clip_tension = message.tension() == v1::Solver::CLIP;
  options.fail_if_not_converged = message.on_not_converged() == v1::Solver::FAIL;

  DecodeProcess(message, rules, &options);
  options.relative_tolerance = rules.Read(message, v1::Solver::kRelativeToleranceFieldNumber);
  options.restitution_tolerance = rules.Read(message, v1::Solver::kRestitutionToleranceFieldNumber);
  options.max_iterations =
      static_cast<int>(rules.Read(message, v1::Solver::kMaxIterationsFieldNumber));
  rules.RequireAvailable("tension", message.tension(), {v1::Solver::ALLOW, v1::Solver::CLIP});
  rules.RequireAvailable("on_not_converged", message.on_not_converged(),
                         {v1::Solver::REPORT, v1::Solver::FAIL});
  options.settled_fraction = rules.Read(message, v1::Solver::kSettledFractionFieldNumber);
  if (message.has_settled_fraction()) options.settled_nirv_fraction = options.settled_fraction;
  // Exact: 2^53 is above the largest number of steps.
  const double most_steps = rules.Read(message, v1::Solver::kMaxStepsFieldNumber);
  options.max_steps =
      message.has_max_steps() ? message.max_steps() : static_cast<std::int64_t>(most_steps);
  return options;
}

double DecodeSampleInterval(const v1::Scenario& message, const ScenarioLimits& limits,
                            const Rules& rules) {
  const v1::Output& output = message.output();
  const double end_time = message.end_time_s();
  if (!output.has_sample_interval_s()) return output.ledger_only() ? 0 : end_time / kDefaultSamples;
  const double interval = rules.Read(output, v1::Output::kSampleIntervalSFieldNumber);
  const Range& times = NumberOf<v1::Scenario>(v1::Scenario::kEndTimeSFieldNumber).range;
  const Range& intervals = NumberOf<v1::Output>(v1::Output::kSampleIntervalSFieldNumber).range;
  if (intervals.Contains(interval) && times.Contains(end_time) &&
      !(end_time / interval + 1 <= static_cast<double>(limits.max_samples))) {
    rules.Break("sample_interval_s",
                fmt::format("is {}, which makes {:.4g} samples; must make at most {}", interval,
                            end_time / interval + 1, limits.max_samples),
                "set output.ledger_only to record none");
  }
  return output.ledger_only() ? 0 : interval;
}

// Checks how much there is before anything is allocated for it.
void CheckCounts(const v1::Scenario& message, const ScenarioLimits& limits,
                 std::vector<Violation>* violations) {
  const Rules rules(violations);
  const auto check = [&rules](std::string_view field, std::int64_t count, std::int64_t most) {
    if (count <= most) return;
    rules.Break(field, fmt::format("holds {}; must hold at most {}", count, most));
  };
  check("bodies", message.bodies_size(), limits.max_bodies);
  check("contacts", CountContacts(message), limits.max_contacts);
  check("supports", message.supports_size(), limits.max_contacts);
  check("loads", message.loads_size(), limits.max_contacts);
}

void CheckTitle(const std::string& title, const Rules& rules) {
  const auto characters = std::ranges::count_if(
      title, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; });
  const int longest = RuleOf<v1::Scenario>(v1::Scenario::kTitleFieldNumber).max_characters();
  if (characters <= longest) return;
  rules.Break("title", fmt::format("has {} characters; must have at most {}", characters, longest));
}

}  // namespace

DecodedScenario DecodeScenario(const v1::Scenario& message, const ScenarioLimits& limits) {
  DecodedScenario decoded;
  std::vector<Violation>* violations = &decoded.violations;
  CheckCounts(message, limits, violations);
  if (!violations->empty()) return decoded;

  const Rules rules(violations);
  CheckTitle(message.title(), rules);
  Scenario& scenario = decoded.scenario;
  scenario.bodies = DecodeBodies(message, violations);
  const BodyNames names(scenario.bodies);
  scenario.contacts = DecodeContacts(message, scenario.bodies, names, violations);
  scenario.supports = DecodeSupports(message, scenario.bodies, names, violations);
  scenario.loads = DecodeLoads(message, scenario.bodies, names, violations);
  scenario.solver = DecodeSolver(message.solver(), Rules(violations, "solver"));
  RequireSplitSolvable(scenario, Rules(violations, "solver"));
  scenario.sample_interval = DecodeSampleInterval(message, limits, Rules(violations, "output"));
  scenario.end_time = rules.Read(message, v1::Scenario::kEndTimeSFieldNumber);
  return decoded;
}

}  // namespace contact
