#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/base/text_file.h"
#include "cli/figures/drawing.h"
#include "cli/figures/picture_output.h"
#include "cli/figures/presets.h"
#include "cli/link/connect.h"
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

void Keep(const Figure& figure, const std::string& format, const PlotArguments& arguments,
          const std::string& path) {
  const fs::path folder = arguments.keep;
  std::error_code error;
  fs::create_directories(folder, error);
  WriteText(GnuplotScript(figure, Medium(format), path), folder / (arguments.preset + ".gp"));
  Draw(figure, "csv", folder / (arguments.preset + ".csv"));
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  const std::string format = PictureFormat(arguments.file, settings);
  Client client = Connect(settings);
  const Recording recording = ReadRecording(client, arguments.job, settings);
  const Figure figure = DrawPreset(arguments.preset, recording);
  const bool of_samples = !figure.panels.front().counted_x;
  if (const std::string note = CoarseSampling(recording); of_samples && !note.empty()) {
    fmt::print(stderr, "{}\n", note);
  }
  const bool drawn = format != "gp" && format != "csv";
  if (drawn && !arguments.keep.empty()) {
    Keep(figure, format, arguments, PicturePath(arguments.file, arguments.preset, settings));
  }
  WritePicture(figure, arguments.preset, arguments.file, settings);
  return ExitCode::kOk;
}

}  // namespace

void AddPlot(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<PlotArguments>();
  AddJob(line, command, &arguments->job);
  line.SetWords(command.add_option("PRESET", arguments->preset, "What to draw"), PresetNames())
      ->type_name("")
      ->required();
  line.SetKind(command.add_option("-f,--file", arguments->file,
                                  "Where to; without -o its ending tells the format, .tex being "
                                  "tikz. Default: PRESET.svg; txt is printed"),
               ValueKind::kFile);
  line.SetKind(command.add_option("--keep", arguments->keep,
                                  "Keep gnuplot's script and the data as CSV in this folder"),
               ValueKind::kDirectory);
  line.SetAction(command, arguments, Plot);
}

}  // namespace contact::cli
