#include "cli/verbs/sweep/heat_map_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/base/message.h"
#include "cli/input/no_limits.h"
#include "cli/settings/options.h"
#include "cli/text/sweep/render_heat_map.h"
#include "cli/text/sweep/sweep_grid.h"
#include "cli/verbs/job/contactsim.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

// Throws Failure (kUsage) unless the sweep, which breaks no rule, can be drawn as a map.
void RequireMap(const v1::Sweep& sweep) {
  constexpr std::int32_t kMostCells = 10'000;
  if (SweepGrid::IsGrid(sweep) && DecodeSweep(sweep, kNoLimits).axes.cells() <= kMostCells) return;
  throw Failure(
      ExitCode::kUsage,
      fmt::format("a heat map is of a grid of two axes with at most {} cells", kMostCells));
}

// Throws Failure (kUsage) for an ending of a format in which there are no heat maps.
void RequireMapEnding(const std::string& path) {
  constexpr std::array kDrawn = {OutputFormat::kSvg, OutputFormat::kPng, OutputFormat::kPdf,
                                 OutputFormat::kEps, OutputFormat::kPgf};
  if (std::filesystem::path(path).extension().empty()) return;
  const std::optional<OutputFormat> format = FormatOfFile(path, kFigure);
  if (format && std::ranges::find(kDrawn, *format) != kDrawn.end()) return;
  throw Failure(ExitCode::kUsage,
                fmt::format("{}: a heat map is drawn as svg, png, pdf, eps or pgf", path));
}

}  // namespace

void HeatMapOptions::AddTo(CommandLine& line, CLI::App& command) {
  Repeatable(AddListOption(line, command, "--metric", &metrics_, ValueKind::kMetric,
                           "What is drawn, of several the first. Default: that of the sweep"));
  AddOption(
      line, command, "--scale", &scale_, {"linear", "log"},
      "Of the colours of the heat map, or the axis of the line: linear or log, which does not "
      "show values <= 0")
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
    RequireFormatOfFile(path, kFigure, OutputFormat::kSvg);
  } else {
    RequireMapEnding(path);
    RequireMap(sweep);
  }
  RequireWritable(path);
}

std::vector<std::string> HeatMapOptions::Words(const std::string& job) const {
  std::vector<std::string> words = {"heatmap", job, "--scale=" + scale_};
  if (!metrics_.empty()) words.push_back("--metric=" + metrics_.front());
  if (contours_) words.emplace_back("--contour");
  return words;
}

void HeatMapOptions::Draw(const v1::Job& job, const std::string& path,
                          const Settings& settings) const {
  std::vector<std::string> words = Words(job.name());
  words.push_back("--file=" + path);
  RunContactsim(words, settings);
  Tell("{}\n", path);
}

}  // namespace contact::cli
