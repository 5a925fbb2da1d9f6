#include "wire/scenario/scenario_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "simulation/model/derived.h"
#include "wire/rules/rules.h"
#include "wire/scenario/body_codec.h"
#include "wire/scenario/contact_codec.h"
#include "wire/scenario/load_codec.h"
#include "wire/scenario/start_codec.h"

namespace contact {
namespace {

constexpr int kDefaultSamples = 1000;

// By the number of v1::Solver::Update.
constexpr UpdateRule kUpdates[v1::Solver::Update_ARRAYSIZE] = {
    UpdateRule::kNewtonCoupled, UpdateRule::kNewtonCoupled, UpdateRule::kPaperNewton,
    UpdateRule::kPaperRatio, UpdateRule::kPaperBisection};

// By the number of v1::Solver::RestitutionScope.
constexpr RestitutionScope kScopes[v1::Solver::RestitutionScope_ARRAYSIZE] = {
    RestitutionScope::kAuto, RestitutionScope::kAuto, RestitutionScope::kCycle,
    RestitutionScope::kEncounter};

// Moving walls come after the bodies that have names in the scenario.
void AddWalls(DecodedContacts decoded, Scenario* scenario) {
  scenario->contacts = std::move(decoded.contacts);
  std::ranges::move(decoded.walls, std::back_inserter(scenario->bodies));
  std::ranges::move(decoded.drives, std::back_inserter(scenario->drives));
}

// k₂, k₃, … of a support.
std::vector<double> DecodeHigher(const v1::Support& support, const Rules& rules) {
  constexpr int kField = v1::Support::kHigherStiffnessFieldNumber;
  static const Range range = RangeOf(*v1::Support::descriptor()->FindFieldByNumber(kField));
  const int count = support.higher_stiffness_size();
  const int most = RuleOf<v1::Support>(kField).max_entries();
  if (!rules.RequireAtMost("higher_stiffness", count, most)) return {};
  for (int i = 0; i < count; ++i) {
    const double stiffness = support.higher_stiffness(i);
    if (range.Contains(stiffness)) continue;  // Composes no path.
    rules.Require(fmt::format("higher_stiffness[{}]", i), stiffness, range);
  }
  return {support.higher_stiffness().begin(), support.higher_stiffness().end()};
}

// The largest force of the spring.
double DecodeSlip(const v1::Support& support, const Rules& rules) {
  if (!support.has_slip_force_n()) return std::numeric_limits<double>::infinity();
  if (support.higher_stiffness_size() > 0) {
    rules.Break("slip_force_n", "is given beside higher_stiffness", "only a linear spring slips");
  } else if (support.stiffness_n_per_m() == 0) {
    rules.Break("slip_force_n", "is given, but stiffness_n_per_m is 0",
                "give the stiffness up to that force, or remove it");
  }
  return rules.Read(support, v1::Support::kSlipForceNFieldNumber);
}

// No spring has slipped before t = 0.
void CheckSlips(const Scenario& scenario, std::vector<Violation>* violations) {
  for (std::size_t i = 0; i < scenario.supports.size(); ++i) {
    const Support& s = scenario.supports[i];
    const double force = s.stiffness * std::abs(InitialStretch(scenario, s));
    if (force <= s.slip_force) continue;
    Rules(violations, "supports", static_cast<int>(i))
        .Break("slip_force_n",
               fmt::format("is {}, but the spring begins with {} N", s.slip_force, force),
               "give it a rest_position_m with which it begins with less, or a larger force");
  }
}

std::vector<Support> DecodeSupports(const v1::Scenario& message, const BodyNames& names,
                                    std::vector<Violation>* violations) {
  std::vector<Support> supports;
  for (int i = 0; i < message.supports_size(); ++i) {
    const Rules rules(violations, "supports", i);
    const v1::Support& support = message.supports(i);
    const int body = names.Find(support.body(), "body", rules);
    RequireMovable(message, body, rules);
    const int other = support.other().empty() ? kNone : names.Find(support.other(), "other", rules);
    if (other != kNone && other == body) {
      rules.Break("other", "is the body itself", "leave it out for a support to the ground");
    }
    using Field = v1::Support;
    supports.push_back({.body = body,
                        .other = other,
                        .stiffness = rules.Read(support, Field::kStiffnessNPerMFieldNumber),
                        .damping = rules.Read(support, Field::kDampingNSPerMFieldNumber),
                        .rest_position = rules.Read(support, Field::kRestPositionMFieldNumber),
                        .higher = DecodeHigher(support, rules),
                        .slip_force = DecodeSlip(support, rules)});
  }
  return supports;
}

// The method, how μ is corrected, and what a cycle's phases are.
void DecodeProcess(const v1::Solver& message, const Rules& rules, SolverOptions* options) {
  rules.RequireKnown("method", message.method());
  const double step = rules.Read(message, v1::Solver::kStepSFieldNumber);
  if (message.method() == v1::Solver::RK4) {
    options->fixed_step = step;
  } else if (message.has_step_s()) {
    rules.Break("step_s", "is given, but goes only with method RK4", "remove it");
  }
  rules.RequireKnown("update", message.update());
  if (v1::Solver::Update_IsValid(message.update())) options->update = kUpdates[message.update()];
  rules.RequireKnown("phase_split", message.phase_split());
  if (message.phase_split() == v1::Solver::PEAK_FORCE) {
    options->phase_split = PhaseSplit::kPeakForce;
  }
}

// Which cycles share one μ.
void DecodeScope(const v1::Solver& message, const Rules& rules, SolverOptions* options) {
  rules.RequireKnown("restitution_scope", message.restitution_scope());
  if (v1::Solver::RestitutionScope_IsValid(message.restitution_scope())) {
    options->restitution_scope = kScopes[message.restitution_scope()];
  }
  options->encounter_cycles =
      static_cast<int>(rules.Read(message, v1::Solver::kEncounterCyclesFieldNumber));
  if (message.has_encounter_cycles() && message.restitution_scope() != v1::Solver::ENCOUNTER) {
    rules.Break("encounter_cycles", "is given, but goes only with restitution_scope ENCOUNTER",
                "remove it");
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
  DecodeScope(message, rules, &options);
  options.relative_tolerance = rules.Read(message, v1::Solver::kRelativeToleranceFieldNumber);
  options.restitution_tolerance = rules.Read(message, v1::Solver::kRestitutionToleranceFieldNumber);
  options.max_iterations =
      static_cast<int>(rules.Read(message, v1::Solver::kMaxIterationsFieldNumber));
  rules.RequireKnown("tension", message.tension());
  rules.RequireKnown("on_not_converged", message.on_not_converged());
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

// Numbers of samples that nobody asked for, 8 MB: a row has all columns, so that each contact of a
// gas of 1,000 balls would have a million values of its own.
constexpr double kMostByDefault = 1e6;

// Channels of which extremes are recorded: as many as make at most kMostByDefault numbers, and half
// of the `left` samples.
int TurningChannels(const Scenario& scenario, double regular, double left) {
  const auto fits = [&](std::size_t channels) {
    const double rows = 2 * static_cast<double>(channels) * regular;
    return rows <= left / 2 && rows * SampleColumns(scenario) <= kMostByDefault;
  };
  const std::size_t forces = scenario.contacts.size(), all = forces + 2 * scenario.bodies.size();
  if (scenario.samples_per_contact == 0 || !fits(forces)) return 0;
  return static_cast<int>(fits(all) ? all : forces);
}

// What is recorded of the trajectory, of bodies and contacts that are decoded. Extremes between
// samples at equal intervals come first, then samples in contacts, as many as are left of the
// limit; where nobody asked for them they double the samples at most.
void DecodeOutput(const v1::Scenario& message, const ScenarioLimits& limits, const Rules& rules,
                  Scenario* scenario) {
  constexpr double kMost = 1e15;  // Exact as a number.
  scenario->sample_interval = DecodeSampleInterval(message, limits, rules);
  scenario->samples_per_contact =
      static_cast<int>(rules.Read(message.output(), v1::Output::kSamplesPerContactFieldNumber));
  scenario->wants_all_contact_samples = message.output().has_samples_per_contact();
  const double regular = 1 + std::floor(message.end_time_s() / scenario->sample_interval);
  double most = std::min(static_cast<double>(limits.max_samples) - regular, kMost);
  scenario->turning_channels = TurningChannels(*scenario, regular, most);
  most -= 2 * scenario->turning_channels * regular;
  if (!scenario->wants_all_contact_samples) {
    most = std::min({most, regular, std::floor(kMostByDefault / SampleColumns(*scenario))});
  }
  scenario->most_contact_samples = most > 0 ? static_cast<std::int64_t>(most) : 0;
}

// Checks how much there is before anything is allocated for it.
void CheckCounts(const v1::Scenario& message, const ScenarioLimits& limits,
                 std::vector<Violation>* violations) {
  const Rules rules(violations);
  rules.RequireAtMost("bodies", message.bodies_size(), limits.max_bodies);
  rules.RequireAtMost("contacts", CountContacts(message), limits.max_contacts);
  rules.RequireAtMost("supports", message.supports_size(), limits.max_contacts);
  rules.RequireAtMost("loads", message.loads_size(), limits.max_contacts);
}

}  // namespace

DecodedScenario DecodeScenario(const v1::Scenario& message, const ScenarioLimits& limits) {
  DecodedScenario decoded;
  std::vector<Violation>* violations = &decoded.violations;
  CheckCounts(message, limits, violations);
  if (!violations->empty()) return decoded;

  const Rules rules(violations);
  rules.RequireShort("title", message.title(),
                     RuleOf<v1::Scenario>(v1::Scenario::kTitleFieldNumber).max_characters());
  rules.RequirePrintable("title", message.title());
  Scenario& scenario = decoded.scenario;
  scenario.bodies = DecodeBodies(message, &scenario.drives, violations);
  const BodyNames names(scenario.bodies);
  DecodedContacts contacts = DecodeContacts(message, scenario.bodies, names, violations);
  scenario.supports = DecodeSupports(message, names, violations);
  scenario.loads = DecodeLoads(message, scenario.bodies, names, violations);
  AddWalls(std::move(contacts), &scenario);
  scenario.solver = DecodeSolver(message.solver(), Rules(violations, "solver"));
  RequireSplitSolvable(scenario, Rules(violations, "solver"));
  DecodeOutput(message, limits, Rules(violations, "output"), &scenario);
  scenario.end_time = rules.Read(message, v1::Scenario::kEndTimeSFieldNumber);
  DecodeStart(message, rules, &scenario);
  if (violations->empty()) CheckSlips(scenario, violations);
  return decoded;
}

}  // namespace contact
