#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/base/text_file.h"
#include "cli/figures/draw.h"
#include "cli/figures/gnuplot_script.h"
#include "cli/figures/run/presets.h"
#include "cli/figures/run/sampling.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/plot_options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::string job;
  std::string preset;
  std::vector<std::string> channels;
  std::string file;
  std::string keep;
  PlotOptions options;

  // What the figure is called: names files that the user does not name.
  std::string Name() const { return preset.empty() ? "channels" : preset; }
};

void RequireOneSubject(const PlotArguments& arguments) {
  if (arguments.preset.empty() != arguments.channels.empty()) return;
  throw Failure(
      ExitCode::kUsage,
      arguments.preset.empty()
          ? fmt::format("say what to draw: {}, or --channels", fmt::join(PresetNames(), ", "))
          : "PRESET and --channels do not go together: either says what to draw");
}

Figure MakeFigure(const PlotArguments& arguments, const Recording& recording) {
  const FigurePart& part = arguments.options.part();
  Figure figure = arguments.preset.empty() ? ChannelsFigure(arguments.channels, recording, part)
                                           : PresetFigure(arguments.preset, recording, part);
  arguments.options.Adapt(&figure);
  return figure;
}

void Keep(const Figure& figure, OutputFormat format, const PlotArguments& arguments,
          const FigureStyle& style, const std::string& path) {
  const fs::path folder = arguments.keep;
  std::error_code error;
  fs::create_directories(folder, error);
  const GnuplotTerminal terminal(format, GnuplotTerminal::kColumns, style);
  WriteText(GnuplotScript(figure, terminal, path), folder / (arguments.Name() + ".gp"));
  Draw(figure, OutputFormat::kCsv, folder / (arguments.Name() + ".csv"));
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  RequireOneSubject(arguments);
  const OutputFormat format = FigureFormat(arguments.file, settings);
  if (!arguments.file.empty()) RequireWritable(arguments.file);
  const FigureStyle style = arguments.options.Look();
  Client client = Connect(settings);
  const Recording recording = ReadRecording(client, FindJob(client, arguments.job), settings);
  const Figure figure = MakeFigure(arguments, recording);
  const bool of_samples = !figure.panels.front().counted_x;
  if (const std::string note = CoarseSampling(recording); of_samples && !note.empty()) {
    Tell("{}\n", note);
  }
  const bool drawn = format != OutputFormat::kGnuplot && format != OutputFormat::kCsv;
  if (drawn && !arguments.keep.empty()) {
    Keep(figure, format, arguments, style, FigurePath(arguments.file, arguments.Name(), settings));
  }
  WriteFigure(figure, arguments.Name(), arguments.file, settings, style);
  return ExitCode::kOk;
}

}  // namespace

void AddPlot(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<PlotArguments>();
  AddJob(line, command, &arguments->job);
  AddOption(line, command, "PRESET", &arguments->preset, PresetNames(), "What to draw")
      ->type_name("");
  AddFigureFile(line, command, &arguments->file, "Where to. Default: PRESET.svg; txt is printed");
  Repeatable(AddListOption(line, command, "--channels", &arguments->channels, ValueKind::kChannel,
                           "Instead of PRESET: these channels over time, such as B1.velocity, a "
                           "panel for each quantity"));
  arguments->options.AddTo(line, command);
  AddOption(line, command, "--keep", &arguments->keep, ValueKind::kDirectory,
            "Keep gnuplot's script and the data as CSV in this folder");
  line.SetAction(command, arguments, Plot);
}

}  // namespace contact::cli
