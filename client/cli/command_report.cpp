#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "cli/commands.h"
#include "cli/drawing.h"
#include "cli/overlay.h"
#include "cli/presets.h"
#include "cli/run_report.h"
#include "cli/text_file.h"

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
      figure = DrawPreset(preset, recording);
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
    figure = DrawOverlay(runs, {});
  } catch (const Failure&) {
    return "";
  }
  return DrawThinned(std::move(figure));
}

std::vector<Recording> Read(Client& client, const ReportArguments& arguments,
                            const Settings& settings) {
  std::vector<Recording> recordings;
  for (const std::string& job : arguments.jobs) {
    recordings.push_back(ReadRecording(client, job, settings));
    if (recordings.back().job.has_sweep()) {
      throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep; see sweep export", job));
    }
  }
  return recordings;
}

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({"table"});
  Client client = settings.Connect();
  std::vector<Recording> recordings = Read(client, arguments, settings);
  std::vector<RunPart> runs(recordings.size());
  std::string overlay;
  try {
    overlay = DrawTogether(recordings);
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i].figures = DrawAll(recordings[i]);
  } catch (const Failure& failure) {  // Such as that gnuplot is not installed.
    fmt::print(stderr, "figures are not drawn: {}\n", failure.what());
  }
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
