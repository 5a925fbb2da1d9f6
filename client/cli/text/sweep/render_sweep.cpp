#include "cli/text/sweep/render_sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/text/sweep/sweep_cells.h"
#include "wire/sweep/axis_words.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostRows = 40;

std::string Title(const v1::Job& job, const Style& style) {
  const v1::Progress& progress = job.progress();
  std::string line = fmt::format("{}  {}  {} of {}", Paint(job.name(), Tone::kStrong, style),
                                 StateText(job.state(), job.state_reason(), style),
                                 progress.cells_done(), Count(progress.cells(), "cell", "cells"));
  if (progress.cells_failed() > 0) line += fmt::format(", {} failed", progress.cells_failed());
  if (progress.cells_not_converged() > 0) {
    line += fmt::format(", {} not converged", progress.cells_not_converged());
  }
  return Wrap(line + "\n", style);
}

// The last column of a cell: its convergence and what the end of the run cuts, or why it failed.
Table::Cell Verdict(const v1::SweepCell& cell) {
  if (cell.state() == v1::Job::FAILED) return {cell.state_reason(), Tone::kBad};
  const bool full = cell.convergence() == v1::Job::FULL;
  return {VerdictText(cell), full ? Tone::kGood : Tone::kWarning};
}

// Adds the values of the axes, see AxisText.
void AddValues(const v1::Sweep& sweep, const v1::SweepCell& cell, int digits,
               std::vector<Table::Cell>* row) {
  for (int i = 0; i < cell.values_size(); ++i) {
    row->emplace_back(AxisText(sweep.axes(i), cell.values(i), digits));
  }
}

// The columns of cell, axes and metrics. A narrow terminal leaves out metrics first.
std::vector<Table::Column> Quantities(const v1::Sweep& sweep) {
  std::vector<Table::Column> columns{{"CELL", true}};
  for (const v1::Sweep::Axis& axis : sweep.axes()) {
    columns.push_back({AxisName(axis), true, 0, AxisName(axis)});
  }
  for (const std::string& metric : sweep.metrics()) {
    columns.push_back({metric, true, static_cast<int>(columns.size()), metric});
  }
  return columns;
}

}  // namespace

std::string RenderSweep(const v1::Job& job, const SweepCells& cells, const Style& style) {
  Table table(SweepColumns(job.sweep()));
  for (const auto& [index, cell] : cells) {
    std::vector<Table::Cell> row{fmt::to_string(index)};
    AddValues(job.sweep(), cell, 6, &row);
    for (int i = 0; i < job.sweep().metrics_size(); ++i) row.emplace_back(MetricText(cell, i, 8));
    row.push_back(Verdict(cell));
    table.Add(std::move(row));
  }
  return Title(job, style) + ErrorLine(job, style) + "\n" +
         table.Text(style, kMostRows, "… {} more cells; -o csv prints all");
}

std::string SweepCsv(const v1::Sweep& sweep, const SweepCells& cells,
                     const std::vector<std::string>& columns) {
  Table table(SweepCsvColumns(sweep));
  for (const auto& [index, cell] : cells) {
    std::vector<Table::Cell> row{fmt::to_string(index)};
    AddValues(sweep, cell, 0, &row);
    for (int i = 0; i < sweep.metrics_size(); ++i) {
      const bool known = i < cell.metrics_size() && SourceWord(SourceOf(cell, i)).empty();
      row.emplace_back(known ? fmt::to_string(cell.metrics(i)) : "nan");
    }
    const bool failed = cell.state() == v1::Job::FAILED;
    row.emplace_back(v1::Job::State_Name(cell.state()));
    row.emplace_back(failed ? "" : v1::Job::Convergence_Name(cell.convergence()));
    row.emplace_back(failed ? cell.state_reason() + ": " + cell.message()
                            : UnknownMetrics(sweep, cell));
    table.Add(std::move(row));
  }
  return table.Csv(columns);
}

std::vector<Table::Column> SweepColumns(const v1::Sweep& sweep) {
  std::vector<Table::Column> columns = Quantities(sweep);
  columns.push_back({"VERDICT"});
  return columns;
}

std::vector<Table::Column> SweepCsvColumns(const v1::Sweep& sweep) {
  std::vector<Table::Column> columns = Quantities(sweep);
  for (const char* name : {"state", "convergence", "message"}) columns.push_back({name});
  return columns;
}

std::string SweepJson(const v1::Job& job, const SweepCells& cells) {
  using Json = nlohmann::ordered_json;
  std::vector<std::string> lines;
  for (const auto& [index, cell] : cells) {
    Json line{{"index", index}};  // ToJsonLine leaves out the index 0.
    line.update(Json::parse(ToJsonLine(cell)));
    lines.push_back(line.dump());
  }
  return fmt::format("{{\"job\": {}, \"cells\": [\n{}\n]}}\n", ToJson(job),
                     fmt::join(lines, ",\n"));
}

}  // namespace contact::cli
