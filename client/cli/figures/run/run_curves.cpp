#include "cli/figures/run/run_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/input/no_limits.h"

namespace contact::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// y at x between samples; `xs` ascends.
double Interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto next = std::ranges::lower_bound(xs, x);
  if (next == xs.end()) return ys.back();
  const auto i = static_cast<std::size_t>(next - xs.begin());
  if (i == 0) return ys.front();
  const double part = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + part * (ys[i] - ys[i - 1]);
}

void RequireContact(const Scenario& scenario, const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& contact : scenario.contacts) names.push_back(contact.name);
  if (std::ranges::find(names, name) != names.end()) return;
  throw Failure(
      ExitCode::kUsage,
      WithHint(fmt::format("{} is no contact of this job", Quoted(name)), DidYouMean(name, names)));
}

using Bands = std::vector<Figure::Band>;

// The bands in order, those that touch or overlap as one, so that no shade lies over another.
Bands Joined(Bands bands) {
  std::ranges::sort(bands, {}, &Figure::Band::start);
  Bands joined;
  for (const Figure::Band& band : bands) {
    if (joined.empty() || band.start > joined.back().end) {
      joined.push_back(band);
    } else {
      joined.back().end = std::max(joined.back().end, band.end);
    }
  }
  return joined;
}

}  // namespace

RunCurves::RunCurves(const Recording& recording, FigurePart part)
    : recording_(recording),
      scenario_(DecodeScenario(recording.job.scenario(), kNoLimits).scenario),
      part_(std::move(part)),
      from_(part_.from.value_or(-kInfinity)),
      to_(part_.to.value_or(kInfinity)) {
  for (const std::string& contact : part_.contacts) RequireContact(scenario_, contact);
  if (!(from_ < to_)) {
    throw Failure(ExitCode::kUsage, fmt::format("--from {} must be before --to {}", from_, to_));
  }
}

bool RunCurves::Shows(const std::string& contact) const {
  return part_.contacts.empty() ||
         std::ranges::find(part_.contacts, contact) != part_.contacts.end();
}

bool RunCurves::Shows(int body) const {
  return part_.contacts.empty() ||
         std::ranges::any_of(scenario_.contacts, [&](const auto& contact) {
           return (contact.left == body || contact.right == body) && Shows(contact.name);
         });
}

const std::vector<double>& RunCurves::Column(const std::string& name) const {
  const SampleColumn* column = recording_.Find(name);
  if (column != nullptr) return column->values;
  throw Failure(ExitCode::kUsage,
                fmt::format("this run recorded no {}; see output.ledger_only", name));
}

double RunCurves::At(const std::string& column, double time) const {
  return Interpolate(Column("time"), Column(column), time);
}

Figure::Panel RunCurves::OverTime(const std::string& label) const {
  Bands bands;
  const auto add = [&](const auto& stretch) {
    const double start = std::max(stretch.start_time_s(), from_);
    const double end = std::min(stretch.end_time_s(), to_);
    if (Shows(stretch.contact()) && start < end) bands.push_back({start, end});
  };
  for (const v1::Group& group : recording_.job.groups()) add(group);
  for (const v1::Cycle& cycle : recording_.job.cycles()) add(cycle);
  return {.x_label = "time [s]",
          .y_label = label,
          .bands = Joined(std::move(bands)),
          .band_label = "in contact"};
}

void RunCurves::AddCurve(const std::vector<double>& values, const std::string& label, int colour,
                         Figure::Mark mark, Figure::Panel* panel) const {
  const std::vector<double>& time = Column("time");
  Figure::Curve curve{label, colour, mark, {}, {}};
  const auto add = [&](double x, double y) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  };
  const auto begin = static_cast<std::size_t>(std::ranges::lower_bound(time, from_) - time.begin());
  const auto end = static_cast<std::size_t>(std::ranges::upper_bound(time, to_) - time.begin());
  // Where a window cuts the curve between two samples it has a point of its own.
  const bool before = begin > 0 && begin < time.size() && time[begin] > from_;
  const bool after = end > 0 && end < time.size() && time[end - 1] < to_;
  if (before) add(from_, Interpolate(time, values, from_));
  for (std::size_t i = begin; i < end; ++i) add(time[i], values[i]);
  if (after) add(to_, Interpolate(time, values, to_));
  panel->curves.push_back(std::move(curve));
}

void RunCurves::AddColumn(const std::string& name, const std::string& label, int colour,
                          Figure::Mark mark, Figure::Panel* panel) const {
  AddCurve(Column(name), label, colour, mark, panel);
}

void RunCurves::AddMarks(const std::string& contact, const std::string& name, int colour,
                         const OfCycle& at_start, const OfCycle& at_end,
                         Figure::Panel* panel) const {
  Figure::Curve starts{name + " starts", colour, Figure::Mark::kStart, {}, {}, false};
  Figure::Curve ends{name + " ends", colour, Figure::Mark::kEnd, {}, {}, false};
  const auto add = [&](double time, double value, Figure::Curve* curve) {
    if (!InWindow(time)) return;
    curve->x.push_back(time);
    curve->y.push_back(value);
  };
  EachCycle(contact, [&](const v1::Cycle& cycle, int) {
    add(cycle.start_time_s(), at_start(cycle), &starts);
    add(cycle.end_time_s(), at_end(cycle), &ends);
  });
  for (Figure::Curve* marks : {&starts, &ends}) {
    if (!marks->x.empty()) panel->curves.push_back(std::move(*marks));
  }
}

}  // namespace contact::cli
