#include "cli/figures/heat_map/sweep_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/export/provenance.h"
#include "cli/text/sweep/heat_scale.h"
#include "cli/text/sweep/sweep_labels.h"
#include "wire/sweep/axis_words.h"

namespace contact::cli {
namespace {

// The cells in the order of their values on the axis.
std::vector<const v1::SweepCell*> InOrder(const SweepCells& cells) {
  std::vector<const v1::SweepCell*> ordered;
  for (const auto& [index, cell] : cells) ordered.push_back(&cell);
  std::ranges::stable_sort(ordered, {}, [](const auto* cell) { return cell->values(0); });
  return ordered;
}

// What the figure cannot show of the cells, and what its crosses are.
std::string Note(const SweepCells& cells, const HeatScale& scale, bool missed) {
  const auto failed = std::ranges::count_if(
      cells, [](const auto& entry) { return entry.second.state() == v1::Job::FAILED; });
  std::string note = missed ? "× not converged" : "";
  const auto add = [&note](const std::string& more) { note += note.empty() ? more : "; " + more; };
  if (failed > 0) add(Count(failed, "cell failed", "cells failed"));
  if (scale.cut() > 0) add(Count(scale.cut(), "cell", "cells") + " CUT by the end");
  if (scale.untouched() > 0) add(Count(scale.untouched(), "cell", "cells") + " without contact");
  if (scale.unshown() > 0) {
    add(Count(scale.unshown(), "value <= 0 not shown", "values <= 0 not shown"));
  }
  return note;
}

// The words that the values of an axis stand for; empty if they are numbers.
std::vector<std::pair<double, std::string>> WordsOf(const v1::Sweep::Axis& axis,
                                                    const Figure::Curve& line) {
  std::vector<std::pair<double, std::string>> words;
  for (const double x : line.x) {
    if (const auto word = AxisWord(axis, x); !word.empty()) words.emplace_back(x, word);
  }
  return words;
}

}  // namespace

Figure SweepLineFigure(const v1::Job& job, const SweepCells& cells, int metric, bool log) {
  const HeatScale scale(cells, metric, log);
  if (!(scale.low() <= scale.high())) {
    throw Failure(ExitCode::kUsage, fmt::format("no cell of this sweep has a {} to show",
                                                job.sweep().metrics(metric)));
  }
  Figure::Curve line{job.sweep().metrics(metric), 0, Figure::Mark::kLinePoints, {}, {}, false};
  Figure::Curve missed{"not converged", 1, Figure::Mark::kEnd, {}, {}, false};
  for (const v1::SweepCell* cell : InOrder(cells)) {
    const double value = scale.Shown(*cell);
    line.x.push_back(cell->values(0));
    line.y.push_back(value);
    if (std::isnan(value) || cell->convergence() == v1::Job::FULL) continue;
    missed.x.push_back(cell->values(0));
    missed.y.push_back(value);
  }
  const std::string note = Note(cells, scale, !missed.x.empty());
  Figure::Panel panel{.x_label = AxisLabel(job.sweep(), 0),
                      .y_label = MetricLabel(job.sweep().metrics(metric)),
                      .log_x = job.sweep().axes(0).has_log(),
                      .log_y = log,
                      .curves = {std::move(line)}};
  panel.x_words = WordsOf(job.sweep().axes(0), panel.curves.front());
  if (!missed.x.empty()) panel.curves.push_back(std::move(missed));
  return {.title = job.sweep().base().title(),
          .panels = {std::move(panel)},
          .sources = {SourceOf(job)},
          .note = note};
}

}  // namespace contact::cli
