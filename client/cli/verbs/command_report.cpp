#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "cli/base/message.h"
#include "cli/base/text_file.h"
#include "cli/export/citation.h"
#include "cli/figures/draw.h"
#include "cli/figures/overlay.h"
#include "cli/figures/run/presets.h"
#include "cli/figures/run_report.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/link/job_source.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

constexpr char kAboutCitation[] =
    R"(The first entry is the paper, the second the run or sweep. The same scenario, by its SHA-256, gives
the same bytes again with this version and revision of contactd.)";

struct ReportArguments {
  std::vector<std::string> jobs;
  std::string file = "report.html";
};

// Draws with few points, so that the page of a long run stays small; no peak or corner is lost.
std::string DrawThinned(Figure figure) {
  constexpr std::size_t kPoints = 500;
  Thin(kPoints, &figure);
  figure.sources.clear();  // The page names them.
  return DrawInline(figure);
}

// The figure that `make` makes; none if the runs have no data for it.
template <class Make>
std::optional<Figure> TryFigure(Make make) {
  try {
    return make();
  } catch (const Failure&) {
    return std::nullopt;
  }
}

// The figures of all presets for which the run has data.
std::vector<std::string> DrawAll(const Recording& recording) {
  std::vector<std::string> figures;
  for (const std::string& preset : PresetNames()) {
    if (preset == "displacement") continue;  // The page has the positions.
    std::optional<Figure> figure = TryFigure([&] { return PresetFigure(preset, recording); });
    if (!figure) continue;
    figure->title = preset;
    figures.push_back(DrawThinned(std::move(*figure)));
  }
  return figures;
}

// The contact forces of all runs in one figure; empty for one run or for different contacts.
std::string DrawTogether(const std::vector<Recording>& runs) {
  if (runs.size() == 1) return "";
  std::optional<Figure> figure = TryFigure([&] { return OverlayFigure(runs, {}); });
  return figure ? DrawThinned(std::move(*figure)) : "";
}

Recording Read(Client& client, const std::string& job, const Settings& settings) {
  Recording recording = ReadRecording(client, FindJob(client, job), settings);
  if (!recording.job.has_sweep()) return recording;
  throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep; see sweep export", job));
}

// Drops what only the figures of a run alone need, because trajectories may be long.
void KeepContactForces(Recording* recording) {
  std::erase_if(recording->columns, [](const SampleColumn& column) {
    return column.name != "time" && !column.name.ends_with(".contact_force");
  });
}

// The runs with their figures, and the figure of all of them together. Without gnuplot the page
// has no figures; a message says so once.
std::string MakePage(Client& client, const std::vector<std::string>& jobs,
                     const Settings& settings) {
  bool failed = false;
  const auto draw = [&failed](auto make) {
    try {
      if (!failed) make();
    } catch (const Failure& failure) {
      failed = true;
      Tell("figures are not drawn: {}\n", failure.what());
    }
  };
  std::vector<RunPart> runs(jobs.size());
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    recordings.push_back(Read(client, jobs[i], settings));
    draw([&] { runs[i].figures = DrawAll(recordings[i]); });
    KeepContactForces(&recordings[i]);
  }
  std::string overlay;
  draw([&] { overlay = DrawTogether(recordings); });
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].recording = std::move(recordings[i]);
  return ReportPage(runs, overlay, client.server());
}

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  Client client = Connect(settings);
  const std::string page = MakePage(client, arguments.jobs, settings);
  WriteText(page, arguments.file);
  Tell("{}  {} kB, opens offline\n", arguments.file, (page.size() + 999) / 1000);
  return ExitCode::kOk;
}

ExitCode Cite(const std::string& name, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  const v1::Job job = JobSource(settings).Get(name);
  if (job.spec_sha256().empty()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{} has no result to cite yet; see `contactctl wait`", job.name()));
  }
  fmt::print("{}", BibTeX(job));
  return ExitCode::kOk;
}

}  // namespace

void AddReport(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<ReportArguments>();
  AddOption(line, command, "JOB", &arguments->jobs, ValueKind::kJob,
            "One or more IDs; the first is the baseline")
      ->required();
  AddDestination(line, command, "-f,--file", &arguments->file, "Where to")->capture_default_str();
  line.SetAction(command, arguments, Report);
}

void AddCite(CommandLine& line, CLI::App& command) {
  command.footer(kAboutCitation);
  auto job = std::make_shared<std::string>();
  AddOption(line, command, "JOB", job.get(), ValueKind::kJob,
            "Its ID, or a file of describe -o json")
      ->required();
  line.SetAction(command, job, Cite);
}

}  // namespace contact::cli
