#include "cli/figures/presets.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cli/base/failure.h"
#include "cli/figures/contact_panels.h"
#include "cli/figures/iteration_panels.h"
#include "cli/figures/run_curves.h"
#include "cli/figures/run_energy.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;
using Panels = std::vector<Panel>;

// A quantity of each body over time, with marks where the cycles of its contacts start and end.
Panel Bodies(const RunCurves& run, const std::string& quantity, const std::string& label) {
  Panel panel = run.OverTime(label);
  const Scenario& scenario = run.scenario();
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const int index = static_cast<int>(i);
    const std::string column = scenario.bodies[i].name + "." + quantity;
    run.AddColumn(column, scenario.bodies[i].name, index, Mark::kLine, &panel);
    for (const auto& contact : scenario.contacts) {
      if (contact.left != index && contact.right != index) continue;
      run.AddMarks(contact.name, column, index, &panel);
    }
  }
  return panel;
}

// A dotted line is where the centre of a body stands when the body touches its wall.
Panel Position(const RunCurves& run) {
  Panel panel = Bodies(run, "position", "position [m]");
  for (const auto& contact : run.scenario().contacts) {
    if (contact.left >= 0 && contact.right >= 0) continue;
    const bool right = contact.right < 0;
    const auto& body =
        run.scenario().bodies[static_cast<std::size_t>(right ? contact.left : contact.right)];
    panel.dotted_lines.push_back(contact.wall_position - (right ? body.radius : -body.radius));
  }
  return panel;
}

Panel Energy(const RunCurves& run) {
  Panel panel = run.OverTime("energy [J]");
  int colour = 0;
  for (auto& [label, values] : MechanicalEnergy(run.scenario(), run.recording())) {
    panel.curves.push_back({label, colour++, Mark::kLine, run.Column("time"), std::move(values)});
  }
  return panel;
}

using Make = Panels (*)(const RunCurves&);

const std::pair<const char*, Make> kPresets[] = {
    {"position", [](const RunCurves& run) { return Panels{Position(run)}; }},
    {"velocity",
     [](const RunCurves& run) { return Panels{Bodies(run, "velocity", "velocity [m/s]")}; }},
    {"force", [](const RunCurves& run) { return Panels{ForcePanel(run)}; }},
    {"deformation-velocity",
     [](const RunCurves& run) { return Panels{DeformationVelocityPanel(run)}; }},
    {"hysteresis", [](const RunCurves& run) { return Panels{HysteresisPanel(run)}; }},
    {"restitution", [](const RunCurves& run) { return Panels{RestitutionPanel(run)}; }},
    {"iterations",
     [](const RunCurves& run) { return IterationPanels(run.recording().iterations); }},
    {"energy", [](const RunCurves& run) { return Panels{Energy(run)}; }},
};

}  // namespace

std::vector<std::string> PresetNames() {
  std::vector<std::string> names;
  for (const auto& [name, make] : kPresets) names.emplace_back(name);
  return names;
}

Figure PresetFigure(const std::string& preset, const Recording& recording) {
  const auto* const found =
      std::ranges::find(kPresets, preset, [](const auto& entry) { return entry.first; });
  Figure figure{.title = recording.job.scenario().title(),
                .panels = found->second(RunCurves(recording)),
                .sources = {SourceOf(recording.job)}};
  for (Panel& panel : figure.panels) {
    std::erase_if(panel.curves, [](const auto& curve) { return curve.x.empty(); });
    if (panel.curves.empty()) {
      throw Failure(ExitCode::kUsage, "this run has nothing to show there");
    }
  }
  return figure;
}

}  // namespace contact::cli
