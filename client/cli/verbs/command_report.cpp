#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "cli/base/text_file.h"
#include "cli/figures/draw.h"
#include "cli/figures/overlay.h"
#include "cli/figures/presets.h"
#include "cli/figures/run_report.h"
#include "cli/link/connect.h"
#include "cli/verbs/commands.h"

namespace contact::cli {
namespace {

struct ReportArguments {
  std::vector<std::string> jobs;
  std::string file = "report.html";
};

// So that no peak and no corner is lost, and a page stays small however long the run.
std::string DrawThinned(Figure figure) {
  constexpr std::size_t kPoints = 1000;
  Thin(kPoints, &figure);
  figure.sources.clear();  // The page tells them.
  return DrawInline(figure);
}

// Presets that a run has nothing for are left out.
std::vector<std::string> DrawAll(const Recording& recording) {
  std::vector<std::string> figures;
  for (const std::string& preset : PresetNames()) {
    Figure figure;
    try {
      figure = PresetFigure(preset, recording);
    } catch (const Failure&) {
      continue;
    }
    figure.title = preset;
    figures.push_back(DrawThinned(std::move(figure)));
  }
  return figures;
}

// Nothing for runs that have not the same contacts.
std::string DrawTogether(const std::vector<Recording>& runs) {
  Figure figure;
  if (runs.size() == 1) return "";
  try {
    figure = OverlayFigure(runs, {});
  } catch (const Failure&) {
    return "";
  }
  return DrawThinned(std::move(figure));
}

Recording Read(Client& client, const std::string& job, const Settings& settings) {
  Recording recording = ReadRecording(client, job, settings);
  if (!recording.job.has_sweep()) return recording;
  throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep; see sweep export", job));
}

// All that is still to be drawn once a run has its own figures, which may be long.
void KeepContactForces(Recording* recording) {
  std::erase_if(recording->columns, [](const SampleColumn& column) {
    return column.name != "time" && !column.name.ends_with(".contact_force");
  });
}

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  Client client = Connect(settings);
  bool drawn = true;
  const auto draw = [&drawn](auto make) {
    if (!drawn) return;
    try {
      make();
    } catch (const Failure& failure) {  // Such as that gnuplot is not installed.
      drawn = false;
      fmt::print(stderr, "figures are not drawn: {}\n", failure.what());
    }
  };
  std::vector<RunPart> runs(arguments.jobs.size());
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    recordings.push_back(Read(client, arguments.jobs[i], settings));
    draw([&] { runs[i].figures = DrawAll(recordings[i]); });
    KeepContactForces(&recordings[i]);
  }
  std::string overlay;
  draw([&] { overlay = DrawTogether(recordings); });
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].recording = std::move(recordings[i]);
  const std::string page = ReportPage(runs, overlay, client.server());
  WriteText(page, arguments.file);
  fmt::print(stderr, "{}  {} kB, opens offline\n", arguments.file, (page.size() + 999) / 1000);
  return ExitCode::kOk;
}

}  // namespace

void AddReportCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Write one page about ended runs: ledgers, figures, balances, how to repeat them");
  command->add_option("JOB", arguments->jobs, "One or more IDs; the first is the baseline")
      ->required();
  command->add_option("-o,--file", arguments->file, "Where to")
      ->type_name("FILE")
      ->capture_default_str();
  command->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Report(*arguments, settings); };
  });
}

}  // namespace contact::cli
