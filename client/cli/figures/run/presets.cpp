#include "cli/figures/run/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/figures/run/body_panels.h"
#include "cli/figures/run/contact_panels.h"
#include "cli/figures/run/iteration_panels.h"
#include "cli/figures/run/restitution_panels.h"
#include "cli/figures/run/run_curves.h"
#include "cli/figures/run/run_energy.h"
#include "wire/column_name.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;
using Panels = std::vector<Panel>;

constexpr char kCycleNote[] = "o start, × end of a contact cycle";

// Iterations of the cycles and in the window that are shown.
Panels Iterations(const RunCurves& run) {
  std::vector<v1::Iteration> shown;
  for (v1::Iteration pass : run.recording().iterations) {
    v1::Iteration all;
    all.mutable_unknowns()->Swap(pass.mutable_unknowns());
    for (const auto& unknown : all.unknowns()) {
      if (run.Shows(unknown.contact())) *pass.add_unknowns() = unknown;
    }
    const bool any = pass.unknowns_size() > 0 && run.InWindow(pass.start_time_s());
    if (any) shown.push_back(std::move(pass));
  }
  return IterationPanels(shown);
}

Panel Energy(const RunCurves& run) {
  Panel panel = run.OverTime("energy [J]");
  int colour = 0;
  for (const auto& [label, values] : MechanicalEnergy(run.scenario(), run.recording())) {
    run.AddCurve(values, label, colour++, Mark::kLine, &panel);
  }
  return panel;
}

struct Preset {
  const char* name;
  Panels (*make)(const RunCurves&);
  const char* note;  // What its marks mean.
};

const Preset kPresets[] = {
    {"position", [](const RunCurves& run) { return Panels{PositionPanel(run)}; }, kCycleNote},
    {"displacement", [](const RunCurves& run) { return Panels{DisplacementPanel(run)}; },
     kCycleNote},
    {"velocity", [](const RunCurves& run) { return Panels{VelocityPanel(run)}; }, kCycleNote},
    {"force", [](const RunCurves& run) { return Panels{ForcePanel(run)}; }, kCycleNote},
    {"deformation-velocity",
     [](const RunCurves& run) { return Panels{DeformationVelocityPanel(run)}; }, kCycleNote},
    {"hysteresis", [](const RunCurves& run) { return Panels{HysteresisPanel(run)}; }, kCycleNote},
    {"restitution", RestitutionPanels, "o asked for, × had"},
    {"iterations", Iterations, ""},
    {"energy", [](const RunCurves& run) { return Panels{Energy(run)}; }, ""},
};

Figure OfRun(const Recording& recording, Panels panels, const char* note) {
  Figure figure{.title = recording.job.scenario().title(),
                .panels = std::move(panels),
                .sources = {SourceOf(recording.job)}};
  bool marked = false;
  for (Panel& panel : figure.panels) {
    std::erase_if(panel.curves, [](const auto& curve) { return curve.x.empty(); });
    if (panel.curves.empty()) {
      throw Failure(ExitCode::kUsage, "this run has nothing to show there");
    }
    marked = marked || std::ranges::any_of(panel.curves, [](const auto& curve) {
               return curve.mark == Mark::kStart || curve.mark == Mark::kEnd;
             });
  }
  if (marked) figure.note = note;
  return figure;
}

const SampleColumn& RequireChannel(const Recording& recording, const std::string& name) {
  if (const SampleColumn* column = recording.Find(name)) return *column;
  std::vector<std::string_view> names;
  for (const SampleColumn& column : recording.columns) names.push_back(column.name);
  throw Failure(
      ExitCode::kUsage,
      WithHint(fmt::format("{} is no channel of this job", Quoted(name)), DidYouMean(name, names)));
}

}  // namespace

std::vector<std::string> PresetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

Figure PresetFigure(const std::string& preset, const Recording& recording, const FigurePart& part) {
  const Preset* const found = std::ranges::find(kPresets, preset, &Preset::name);
  return OfRun(recording, found->make(RunCurves(recording, part)), found->note);
}

Figure ChannelsFigure(const std::vector<std::string>& channels, const Recording& recording,
                      const FigurePart& part) {
  const RunCurves run(recording, part);
  Panels panels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const SampleColumn& column = RequireChannel(recording, channels[i]);
    const std::string label =
        ColumnHeader(boost::replace_all_copy(column.quantity, "_", " "), column.unit);
    auto panel = std::ranges::find(panels, label, &Panel::y_label);
    if (panel == panels.end()) panel = panels.insert(panels.end(), run.OverTime(label));
    run.AddCurve(column.values, column.name, static_cast<int>(i), Mark::kLine, &*panel);
  }
  return OfRun(recording, std::move(panels), "");
}

}  // namespace contact::cli
