#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/commands.h"
#include "cli/drawing.h"
#include "cli/presets.h"
#include "cli/text_file.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::string job;
  std::string preset;
  std::string file;
  std::string keep;
};

// As -o says, or as the file is called.
std::string Format(const PlotArguments& arguments, const Settings& settings) {
  if (settings.output != "table") {
    settings.RequireOutput({"svg", "png", "pdf", "txt", "tikz", "gp", "csv"});
    return settings.output;
  }
  return FormatOf(arguments.file);
}

void Keep(const Figure& figure, const std::string& format, const PlotArguments& arguments,
          const std::string& path) {
  const fs::path folder = arguments.keep;
  std::error_code error;
  fs::create_directories(folder, error);
  WriteText(GnuplotScript(figure, Medium(format), path), folder / (arguments.preset + ".gp"));
  Draw(figure, "csv", folder / (arguments.preset + ".csv"));
}

// Of a picture in characters: as wide as the terminal.
int Columns(const Settings& settings) {
  constexpr int kLeast = 40;
  const int width = settings.OutputStyle().width;
  return width > 0 ? std::max(width, kLeast) : Medium::kColumns;
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  const std::string format = Format(arguments, settings);
  const std::string path =
      arguments.file.empty() ? arguments.preset + "." + EndingOf(format) : arguments.file;
  Client client = settings.Connect();
  const Recording recording = ReadRecording(client, arguments.job, settings);
  const Figure figure = DrawPreset(arguments.preset, recording);
  const bool of_samples = !figure.panels.front().counted_x;
  if (const std::string note = CoarseSampling(recording); of_samples && !note.empty()) {
    fmt::print(stderr, "{}\n", note);
  }
  const bool drawn = format != "gp" && format != "csv";
  if (drawn && !arguments.keep.empty()) Keep(figure, format, arguments, path);
  const int columns = Columns(settings);
  if (format == "txt" && arguments.file.empty()) {
    fmt::print("{}", DrawText(figure, columns));
    return ExitCode::kOk;
  }
  Draw(figure, format, path, columns);
  fmt::print("{}\n", path);
  return ExitCode::kOk;
}

}  // namespace

void AddPlotCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = app.add_subcommand(
      "plot", "Draw a job that has ended, through gnuplot: -o svg, png, pdf, txt, tikz, gp or csv");
  command->add_option("JOB", arguments->job, "ID or jobs/ID")->required();
  command->add_option("PRESET", arguments->preset, "What to draw")
      ->check(CLI::IsMember(PresetNames()))
      ->type_name("")
      ->required();
  command
      ->add_option("-f,--file", arguments->file,
                   "Where to; without -o its ending tells the format, .tex being tikz. Default: "
                   "PRESET.svg; txt is printed")
      ->type_name("FILE");
  command
      ->add_option("--keep", arguments->keep,
                   "Keep gnuplot's script and the data as CSV in this folder")
      ->type_name("DIR");
  command->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Plot(*arguments, settings); };
  });
}

}  // namespace contact::cli
