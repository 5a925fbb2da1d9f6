#include "cli/figures/run_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cli/base/failure.h"
#include "cli/input/no_limits.h"

namespace contact::cli {
namespace {

// y at x between samples; `xs` ascends.
double Interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto next = std::ranges::lower_bound(xs, x);
  if (next == xs.end()) return ys.back();
  const auto i = static_cast<std::size_t>(next - xs.begin());
  if (i == 0) return ys.front();
  const double part = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + part * (ys[i] - ys[i - 1]);
}

}  // namespace

RunCurves::RunCurves(const Recording& recording)
    : recording_(recording),
      scenario_(DecodeScenario(recording.job.scenario(), kNoLimits).scenario) {}

const std::vector<double>& RunCurves::Column(const std::string& name) const {
  const SampleColumn* column = recording_.Find(name);
  if (column != nullptr) return column->values;
  throw Failure(ExitCode::kUsage,
                fmt::format("this run recorded no {}; see output.ledger_only", name));
}

Figure::Panel RunCurves::OverTime(const std::string& label) const {
  Figure::Panel panel{.x_label = "time [s]", .y_label = label};
  EachContact([&](const std::string& name, int colour) {
    for (const v1::Group& group : recording_.job.groups()) {
      if (group.contact() != name) continue;
      panel.bands.push_back({group.start_time_s(), group.end_time_s(), colour});
    }
    for (const v1::Cycle& cycle : recording_.job.cycles()) {
      if (cycle.contact() != name || cycle.group() > 0) continue;
      panel.bands.push_back({cycle.start_time_s(), cycle.end_time_s(), colour});
    }
  });
  return panel;
}

void RunCurves::AddColumn(const std::string& name, const std::string& label, int colour,
                          Figure::Mark mark, Figure::Panel* panel) const {
  panel->curves.push_back({label, colour, mark, Column("time"), Column(name)});
}

void RunCurves::AddMarks(const std::string& contact, const std::string& column, int colour,
                         Figure::Panel* panel) const {
  Figure::Curve starts{"", colour, Figure::Mark::kStart, {}, {}};
  Figure::Curve ends{"", colour, Figure::Mark::kEnd, {}, {}};
  for (const v1::Cycle& cycle : recording_.job.cycles()) {
    if (cycle.contact() != contact) continue;
    AddPoint(cycle.start_time_s(), column, &starts);
    AddPoint(cycle.end_time_s(), column, &ends);
  }
  if (starts.x.empty()) return;
  panel->curves.push_back(std::move(starts));
  panel->curves.push_back(std::move(ends));
}

void RunCurves::AddPoint(double time, const std::string& column, Figure::Curve* curve) const {
  curve->x.push_back(time);
  curve->y.push_back(Interpolate(Column("time"), Column(column), time));
}

}  // namespace contact::cli
