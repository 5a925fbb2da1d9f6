#include "cli/figures/run/restitution_panels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;

constexpr double kLeastError = 1e-17;

// By contact and number of the group.
using Restitutions = std::map<std::pair<std::string, int>, double>;

Restitutions OfGroups(const v1::Job& job) {
  Restitutions had;
  for (const v1::Group& group : job.groups()) {
    had[{group.contact(), group.number()}] = group.restitution_out();
  }
  return had;
}

// Adds a point unless it is none: a law that is given has no restitution asked for.
void Add(double x, double y, Figure::Curve* curve) {
  if (std::isnan(y)) return;
  curve->x.push_back(x);
  curve->y.push_back(y);
}

}  // namespace

std::vector<Panel> RestitutionPanels(const RunCurves& run) {
  Panel coefficients{.x_label = "cycle, in order of its end",
                     .y_label = "energy restitution coefficient",
                     .counted_x = true,
                     .lowest_y = 0};
  Panel errors{
      .x_label = coefficients.x_label, .y_label = "|Δε|/ε [1]", .counted_x = true, .log_y = true};
  const Restitutions groups = OfGroups(run.recording().job);
  run.EachContact([&](const std::string& name, int colour) {
    Figure::Curve asked{name + " asked for", colour, Mark::kStart, {}, {}, false};
    Figure::Curve had{name, colour, Mark::kEnd, {}, {}};
    Figure::Curve error{name, colour, Mark::kEnd, {}, {}, false};
    run.EachCycle(name, [&](const v1::Cycle& cycle, int place) {
      const auto group = groups.find({name, cycle.group()});
      const double out = group == groups.end() ? RestitutionOf(cycle) : group->second;
      const double miss = RestitutionError(out, cycle.restitution_in());
      Add(place, cycle.restitution_in(), &asked);
      Add(place, out, &had);
      Add(place, std::isnan(miss) ? miss : std::max(miss, kLeastError), &error);
    });
    coefficients.curves.push_back(std::move(asked));
    coefficients.curves.push_back(std::move(had));
    errors.curves.push_back(std::move(error));
  });
  const bool any = std::ranges::any_of(errors.curves, [](const auto& c) { return !c.x.empty(); });
  std::vector<Panel> panels{std::move(coefficients)};
  if (any) panels.push_back(std::move(errors));
  return panels;
}

}  // namespace contact::cli
