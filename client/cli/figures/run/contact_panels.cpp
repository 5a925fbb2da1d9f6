#include "cli/figures/run/contact_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "cli/figures/run/peak_labels.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;

bool IsCut(const v1::Cycle& cycle) { return cycle.end() == v1::Cycle::RUN_END; }

// The force of a contact where δ̇ or δ is 0, as at the ends of a cycle: that of the spring, and that
// of a damper which does not fade with δ.
double EndForce(const Scenario& scenario, int contact, const v1::Cycle& cycle, double deformation,
                double rate) {
  const auto& law = scenario.contacts[static_cast<std::size_t>(contact)];
  const double damper = DampingExponent(law.damping, law.exponent) == 0 ? cycle.mu() * rate : 0;
  const double force = law.stiffness * std::pow(std::max(deformation, 0.0), law.exponent) + damper;
  return scenario.solver.clip_tension ? std::max(force, 0.0) : force;
}

// The force where the cycles of a contact start and end, exactly but for a cycle that the end of
// the run cuts.
std::pair<RunCurves::OfCycle, RunCurves::OfCycle> EndForces(const RunCurves& run, int contact) {
  const auto at_start = [&run, contact](const v1::Cycle& cycle) {
    return EndForce(run.scenario(), contact, cycle, cycle.delta_start_m(),
                    cycle.approach_velocity_m_per_s());
  };
  const auto at_end = [&run, contact](const v1::Cycle& cycle) {
    if (IsCut(cycle)) return run.At(cycle.contact() + ".contact_force", cycle.end_time_s());
    return EndForce(run.scenario(), contact, cycle, cycle.delta_end_m(),
                    cycle.separation_velocity_m_per_s());
  };
  return {at_start, at_end};
}

// The loop of a cycle, without points if no sample is in it.
Figure::Curve Loop(const RunCurves& run, const v1::Cycle& cycle, int colour) {
  const std::vector<double>& time = run.Column("time");
  const std::vector<double>& deformation = run.Column(cycle.contact() + ".deformation");
  const std::vector<double>& force = run.Column(cycle.contact() + ".contact_force");
  const auto [start_force, end_force] = EndForces(run, colour);
  Figure::Curve loop{cycle.contact(), colour, Mark::kLine, {cycle.delta_start_m()}, {}};
  loop.y = {start_force(cycle)};
  const auto first = std::ranges::upper_bound(time, cycle.start_time_s());
  const auto last = std::ranges::lower_bound(time, cycle.end_time_s());
  if (first >= last) return {};
  for (auto at = first; at != last; ++at) {
    const auto i = static_cast<std::size_t>(at - time.begin());
    loop.x.push_back(deformation[i]);
    loop.y.push_back(force[i]);
  }
  loop.x.push_back(cycle.delta_end_m());
  loop.y.push_back(end_force(cycle));
  return loop;
}

// Adds a loop and where it starts and ends.
void AddLoop(Figure::Curve loop, Panel* panel) {
  const auto mark = [&loop](const char* name, Mark kind, double x, double y) {
    return Figure::Curve{loop.label + name, loop.colour, kind, {x}, {y}, false};
  };
  Figure::Curve start = mark(" starts", Mark::kStart, loop.x.front(), loop.y.front());
  Figure::Curve end = mark(" ends", Mark::kEnd, loop.x.back(), loop.y.back());
  panel->curves.push_back(std::move(loop));
  panel->curves.push_back(std::move(start));
  panel->curves.push_back(std::move(end));
}

}  // namespace

Panel ForcePanel(const RunCurves& run) {
  Panel panel = run.OverTime("force [N]");
  panel.dashed = "equivalent external";
  run.EachContact([&](const std::string& name, int colour) {
    run.AddColumn(name + ".contact_force", name, colour, Mark::kLine, &panel);
    run.AddColumn(name + ".external_force", name + " equivalent external", colour, Mark::kDashed,
                  &panel);
    const auto [at_start, at_end] = EndForces(run, colour);
    run.AddMarks(name, name, colour, at_start, at_end, &panel);
  });
  AddPeakLabels(run, &panel);
  return panel;
}

Panel DeformationVelocityPanel(const RunCurves& run) {
  Panel panel = run.OverTime("deformation velocity [m/s]");
  run.EachContact([&](const std::string& name, int colour) {
    const std::string column = name + ".deformation_velocity";
    run.AddColumn(column, name, colour, Mark::kLine, &panel);
    const auto at_end = [&](const v1::Cycle& cycle) {
      return IsCut(cycle) ? run.At(column, cycle.end_time_s())
                          : cycle.separation_velocity_m_per_s();
    };
    run.AddMarks(name, name, colour, &v1::Cycle::approach_velocity_m_per_s, at_end, &panel);
  });
  return panel;
}

Panel HysteresisPanel(const RunCurves& run) {
  Panel panel{.x_label = "deformation [m]", .y_label = "contact force [N]"};
  run.EachContact([&](const std::string& name, int colour) {
    bool first = true;  // It alone is in the key.
    run.EachCycle(name, [&](const v1::Cycle& cycle, int) {
      Figure::Curve loop = Loop(run, cycle, colour);
      if (loop.x.empty()) return;
      loop.keyed = std::exchange(first, false);
      if (!loop.keyed) loop.label = fmt::format("{} #{}", name, cycle.number());
      AddLoop(std::move(loop), &panel);
    });
  });
  return panel;
}

}  // namespace contact::cli
