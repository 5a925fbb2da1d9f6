#include "cli/figures/run/body_panels.h"

#include <cstddef>
#include <string>
#include <vector>

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;

// Adds marks to a curve of a body where the cycles of its contacts start and end. The curve is
// `offset` above the column.
void AddBodyMarks(const RunCurves& run, int body, const std::string& column, double offset,
                  Panel* panel) {
  for (const auto& contact : run.scenario().contacts) {
    if ((contact.left != body && contact.right != body) || !run.Shows(contact.name)) continue;
    const std::string& name = run.scenario().bodies[static_cast<std::size_t>(body)].name;
    run.AddMarks(
        contact.name, name + ", " + contact.name, body,
        [&](const v1::Cycle& cycle) { return run.At(column, cycle.start_time_s()) + offset; },
        [&](const v1::Cycle& cycle) { return run.At(column, cycle.end_time_s()) + offset; }, panel);
  }
}

// A quantity of each body over time, less what `origin` says of the body.
Panel Bodies(const RunCurves& run, const std::string& quantity, const std::string& label,
             double (*origin)(const Body&) = nullptr) {
  Panel panel = run.OverTime(label);
  const std::vector<Body>& bodies = run.scenario().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!run.Shows(index)) continue;
    const std::string column = bodies[i].name + "." + quantity;
    const double offset = origin == nullptr ? 0 : -origin(bodies[i]);
    std::vector<double> values = run.Column(column);
    for (double& value : values) value += offset;
    run.AddCurve(values, bodies[i].name, index, Mark::kLine, &panel);
    AddBodyMarks(run, index, column, offset, &panel);
  }
  return panel;
}

}  // namespace

Panel PositionPanel(const RunCurves& run) {
  Panel panel = Bodies(run, "position", "position [m]");
  panel.ranked_by_span = true;
  for (const auto& contact : run.scenario().contacts) {
    if ((contact.left >= 0 && contact.right >= 0) || !run.Shows(contact.name)) continue;
    const bool right = contact.right < 0;
    const auto& body =
        run.scenario().bodies[static_cast<std::size_t>(right ? contact.left : contact.right)];
    panel.dotted_lines.push_back(contact.wall_position - (right ? body.radius : -body.radius));
  }
  return panel;
}

Panel DisplacementPanel(const RunCurves& run) {
  return Bodies(run, "position", "displacement [m]",
                [](const Body& body) { return body.position; });
}

Panel VelocityPanel(const RunCurves& run) { return Bodies(run, "velocity", "velocity [m/s]"); }

}  // namespace contact::cli
