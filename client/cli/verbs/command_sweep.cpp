#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "cli/base/interrupt.h"
#include "cli/export/provenance.h"
#include "cli/figures/heat_map/heat_map_options.h"
#include "cli/input/grid_sweep.h"
#include "cli/input/sweep_file.h"
#include "cli/link/connect.h"
#include "cli/link/job_names.h"
#include "cli/link/job_source.h"
#include "cli/link/watch.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/job_options.h"
#include "cli/text/print_job.h"
#include "cli/text/render_live.h"
#include "cli/text/render_progress.h"
#include "cli/text/sweep/render_sweep.h"
#include "cli/verbs/follow.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct SweepArguments {
  std::string file;
  std::string job;
  std::vector<std::string> variables;  ///< --var
  std::vector<std::string> labels;
  std::string request_id;
  JobOptions settings;
  HeatMapOptions map;
  std::string heat_map;  ///< File to draw it to.
  bool comments = false;
  std::vector<std::string> grid;        ///< Axes over a scenario, instead of a sweep file.
  int random = 0, latin_hypercube = 0;  ///< Cells to draw from the axes.
  std::int64_t seed = 0;
  bool cancel_on_interrupt = false;
  ColumnChoice columns;
};

// Gathers cells, and tells how far the sweep is.
class CellWatcher final : public WatchObserver {
 public:
  CellWatcher(const std::string& job, const Settings& settings) : form_(settings.Progress()) {
    if (form_ == ProgressForm::kJson) json_progress_.emplace(stderr, ShortName(job));
  }
  ~CellWatcher() override { Erase(); }

  void OnSnapshot(const v1::Job& job) override {
    if (job.has_progress() && json_progress_) json_progress_->Update(job.progress());
  }
  void OnEvent(const v1::Event& event) override {
    if (event.has_sweep_cell()) cells_[event.sweep_cell().index()] = event.sweep_cell();
    if (event.has_progress()) Show(event.progress());
  }
  void OnLost(const std::string& why, std::chrono::milliseconds /*pause*/) override {
    Erase();
    fmt::print(stderr, "connection lost ({}); trying again\n", why);
  }
  const SweepCells& cells() const { return cells_; }

 private:
  void Show(const v1::Progress& progress) {
    if (json_progress_) json_progress_->Update(progress);
    const double done = PartDone(progress);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const std::string words = fmt::format(
        "{} of {} cells, {} failed, {} not converged{}", progress.cells_done(), progress.cells(),
        progress.cells_failed(), progress.cells_not_converged(), TimeLeft(done, elapsed.count()));
    const int tenths = static_cast<int>(10 * done);
    if (form_ == ProgressForm::kLines && tenths > std::exchange(told_tenths_, tenths)) {
      fmt::print(stderr, "{}\n", words);
    }
    if (form_ != ProgressForm::kBar) return;
    fmt::print(stderr, "\r\x1b[K{}", words);
    std::fflush(stderr);
    shown_ = true;
  }
  void Erase() {
    if (std::exchange(shown_, false)) fmt::print(stderr, "\r\x1b[K");
  }

  const ProgressForm form_;
  std::optional<JsonProgress> json_progress_;  ///< With ProgressForm::kJson.
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  SweepCells cells_;
  int told_tenths_ = 0;
  bool shown_ = false;
};

// Throws Failure (kUsage) unless the sweep has the metric and the columns that are named.
void CheckNames(const v1::Sweep& sweep, const SweepArguments& arguments, const Settings& settings) {
  arguments.map.MetricOf(sweep);
  arguments.columns.Check(
      settings.output == OutputFormat::kCsv ? SweepCsvColumns(sweep) : SweepColumns(sweep),
      settings);
}

