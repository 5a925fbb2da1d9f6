#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "cli/base/interrupt.h"
#include "cli/base/number.h"
#include "cli/base/scalar.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/text/live_plot.h"
#include "cli/text/print_job.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/text/render_live.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct WatchArguments {
  std::string job;
  std::uint64_t after_sequence = 0;
  std::vector<std::string> kinds;
  bool live_only = false;
  std::string min_frame_interval;
  std::vector<std::string> plot;
  std::string replay;
};

// Prints each event as a line of JSON, for programs.
class JsonLines : public WatchObserver {
 public:
  void OnEvent(const v1::Event& event) override {
    fmt::print("{}", ToJsonLine(event));
    std::fflush(stdout);
  }
  void OnLost(const std::string& why) override { TellLost(why); }
  void OnRegained() override { TellRegained(); }
};

WatchOptions Options(const std::string& name, const Settings& settings) {
  return {.name = name, .kinds = {}, .deadline = settings.Deadline(), .stopped = Interrupt::raised};
}

std::unique_ptr<WatchObserver> Observer(const std::string& name, const Settings& settings) {
  if (settings.output == OutputFormat::kJsonLines) return std::make_unique<JsonLines>();
  return std::make_unique<LiveView>(LiveView::Options{.rows_style = settings.OutputStyle(),
                                                      .messages_style = settings.MessageStyle(),
                                                      .job = ShortName(name),
                                                      .progress = settings.Progress()});
}

// The speed of a replay in simulated seconds a second, such as `1e-3x`; 0 for an empty text.
double ParseReplay(std::string_view text) {
  if (text.empty()) return 0;
  const auto speed = ParseNumber(text.substr(0, text.size() - (text.ends_with('x') ? 1 : 0)));
  if (speed && std::isfinite(*speed) && *speed > 0) return *speed;
  throw Failure(ExitCode::kUsage,
                fmt::format("--replay {}: must be a speed > 0 such as 1e-3x", text));
}

// Draws until the job ends, its replay is over or the user stops it. `mistake` receives why
// nothing can be drawn; none if something can.
WatchEnd DrawLive(Client& client, WatchOptions options, const WatchArguments& arguments,
                  double replay, std::optional<std::string>* mistake) {
  LivePlot plot(stdout, {arguments.plot, replay, TerminalHasUtf8()});
  options.stopped = [&plot] { return Interrupt::raised() || plot.mistake(); };
  const WatchEnd end = Watch(client, options, plot);
  plot.OnTick();
  while (plot.replaying() && !options.stopped()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    plot.OnTick();
  }
  *mistake = plot.mistake();
  return end;
}

ExitCode WatchPlot(const WatchArguments& arguments, const Settings& settings) {
  const double replay = ParseReplay(arguments.replay);
  if (isatty(STDOUT_FILENO) == 0) {
    throw Failure(ExitCode::kUsage,
                  "--plot draws on a terminal; contactctl plot draws files, contactctl series -o "
                  "csv prints the numbers");
  }
  Client client = Connect(settings);
  WatchOptions options = Options(FindJob(client, arguments.job), settings);
  options.kinds = {"attempt_started", "frame_chunk"};
  const Interrupt interrupt;
  std::optional<std::string> mistake;
  const WatchEnd end = DrawLive(client, options, arguments, replay, &mistake);
  if (mistake) throw Failure(ExitCode::kUsage, *mistake);
  return end == WatchEnd::kFinished ? CodeOf(GetJob(client, options.name))
                                    : Detach(end, options.name);
}

ExitCode WatchEvents(const WatchArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJsonLines});
  if (!arguments.plot.empty()) return WatchPlot(arguments, settings);
  if (!arguments.replay.empty()) throw Failure(ExitCode::kUsage, "--replay goes with --plot");
  Client client = Connect(settings);
  WatchOptions options = Options(FindJob(client, arguments.job), settings);
  options.after_sequence = arguments.after_sequence;
  options.kinds = arguments.kinds;
  options.live_only = arguments.live_only;
  if (!arguments.min_frame_interval.empty()) {
    options.min_frame_interval = RequireDuration(arguments.min_frame_interval);
  }
  if (options.kinds.empty() && settings.output == OutputFormat::kTable) {
    options.kinds = {"log_entry", "iteration",       "group_growth", "cycle",
                     "group",     "attempt_started", "progress"};
  }
  const Interrupt interrupt;
  const auto observer = Observer(options.name, settings);
  const WatchEnd end = Watch(client, options, *observer);
  if (end != WatchEnd::kFinished) return Detach(end, options.name);
  const v1::Job job = GetJob(client, options.name);
  observer->OnSnapshot(job);  // The last progress.
  return CodeOf(job);
}

ExitCode Wait(const std::string& job, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  const std::string name = FindJob(client, job);
  const WatchEnd end = AwaitEnd(client, name, settings);
  if (end != WatchEnd::kFinished) return Detach(end, name);
  const v1::Job result = GetJob(client, name);
  if (settings.output == OutputFormat::kTable) {
    fmt::print("{}  {}\n", result.name(), StateText(result.state(), "", settings.OutputStyle()));
  } else {
    PrintJob(result, settings);
  }
  return CodeOf(result);
}

}  // namespace

void AddWatch(CommandLine& line, CLI::App& watch) {
  auto arguments = std::make_shared<WatchArguments>();
  AddJob(line, watch, &arguments->job);
  watch.add_option("--after-sequence", arguments->after_sequence, "Only later events")
      ->type_name("N");
  AddListOption(line, watch, "--kinds", &arguments->kinds, ValueKind::kEventKind,
                "Only these, such as cycle,iteration");
  watch.add_flag("--live", arguments->live_only, "Only what happens from now on")
      ->excludes("--after-sequence");
  watch
      .add_option("--min-frame-interval", arguments->min_frame_interval,
                  "Leave out frame chunks that follow sooner than this; a gap tells of them")
      ->type_name("DURATION");
  AddListOption(line, watch, "--plot", &arguments->plot, ValueKind::kChannel,
                "Draw these channels on the terminal, such as B1.velocity,B1-B2.contact_force");
  watch.add_option("--replay", arguments->replay, "With --plot: simulated seconds in a second")
      ->type_name("SPEEDx");
  line.SetAction(watch, arguments, WatchEvents);
}

void AddWait(CommandLine& line, CLI::App& wait) {
  auto job = std::make_shared<std::string>();
  AddJob(line, wait, job.get());
  line.SetAction(wait, job, Wait);
}

}  // namespace contact::cli
