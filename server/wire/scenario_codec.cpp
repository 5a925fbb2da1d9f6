#include "wire/scenario_codec.h"

#include <fmt/format.h>

#include <algorithm>

#include "wire/body_codec.h"
#include "wire/contact_codec.h"
#include "wire/load_codec.h"
#include "wire/rules.h"

namespace contact {
namespace {

constexpr Range kCoefficient{0, 1e30, "[0, 1e30]"};
constexpr Range kPosition{-1e9, 1e9, "[-1e9, 1e9]"};
constexpr Range kStep{0, 1, "(0, 1]"};
constexpr Range kRelativeTolerance{1e-13, 1e-3, "[1e-13, 1e-3]"};
constexpr Range kRestitutionTolerance{1e-12, 0.1, "[1e-12, 0.1]"};
constexpr Range kMaxIterations{1, 1000, "[1, 1000]"};
constexpr Range kSettledFraction{0, 0.1, "[0, 0.1]"};
constexpr Range kMaxSteps{1, 1e12, "[1, 1e12]"};
constexpr Range kEndTime{0, 1e6, "(0, 1e6]"};

constexpr std::int64_t kLongestTitle = 200;
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
    rules.Require("stiffness_n_per_m", support.stiffness_n_per_m(), kCoefficient);
    rules.Require("damping_n_s_per_m", support.damping_n_s_per_m(), kCoefficient);
    rules.Require("rest_position_m", support.rest_position_m(), kPosition);
    supports.push_back({.body = body,
                        .other = other,
                        .stiffness = support.stiffness_n_per_m(),
                        .damping = support.damping_n_s_per_m(),
                        .rest_position = support.rest_position_m()});
  }
  return supports;
}

constexpr double kDefaultStep = 1e-6;  // The paper's [s].

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
  if (message.method() == v1::Solver::RK4) {
    options->fixed_step = message.has_step_s() ? message.step_s() : kDefaultStep;
    rules.Require("step_s", options->fixed_step, kStep);
  } else if (message.has_step_s()) {
    rules.Require("step_s", message.step_s(), kStep);
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
  if (message.has_relative_tolerance()) options.relative_tolerance = message.relative_tolerance();
  if (message.has_restitution_tolerance()) {
    options.restitution_tolerance = message.restitution_tolerance();
  }
  if (message.has_max_iterations()) options.max_iterations = message.max_iterations();
  if (message.has_settled_fraction()) {
    options.settled_fraction = options.settled_nirv_fraction = message.settled_fraction();
  }
  if (message.has_max_steps()) options.max_steps = message.max_steps();
  options.clip_tension = message.tension() == v1::Solver::CLIP;
  options.fail_if_not_converged = message.on_not_converged() == v1::Solver::FAIL;

  DecodeProcess(message, rules, &options);
  rules.Require("relative_tolerance", options.relative_tolerance, kRelativeTolerance);
  rules.Require("restitution_tolerance", options.restitution_tolerance, kRestitutionTolerance);
  rules.Require("max_iterations", options.max_iterations, kMaxIterations);
  rules.RequireAvailable("tension", message.tension(), {v1::Solver::ALLOW, v1::Solver::CLIP});
  rules.RequireAvailable("on_not_converged", message.on_not_converged(),
                         {v1::Solver::REPORT, v1::Solver::FAIL});
  rules.Require("settled_fraction", options.settled_fraction, kSettledFraction);
  rules.Require("max_steps", static_cast<double>(options.max_steps), kMaxSteps);
  return options;
}

double DecodeSampleInterval(const v1::Scenario& message, const ScenarioLimits& limits,
                            const Rules& rules) {
  const v1::Output& output = message.output();
  const double end_time = message.end_time_s();
  if (!output.has_sample_interval_s()) return output.ledger_only() ? 0 : end_time / kDefaultSamples;
  const double interval = output.sample_interval_s();
  if (!Range{0, 1e308, "(0"}.Contains(interval)) {
    rules.Break("sample_interval_s", fmt::format("is {}; must be > 0", interval));
  } else if (kEndTime.Contains(end_time) &&
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
  if (characters <= kLongestTitle) return;
  rules.Break("title",
              fmt::format("has {} characters; must have at most {}", characters, kLongestTitle));
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
  scenario.end_time = message.end_time_s();
  if (message.end_time_s() == 0) {
    rules.Break("end_time_s", "is missing; must be in (0, 1e6]");
  } else {
    rules.Require("end_time_s", message.end_time_s(), kEndTime);
  }
  return decoded;
}

}  // namespace contact