void Print(const v1::Job& job, const SweepCells& cells, const SweepArguments& arguments,
           const Settings& settings) {
  if (settings.output == OutputFormat::kCsv) {
    fmt::print("{}{}", arguments.comments ? Lines({SourceOf(job)}, "# ") : "",
               SweepCsv(job.sweep(), cells, arguments.columns.names()));
  } else if (settings.output == OutputFormat::kJson) {
    PrintJson(SweepJson(job, cells), settings);
  } else if (settings.output == OutputFormat::kName) {
    fmt::print("{}\n", job.name());
  } else {
    const Style style = arguments.columns.OutputStyle(settings);
    fmt::print("{}{}", RenderSweep(job, cells, style),
               arguments.map.Text(job.sweep(), cells, style));
  }
}

// Gathers the cells of a sweep until it ends or the wait does. At the end `job` is the ended one.
WatchEnd Gather(Client& client, v1::Job* job, const Settings& settings, SweepCells* cells) {
  WatchOptions options;
  options.name = job->name();
  options.kinds = {"sweep_cell", "progress"};
  options.deadline = settings.Deadline();
  options.stopped = Interrupt::raised;
  CellWatcher watcher(job->name(), settings);
  const WatchEnd end = Watch(client, options, watcher);
  if (end == WatchEnd::kFinished) {
    *job = GetJob(client, job->name());
    watcher.OnSnapshot(*job);  // The last progress is always told.
  }
  *cells = watcher.cells();
  return end;
}

// Follows a sweep to its end, from its first cell on, and prints it.
ExitCode Follow(Client& client, const std::string& name, const SweepArguments& arguments,
                const Settings& settings) {
  const bool submitted = arguments.job.empty();
  v1::Job job = GetSweep(client, name);
  CheckNames(job.sweep(), arguments, settings);
  SweepCells cells;
  WatchEnd end = WatchEnd::kStopped;
  {
    const Interrupt interrupt;
    if (submitted && settings.output == OutputFormat::kTable) {
      fmt::print(stderr, "{} submitted\n", name);
    }
    end = Gather(client, &job, settings, &cells);
  }
  if (end != WatchEnd::kFinished) {
    return submitted ? DetachOrCancel(client, end, name, arguments.cancel_on_interrupt, settings)
                     : Detach(end, name);
  }
  if (!arguments.heat_map.empty()) arguments.map.Draw(job, cells, arguments.heat_map);
  Print(job, cells, arguments, settings);
  return CodeOf(job);
}

// The sweep of the file, or the scenario of the file with the axes of --grid.
v1::Sweep Open(const SweepArguments& arguments) {
  const VariableValues variables = ParseVariables(arguments.variables);
  if (arguments.grid.empty()) return OpenSweep(arguments.file, variables);
  const DrawnCells drawn{.count = std::max(arguments.random, arguments.latin_hypercube),
                         .latin_hypercube = arguments.latin_hypercube > 0,
                         .seed = arguments.seed};
  return MakeGrid(arguments.file, arguments.grid, arguments.map.metric(), drawn, variables);
}

v1::CreateJobRequest Request(const SweepArguments& arguments) {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_sweep() = Open(arguments);
  request.set_request_id(arguments.request_id.empty() ? RandomRequestId() : arguments.request_id);
  for (const auto& [key, value] : ParseLabels(arguments.labels)) {
    (*request.mutable_job()->mutable_labels())[key] = value;
  }
  arguments.settings.Apply(request.mutable_job());
  return request;
}

ExitCode Run(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson, OutputFormat::kName});
  const v1::CreateJobRequest request = Request(arguments);
  CheckNames(request.job().sweep(), arguments, settings);
  Client client = Connect(settings);
  const std::string name = client.CallTellingAll(&Client::Stub::CreateJob, request).name();
  const ExitCode code = Follow(client, name, arguments, settings);
  if (settings.output == OutputFormat::kTable) {
    fmt::print(stderr, "Next:  contactctl sweep export {} -o csv\n", ShortName(name));
  }
  return code;
}

