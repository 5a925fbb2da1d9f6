#include "cli/figures/heat_map/heat_map_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "cli/base/failure.h"
#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/export/provenance.h"
#include "cli/figures/draw.h"
#include "cli/figures/heat_map/heat_map.h"
#include "cli/figures/heat_map/sweep_line.h"
#include "cli/figures/provenance_stamp.h"
#include "cli/text/sweep/render_heat_map.h"

namespace contact::cli {
namespace {

// The format of a heat map by the ending of its file, svg without ending.
OutputFormat FormatOfMap(const std::string& path) {
  constexpr std::array kDrawn = {OutputFormat::kSvg, OutputFormat::kPng, OutputFormat::kPdf,
                                 OutputFormat::kTikz};
  if (std::filesystem::path(path).extension().empty()) return OutputFormat::kSvg;
  const std::optional<OutputFormat> format = FormatOfFile(path, kFigure);
  if (format && std::ranges::find(kDrawn, *format) != kDrawn.end()) return *format;
  throw Failure(ExitCode::kUsage,
                fmt::format("{}: a heat map is drawn as svg, png, pdf or tex", path));
}

}  // namespace

void HeatMapOptions::AddTo(CommandLine& line, CLI::App& command) {
  CLI::Option* metric = command.add_option(
      "--metric", metrics_, "What is drawn, of several the first. Default: that of the sweep");
  line.SetKind(metric->delimiter(',')->take_all()->allow_extra_args(false), ValueKind::kMetric);
  line.SetWords(
          command.add_option("--scale", scale_,
                             "Of the colours of the heat map, or the axis of the line: linear "
                             "or log, which does not show values <= 0"),
          {"linear", "log"})
      ->type_name("SCALE")
      ->capture_default_str();
  command.add_flag("--contour", contours_,
                   "Draw lines of equal value over the heat map in a file, between the cells that "
                   "converged");
}

int HeatMapOptions::MetricOf(const v1::Sweep& sweep) const {
  if (metrics_.empty()) return 0;
  const auto found = std::ranges::find(sweep.metrics(), metrics_.front());
  if (found != sweep.metrics().end()) {
    return static_cast<int>(found - sweep.metrics().begin());
  }
  throw Failure(ExitCode::kUsage,
                fmt::format("--metric {}: the sweep has none of this name", metrics_.front()));
}

std::string HeatMapOptions::Text(const v1::Sweep& sweep, const SweepCells& cells,
                                 const Style& style) const {
  return RenderHeatMap(sweep, cells, MetricOf(sweep), style, scale_ == "log");
}

void HeatMapOptions::RequireDrawable(const v1::Sweep& sweep, const std::string& path) const {
  MetricOf(sweep);
  if (sweep.axes_size() == 1) {
    FormatOfFigure(path);
  } else {
    FormatOfMap(path);
    RequireMap(sweep);
  }
  RequireWritable(path);
}

Figure HeatMapOptions::Line(const v1::Job& job, const SweepCells& cells) const {
  return SweepLineFigure(job, cells, MetricOf(job.sweep()), scale_ == "log");
}

void HeatMapOptions::Draw(const v1::Job& job, const SweepCells& cells,
                          const std::string& path) const {
  if (job.sweep().axes_size() == 1) {
    contact::cli::Draw(Line(job, cells), FormatOfFigure(path), path);
  } else {
    DrawMap(job, cells, path);
  }
  Tell("{}\n", path);
}

void HeatMapOptions::DrawMap(const v1::Job& job, const SweepCells& cells,
                             const std::string& path) const {
  const OutputFormat format = FormatOfMap(path);
  const HeatScale scale(cells, MetricOf(job.sweep()), scale_ == "log");
  DrawScript(HeatMapScript(job, cells, scale, contours_, GnuplotTerminal(format), path), path);
  StampProvenance(format, path, job.sweep().base().title(), {SourceOf(job)});
}

}  // namespace contact::cli
