#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/base/text_file.h"
#include "cli/figures/draw.h"
#include "cli/figures/gnuplot_script.h"
#include "cli/figures/presets.h"
#include "cli/figures/sampling.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::string job;
  std::string preset;
  std::string file;
  std::string keep;
};

void Keep(const Figure& figure, OutputFormat format, const PlotArguments& arguments,
          const std::string& path) {
  const fs::path folder = arguments.keep;
  std::error_code error;
  fs::create_directories(folder, error);
  WriteText(GnuplotScript(figure, GnuplotTerminal(format), path),
            folder / (arguments.preset + ".gp"));
  Draw(figure, OutputFormat::kCsv, folder / (arguments.preset + ".csv"));
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  const OutputFormat format = FigureFormat(arguments.file, settings);
  if (!arguments.file.empty()) RequireWritable(arguments.file);
  Client client = Connect(settings);
  const Recording recording = ReadRecording(client, FindJob(client, arguments.job), settings);
  const Figure figure = PresetFigure(arguments.preset, recording);
  const bool of_samples = !figure.panels.front().counted_x;
  if (const std::string note = CoarseSampling(recording); of_samples && !note.empty()) {
    Tell("{}\n", note);
  }
  const bool drawn = format != OutputFormat::kGnuplot && format != OutputFormat::kCsv;
  if (drawn && !arguments.keep.empty()) {
    Keep(figure, format, arguments, FigurePath(arguments.file, arguments.preset, settings));
  }
  WriteFigure(figure, arguments.preset, arguments.file, settings);
  return ExitCode::kOk;
}

}  // namespace

void AddPlot(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<PlotArguments>();
  AddJob(line, command, &arguments->job);
  AddOption(line, command, "PRESET", &arguments->preset, PresetNames(), "What to draw")
      ->type_name("")
      ->required();
  AddOption(line, command, "-f,--file", &arguments->file, ValueKind::kFile,
            "Where to; without -o its ending tells the format, .tex being tikz. Default: "
            "PRESET.svg; txt is printed");
  AddOption(line, command, "--keep", &arguments->keep, ValueKind::kDirectory,
            "Keep gnuplot's script and the data as CSV in this folder");
  line.SetAction(command, arguments, Plot);
}

}  // namespace contact::cli