ExitCode Show(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  return Follow(client, JobName(arguments.job), arguments, settings);
}

// Whatever became of the cells, they were printed.
ExitCode Export(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson});
  Client client = Connect(settings);
  const ExitCode code = Follow(client, JobName(arguments.job), arguments, settings);
  return code == ExitCode::kNotConverged || code == ExitCode::kRunFailed ? ExitCode::kOk : code;
}

// What the commands that print the cells of a sweep have in common.
void AddShowing(CommandLine& line, CLI::App& command,
                const std::shared_ptr<SweepArguments>& arguments,
                ExitCode (*act)(const SweepArguments&, const Settings&)) {
  arguments->map.AddTo(line, command);
  line.SetKind(command.add_option("--heatmap", arguments->heat_map,
                                  "Draw it to this file too, through gnuplot: .svg, .png, .pdf or "
                                  ".tex"),
               ValueKind::kFile);
  arguments->columns.AddTo(line, command);
  command.add_flag("--comments", arguments->comments,
                   "Begin csv with where it comes from, in lines that start with #");
  line.SetAction(command, arguments, act);
}

// Axes on the command line, instead of a sweep file.
void AddAxes(CLI::App& run, SweepArguments* arguments) {
  CLI::Option* grid =
      run.add_option("--grid", arguments->grid,
                     "Every value of this field with every one of the others, such as "
                     "contacts[*].restitution=0.5:0.9:5 or …=0.5,0.7; repeatable. --metric is "
                     "then what is computed, iterations unless given")
          ->type_name("FIELD=VALUES")
          ->take_all()
          ->allow_extra_args(false);
  CLI::Option* random =
      run.add_option("--random", arguments->random,
                     "So many cells with values drawn by chance, each axis of --grid as "
                     "FIELD=LOW:HIGH or FIELD=A,B,C")
          ->type_name("CELLS")
          ->check(CLI::Range(1, 1'000'000))
          ->needs(grid);
  run.add_option("--lhs", arguments->latin_hypercube,
                 "The same as a Latin hypercube, which covers every axis evenly")
      ->type_name("CELLS")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(grid)
      ->excludes(random);
  run.add_option("--seed", arguments->seed,
                 "Of the drawn values: the same seed, the same cells (default 0)")
      ->needs(grid);
}

void AddSubmission(CommandLine& line, CLI::App& run, SweepArguments* arguments) {
  line.SetKind(run.add_option("FILE", arguments->file,
                              "Sweep in YAML or JSON; - is the standard input. With --grid a "
                              "scenario"),
               ValueKind::kScenarioFile)
      ->required();
  AddVariableFlag(run, &arguments->variables);
  AddAxes(run, arguments);
  run.add_flag("--cancel-on-interrupt", arguments->cancel_on_interrupt,
               "A first Ctrl-C cancels the sweep instead of leaving it to the server");
  run.add_option("--label", arguments->labels, "Label of the job; repeatable")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  run.add_option("--request-id", arguments->request_id,
                 "The same id and sweep make one job, however often submitted")
      ->type_name("ID");
  arguments->settings.AddTo(run);
}

}  // namespace

void AddSweep(CommandLine& line, CLI::App& sweep) {
  sweep.require_subcommand(1);
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* run = sweep.add_subcommand("run", "Submit a sweep, watch it, show its cells");
  AddShowing(line, *run, arguments, Run);
  AddSubmission(line, *run, arguments.get());

  CLI::App* watch = sweep.add_subcommand("watch", "Follow a sweep to its end, show its cells");
  AddShowing(line, *watch, arguments, Show);
  AddJob(line, *watch, &arguments->job);

  CLI::App* cells =
      sweep.add_subcommand("export", "Print the cells of a sweep, with -o csv or json all of them");
  AddShowing(line, *cells, arguments, Export);
  AddJob(line, *cells, &arguments->job);

  AddSweepCell(line, sweep);
}

}  // namespace contact::cli
