#include "cli/figures/contact_panels.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "cli/figures/sampling.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;

constexpr std::size_t kMostLabels = 12;  // More would hide the curves.

void AddPeakLabels(const RunCurves& run, Panel* panel) {
  for (const v1::Cycle& cycle : run.recording().job.cycles()) {
    if (std::isnan(cycle.turn_time_s()) || panel->labels.size() == kMostLabels) continue;
    if (SamplesIn(cycle, run.Column("time")) < kFewSamples) continue;  // Its peak is not drawn.
    panel->labels.push_back({cycle.turn_time_s(), cycle.peak_force_n(),
                             fmt::format("μ/k = {:.4g} s/m", cycle.mu_over_k_s_per_m())});
  }
}

void AddLoop(const RunCurves& run, const v1::Cycle& cycle, const std::string& label, int colour,
             Panel* panel) {
  const std::vector<double>& time = run.Column("time");
  const std::vector<double>& deformation = run.Column(cycle.contact() + ".deformation");
  const std::vector<double>& force = run.Column(cycle.contact() + ".contact_force");
  Figure::Curve loop{label, colour, Mark::kLine, {}, {}};
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < cycle.start_time_s() || time[i] > cycle.end_time_s()) continue;
    loop.x.push_back(deformation[i]);
    loop.y.push_back(force[i]);
  }
  if (loop.x.empty()) return;
  panel->curves.push_back(loop);
  panel->curves.push_back({"", colour, Mark::kStart, {loop.x.front()}, {loop.y.front()}});
  panel->curves.push_back({"", colour, Mark::kEnd, {loop.x.back()}, {loop.y.back()}});
}

// By contact and number of the group.
using Restitutions = std::map<std::pair<std::string, int>, double>;

Restitutions OfGroups(const v1::Job& job) {
  Restitutions had;
  for (const v1::Group& group : job.groups()) {
    had[{group.contact(), group.number()}] = group.restitution_out();
  }
  return had;
}

}  // namespace

Panel ForcePanel(const RunCurves& run) {
  Panel panel = run.OverTime("force [N]");
  run.EachContact([&](const std::string& name, int colour) {
    run.AddColumn(name + ".contact_force", name, colour, Mark::kLine, &panel);
    run.AddColumn(name + ".external_force", name + " equivalent external", colour, Mark::kDashed,
                  &panel);
    run.AddMarks(name, name + ".contact_force", colour, &panel);
  });
  AddPeakLabels(run, &panel);
  return panel;
}

Panel DeformationVelocityPanel(const RunCurves& run) {
  Panel panel = run.OverTime("deformation velocity [m/s]");
  run.EachContact([&](const std::string& name, int colour) {
    run.AddColumn(name + ".deformation_velocity", name, colour, Mark::kLine, &panel);
    run.AddMarks(name, name + ".deformation_velocity", colour, &panel);
  });
  return panel;
}

Panel HysteresisPanel(const RunCurves& run) {
  Panel panel{.x_label = "deformation [m]", .y_label = "contact force [N]"};
  run.EachContact([&](const std::string& name, int colour) {
    std::string label = name;  // Of its first loop alone.
    for (const v1::Cycle& cycle : run.recording().job.cycles()) {
      if (cycle.contact() == name) AddLoop(run, cycle, std::exchange(label, ""), colour, &panel);
    }
  });
  return panel;
}

Panel RestitutionPanel(const RunCurves& run) {
  Panel panel{.x_label = "cycle, in order of its end",
              .y_label = "energy restitution coefficient",
              .counted_x = true,
              .lowest_y = 0};
  const Restitutions groups = OfGroups(run.recording().job);
  run.EachContact([&](const std::string& name, int colour) {
    Figure::Curve asked{name + " asked for", colour, Mark::kStart, {}, {}};
    Figure::Curve had{name + " had", colour, Mark::kEnd, {}, {}};
    double place = 0;
    for (const v1::Cycle& cycle : run.recording().job.cycles()) {
      ++place;
      if (cycle.contact() != name) continue;
      asked.x.push_back(place);
      asked.y.push_back(cycle.restitution_in());
      had.x.push_back(place);
      const auto group = groups.find({name, cycle.group()});
      had.y.push_back(group == groups.end() ? cycle.restitution_out() : group->second);
    }
    panel.curves.push_back(std::move(asked));
    panel.curves.push_back(std::move(had));
  });
  return panel;
}

}  // namespace contact::cli
