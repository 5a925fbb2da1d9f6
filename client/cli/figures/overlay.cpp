#include "cli/figures/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "cli/base/failure.h"
#include "cli/text/comparison/job_comparison.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostPanels = 3;
constexpr std::size_t kMostMeasuredPanels = 4;
constexpr std::size_t kMostParameters = 2;  // In a key.

std::vector<std::string> ContactForces(const Recording& run) {
  std::vector<std::string> channels;
  for (const SampleColumn& column : run.columns) {
    if (!column.name.ends_with(".contact_force")) continue;
    if (channels.size() < kMostPanels) channels.push_back(column.name);
  }
  if (!channels.empty()) return channels;
  throw Failure(ExitCode::kUsage, fmt::format("{} recorded no contact force", run.job.name()));
}

using Parameters = std::vector<JobComparison::Parameter>;

Parameters Differing(const std::vector<Recording>& runs) {
  std::vector<v1::Job> jobs;
  for (const Recording& run : runs) jobs.push_back(run.job);
  return Compare(jobs, {}).parameters;
}

std::string ValueOf(const JobComparison::Parameter& parameter, std::size_t run) {
  const std::string& value = parameter.values[run];
  return value.empty() ? "not set" : value;
}

// A run as the key names it: by the value of the one parameter in which the runs differ, which the
// title names; by a few parameters and its job; or by its job alone.
std::string Key(const Parameters& parameters, const std::vector<Recording>& runs, std::size_t run) {
  if (parameters.size() == 1) return ValueOf(parameters.front(), run);
  std::string key = runs[run].job.name();
  for (std::size_t p = 0; p < parameters.size() && p < kMostParameters; ++p) {
    key += fmt::format(", {} = {}", parameters[p].path, ValueOf(parameters[p], run));
  }
  return key;
}

const SampleColumn& Column(const Recording& run, const std::string& name) {
  if (const SampleColumn* column = run.Find(name)) return *column;
  throw Failure(ExitCode::kUsage, fmt::format("{} recorded no {}", run.job.name(), name));
}

// The times of all signals, with a tenth of their span before and after, on the clock of the run.
TimeRange Window(const std::vector<MeasuredSignal>& signals, double shift) {
  TimeRange window{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (const MeasuredSignal& signal : signals) {
    const auto [low, high] = std::ranges::minmax(signal.times);
    window = {std::min(window.low, low + shift), std::max(window.high, high + shift)};
  }
  const double margin = (window.high - window.low) / 10;
  return {window.low - margin, window.high + margin};
}

// A channel of the run within a window.
Figure::Curve Simulated(const Recording& run, const std::string& channel, const TimeRange& window) {
  const std::vector<double>& times = Column(run, "time").values;
  const std::vector<double>& values = Column(run, channel).values;
  const auto first = std::ranges::lower_bound(times, window.low) - times.begin();
  const auto last = std::ranges::upper_bound(times, window.high) - times.begin();
  return {.colour = 0,
          .x = {times.begin() + first, times.begin() + last},
          .y = {values.begin() + first, values.begin() + last}};
}

Figure::Curve Measured(const MeasuredSignal& signal, double shift) {
  Figure::Curve curve{
      .colour = 1, .mark = Figure::Mark::kPoints, .x = signal.times, .y = signal.values};
  for (double& time : curve.x) time += shift;
  return curve;
}

}  // namespace

Figure MeasuredFigure(const Recording& run, const std::vector<MeasuredSignal>& signals,
                      const SignalComparison& comparison) {
  Figure figure{.title = run.job.scenario().title(), .sources = {SourceOf(run.job)}};
  const TimeRange window = Window(signals, comparison.shift);
  for (const MeasuredSignal& signal : signals) {
    Figure::Panel panel{.x_label = "time [s]",
                        .y_label = fmt::format("{} [{}]", signal.channel, signal.unit)};
    panel.curves = {Simulated(run, signal.channel, window), Measured(signal, comparison.shift)};
    if (figure.panels.empty()) {  // All panels have the same key.
      panel.curves[0].label = run.job.name();
      panel.curves[1].label = comparison.file;
    }
    figure.panels.push_back(std::move(panel));
    if (figure.panels.size() == kMostMeasuredPanels) break;
  }
  return figure;
}

Figure OverlayFigure(const std::vector<Recording>& runs, const std::vector<std::string>& channels) {
  Figure figure{.title = runs.front().job.scenario().title()};
  const Parameters parameters = Differing(runs);
  if (parameters.size() == 1) figure.title += fmt::format(": {}", parameters.front().path);
  for (const std::string& channel : channels.empty() ? ContactForces(runs.front()) : channels) {
    const std::string& unit = Column(runs.front(), channel).unit;
    Figure::Panel panel{.x_label = "time [s]", .y_label = fmt::format("{} [{}]", channel, unit)};
    const bool keyed = figure.panels.empty();  // All panels have the same key.
    for (std::size_t i = 0; i < runs.size(); ++i) {
      panel.curves.push_back({keyed ? Key(parameters, runs, i) : "", static_cast<int>(i),
                              Figure::Mark::kLine, Column(runs[i], "time").values,
                              Column(runs[i], channel).values});
    }
    figure.panels.push_back(std::move(panel));
  }
  for (const Recording& run : runs) figure.sources.push_back(SourceOf(run.job));
  return figure;
}

}  // namespace contact::cli
