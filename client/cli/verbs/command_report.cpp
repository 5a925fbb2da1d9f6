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
#include "cli/verbs/verbs.h"

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

// Draws until a drawing fails, such as without gnuplot; then says so once and draws no more.
class Drawer {
 public:
  template <class Make>
  void Draw(Make make) {
    if (failed_) return;
    try {
      make();
    } catch (const Failure& failure) {
      failed_ = true;
      fmt::print(stderr, "figures are not drawn: {}\n", failure.what());
    }
  }

 private:
  bool failed_ = false;
};

// The runs with their figures, and the figure of all of them together.
std::string MakePage(Client& client, const std::vector<std::string>& jobs,
                     const Settings& settings) {
  Drawer drawer;
  std::vector<RunPart> runs(jobs.size());
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    recordings.push_back(Read(client, jobs[i], settings));
    drawer.Draw([&] { runs[i].figures = DrawAll(recordings[i]); });
    KeepContactForces(&recordings[i]);
  }
  std::string overlay;
  drawer.Draw([&] { overlay = DrawTogether(recordings); });
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].recording = std::move(recordings[i]);
  return ReportPage(runs, overlay, client.server());
}

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  Client client = Connect(settings);
  const std::string page = MakePage(client, arguments.jobs, settings);
  WriteText(page, arguments.file);
  fmt::print(stderr, "{}  {} kB, opens offline\n", arguments.file, (page.size() + 999) / 1000);
  return ExitCode::kOk;
}

}  // namespace

void AddReport(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<ReportArguments>();
  line.SetKind(
          command.add_option("JOB", arguments->jobs, "One or more IDs; the first is the baseline"),
          ValueKind::kJob)
      ->required();
  AddDestination(line, command, "-f,--file", &arguments->file, "Where to")->capture_default_str();
  line.SetAction(command, arguments, Report);
}

}  // namespace contact::cli
