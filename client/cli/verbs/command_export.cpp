#include <fmt/format.h>

#include <memory>

#include "cli/base/number.h"
#include "cli/base/output_file.h"
#include "cli/export/data_table.h"
#include "cli/export/export_csv.h"
#include "cli/export/export_json_lines.h"
#include "cli/export/export_mat.h"
#include "cli/export/export_netcdf.h"
#include "cli/export/export_protobuf.h"
#include "cli/export/series_selection.h"
#include "cli/link/connect.h"
#include "cli/link/recording.h"
#include "cli/verbs/commands.h"

namespace contact::cli {
namespace {

struct ExportArguments {
  std::string job;
  std::string file;
  std::string table = "series";
  bool comments = false;
  int precision = 0;  ///< Significant digits; 0: those that give the same double back.
  SeriesSelection part;
};

// As -o says, or as the file is called.
OutputFormat Format(const ExportArguments& arguments, const Settings& settings) {
  if (settings.output != OutputFormat::kTable) {
    settings.RequireOutput({OutputFormat::kCsv, OutputFormat::kJsonLines, OutputFormat::kNetcdf,
                            OutputFormat::kMat, OutputFormat::kProtobuf});
    return settings.output;
  }
  return FormatOfFile(arguments.file, kData).value_or(OutputFormat::kCsv);
}

DataTable Chosen(const std::string& name, Recording&& recording) {
  if (name == "cycles") return CyclesTable(recording.job);
  if (name == "iterations") return IterationsTable(recording.iterations);
  if (name == "bodies") return BodiesTable(recording.job);
  return SeriesTable(std::move(recording));
}

void WriteText(const DataTable& table, const Provenance& source, OutputFormat format,
               const ExportArguments& arguments) {
  OutputFile file(arguments.file);
  if (arguments.comments) fmt::print(file.get(), "{}", Lines({source}, "# "));
  (format == OutputFormat::kJsonLines ? WriteJsonLines : WriteCsv)(table, file.get(),
                                                                   arguments.precision);
  file.Close();
}

// All tables in one file.
std::string WriteAll(Recording&& recording, OutputFormat format, const std::string& path) {
  const OutputFile writable(path);  // Told in our words, before those of the library.
  const Provenance provenance = ProvenanceOf(recording.job);
  std::vector<DataTable> tables{CyclesTable(recording.job), IterationsTable(recording.iterations),
                                BodiesTable(recording.job)};
  tables.insert(tables.begin(), SeriesTable(std::move(recording)));
  (format == OutputFormat::kMat ? WriteMat : WriteNetcdf)(tables, provenance, path);
  return fmt::format("{}, {}",
                     Count(static_cast<std::int64_t>(tables[0].rows()), "sample", "samples"),
                     Count(static_cast<std::int64_t>(tables[1].rows()), "cycle", "cycles"));
}

Recording Read(const ExportArguments& arguments, const Settings& settings) {
  const SeriesSelection& part = arguments.part;
  if (part.max_points > 0 && part.every > 1) {
    throw Failure(ExitCode::kUsage, "--every and --max-points do not go together");
  }
  Client client = Connect(settings);
  Recording recording = ReadRecording(client, arguments.job, settings, part.max_points == 0);
  if (part.max_points > 0) {
    recording.columns = ThinnedSeries(client, arguments.job, part);
  } else {
    Narrow(part, &recording.columns);
  }
  return recording;
}

void AddPart(CLI::App& command, SeriesSelection* part) {
  command
      .add_option("--channels", part->channels,
                  "Only these columns of the series, such as B1.velocity,B1-B2.contact_force")
      ->delimiter(',')
      ->type_name("NAME,…");
  command.add_option("--from,--t0", part->from, "Only samples from this simulated time on")
      ->type_name("SECONDS");
  command.add_option("--to,--t1", part->to, "Only samples up to this simulated time")
      ->type_name("SECONDS");
  command.add_option("--every", part->every, "Only the first of so many samples")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command
      .add_option("--max-points", part->max_points,
                  "At most so many samples, chosen by the server without losing a peak")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
}

bool IsText(OutputFormat format) {
  return format == OutputFormat::kCsv || format == OutputFormat::kJsonLines;
}

void RequireUse(const ExportArguments& arguments, OutputFormat format) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw Failure(ExitCode::kUsage, what);
  };
  const bool text = IsText(format);
  require(text || !arguments.file.empty(),
          fmt::format("{} is no text; give a file with -f", NameOf(format)));
  require(!text || arguments.table == "series" || arguments.part.empty(),
          "channels, time range and thinning are of the series");
  require(format != OutputFormat::kProtobuf || arguments.part.empty(),
          "protobuf has all that was recorded, no part of it");
  require(format == OutputFormat::kCsv || !arguments.comments, "--comments are of csv");
  require(text || arguments.precision == 0, "--precision is of csv and jsonl");
}

std::string WriteEvents(const ExportArguments& arguments, const Settings& settings) {
  Client client = Connect(settings);
  return Count(WriteProtobuf(client, arguments.job, settings, arguments.file), "event", "events");
}

std::string WriteTables(const ExportArguments& arguments, OutputFormat format,
                        const Settings& settings) {
  Recording recording = Read(arguments, settings);
  if (!IsText(format)) return WriteAll(std::move(recording), format, arguments.file);
  const Provenance source = SourceOf(recording.job);
  const DataTable table = Chosen(arguments.table, std::move(recording));
  WriteText(table, source, format, arguments);
  return Count(static_cast<std::int64_t>(table.rows()), "row", "rows");
}

ExitCode Export(const ExportArguments& arguments, const Settings& settings) {
  const OutputFormat format = Format(arguments, settings);
  RequireUse(arguments, format);
  const std::string what = format == OutputFormat::kProtobuf
                               ? WriteEvents(arguments, settings)
                               : WriteTables(arguments, format, settings);
  if (!arguments.file.empty()) fmt::print(stderr, "{}  {}\n", arguments.file, what);
  return ExitCode::kOk;
}

}  // namespace

void AddExportCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export",
      "Write what a job recorded, once it has ended: -o csv, jsonl, netcdf, mat or protobuf");
  command->add_option("JOB", arguments->job, "ID or jobs/ID")->required();
  command
      ->add_option("-f,--file", arguments->file,
                   "Where to; without -o its ending, .csv, .jsonl, .nc, .mat or .pb, tells the "
                   "format. Default: the standard output")
      ->type_name("FILE");
  command
      ->add_option(
          "--table", arguments->table,
          "For csv and jsonl: series, cycles, iterations or bodies; the others have them all")
      ->check(CLI::IsMember({"series", "cycles", "iterations", "bodies"}))
      ->type_name("TABLE")
      ->capture_default_str();
  command->add_flag("--comments", arguments->comments,
                    "Begin csv with where it comes from, in lines that start with #");
  command
      ->add_option("--precision", arguments->precision,
                   "Significant digits of csv and jsonl. Default: those that give the same number "
                   "back")
      ->check(CLI::Range(1, 17))
      ->type_name("N");
  AddPart(*command, &arguments->part);
  command->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Export(*arguments, settings); };
  });
}

}  // namespace contact::cli
