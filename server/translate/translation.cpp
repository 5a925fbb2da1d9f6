#include "translate/translation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "translate/damping.h"

namespace contact::translate {
namespace {

// At 20 steps a contact ε = 0.9 comes out as 0.71 to 0.74 in ODE and as 0.896 to 0.909 in LAMMPS
// (client/docs/theory/translation.md).
constexpr double kFewSteps = 20;
// Above it a step changes ε by less than 1e-4, and is not looked at.
constexpr double kManySteps = 20'000;

// More damping, in units of the collision, lets less than a thousandth of the speed come back, and
// the integration takes the longer the more of it there is.
constexpr double kMostDamping = 1e3;

double DurationOf(const Wanted& wanted, const Setup& setup) {
  if (wanted.duration > 0) return wanted.duration;
  const ForceLaw shape{
      .exponent = wanted.exponent, .damping_exponent = wanted.exponent, .pull = Pull::kClamped};
  ForceLaw law = shape;
  law.damping = DampingFor(shape, wanted.restitution).value_or(0);
  const Collision alone{setup.collision.mass, setup.collision.velocity};
  return Collide(WithStiffness(law, alone, wanted.stiffness), alone).duration;
}

ForceLaw LawFor(const Tool& tool, double damping, const Wanted& wanted, const Setup& setup) {
  ForceLaw law = tool.law;
  law.damping = damping;
  if (wanted.stiffness > 0 && tool.law.exponent == wanted.exponent) {
    return WithStiffness(law, setup.collision, wanted.stiffness);
  }
  return WithDuration(law, setup.collision, DurationOf(wanted, setup));
}

// What the tool gives back where ε is its restitution, or its damping is that of textbooks.
std::optional<double> ByTextbook(const Translation& found, const Wanted& wanted,
                                 const Setup& setup) {
  const Tool& tool = *found.tool;
  if (tool.restitution >= 0) {
    std::vector<double> values = found.values;
    values[static_cast<std::size_t>(tool.restitution)] = wanted.restitution;
    return Collide(tool.read(tool.law, values, setup),
                   {setup.collision.mass, setup.collision.velocity})
        .velocity_ratio;
  }
  const auto damping = TextbookDamping(tool.law, wanted.restitution);
  if (!damping) return std::nullopt;
  ForceLaw law = tool.law;
  law.damping = *damping;
  return Collide(law, {}).velocity_ratio;
}

void WarnOfLoad(Translation* found, const Setup& setup) {
  if (setup.collision.load == 0) return;
  if (found->loaded.velocity_ratio == 0) {
    found->warnings.emplace_back("under the load the bodies do not part");
  } else if (found->law.carries_load) {
    found->warnings.emplace_back("the load hardly changes the rebound: the solver carries it");
  }
}

// An implicit step damps by itself.
void WarnOfDampingStep(Translation* found, const Setup& setup) {
  ForceLaw undamped = found->law;
  undamped.damping = 0;
  const SteppedRebound most = Step(undamped, setup.collision, found->tool->stepping, setup.step);
  found->warnings.push_back(fmt::format(
      "at this step no damper gives back more than {:.4f}, for the step damps too", most.mean));
}

void WarnOfStepped(Translation* found, const Setup& setup) {
  const SteppedRebound& at = *found->stepped;
  if (at.most - at.least > 1e-3) {
    found->warnings.push_back(fmt::format(
        "at this step the rebound is between {:.4f} and {:.4f}, as the touch falls in the step",
        at.least, at.most));
  }
  const bool implicit = found->tool->stepping == Stepping::kImplicitEuler ||
                        found->tool->stepping == Stepping::kSpeculative;
  if (implicit && at.mean < found->loaded.velocity_ratio - 0.01) WarnOfDampingStep(found, setup);
}

void WarnOfStep(Translation* found, const Setup& setup) {
  if (setup.step == 0) return;
  const double steps = found->alone.duration / setup.step;
  if (steps < kFewSteps) {
    found->warnings.push_back(fmt::format("a contact takes {:.2g} steps: too few", steps));
  }
  if (steps > kManySteps || found->tool->stepping == Stepping::kAccurate) return;
  found->stepped = Step(found->law, setup.collision, found->tool->stepping, setup.step);
  WarnOfStepped(found, setup);
}

void WarnOfPull(Translation* found) {
  if (found->alone.pull < 1e-3 * found->alone.peak_force) return;
  found->warnings.push_back(fmt::format("the force pulls before the bodies part, by up to {:.2g} %",
                                        100 * found->alone.pull / found->alone.peak_force));
}

// Fills what follows from the law.
void Measure(Translation* found, const Setup& setup) {
  found->alone = Collide(found->law, {setup.collision.mass, setup.collision.velocity});
  found->loaded = setup.collision.load > 0 ? Collide(found->law, setup.collision) : found->alone;
  WarnOfPull(found);
  WarnOfLoad(found, setup);
  WarnOfStep(found, setup);
  if (!found->tool->note.empty()) found->warnings.emplace_back(found->tool->note);
}

}  // namespace

std::string_view Missing(const Tool& tool, const Setup& setup) {
  if (tool.needs_radius && setup.radius == 0) return "radius";
  if (tool.needs_step && setup.step == 0) return "step";
  return {};
}

Translation Translate(const Tool& tool, const Wanted& wanted, const Setup& setup) {
  Translation found{.tool = &tool, .missing = Missing(tool, setup)};
  if (!found.missing.empty()) return found;
  const std::optional<double> damping = DampingFor(tool.law, wanted.restitution);
  if (!damping) {
    found.warnings.emplace_back("no damping gives back so little");
    return found;
  }
  found.law = LawFor(tool, *damping, wanted, setup);
  std::vector<double> values = tool.write(found.law, setup);
  if (std::ranges::any_of(values, [](double value) { return std::isnan(value); })) {
    found.warnings.emplace_back("its restitution has no value that gives back so little");
    return found;
  }
  found.values = std::move(values);
  found.textbook = ByTextbook(found, wanted, setup);
  Measure(&found, setup);
  return found;
}

bool CanJudge(const Tool& tool, const std::vector<double>& values, const Setup& setup) {
  const ForceLaw law = tool.read(tool.law, values, setup);
  return law.stiffness > 0 && std::isfinite(law.stiffness) && law.damping >= 0 &&
         law.damping <= kMostDamping * DampingUnit(law, setup.collision);
}

Translation Judge(const Tool& tool, std::vector<double> values, const Setup& setup) {
  Translation found{.tool = &tool, .values = std::move(values)};
  ForceLaw law = tool.law;
  law.full_depth = 0;
  found.law = tool.read(law, found.values, setup);
  Measure(&found, setup);
  return found;
}

Wanted WantedOf(const Translation& from) {
  return {.restitution = from.alone.velocity_ratio,
          .stiffness = from.law.stiffness,
          .exponent = from.law.exponent,
          .duration = from.alone.duration};
}

}  // namespace contact::translate
