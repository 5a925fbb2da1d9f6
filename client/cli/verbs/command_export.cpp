#include <fmt/format.h>

#include <memory>

#include "base/spelling.h"
#include "cli/base/files.h"
#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/export/data_table.h"
#include "cli/export/sampling.h"
#include "cli/export/writers.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/link/recording.h"
#include "cli/settings/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct ExportArguments {
  std::string job;
  std::string file;
  std::string table = "series";
  bool comments = false;
  int precision = 0;  // Significant digits; 0: those that give the same double back.
  SeriesSelection part;
};

// The format that -o names, else the one that the file name tells, else CSV.
OutputFormat Format(const ExportArguments& arguments, const Settings& settings) {
  if (settings.output == OutputFormat::kTable) {
    return RequireFormatOfFile(arguments.file, kData, OutputFormat::kCsv);
  }
  settings.RequireUse(kData);
  return settings.output;
}

DataTable Chosen(const std::string& name, Recording&& recording) {
  if (name == "cycles") return CyclesTable(recording.job);
  if (name == "groups") return GroupsTable(recording.job);
  if (name == "iterations") return IterationsTable(recording.iterations);
  if (name == "bodies") return BodiesTable(recording.job);
  return SeriesTable(std::move(recording));
}

void WriteTable(const DataTable& table, const Provenance& source, TableWriter* write,
                const ExportArguments& arguments) {
  OutputFile file(arguments.file);
  if (arguments.comments) fmt::print(file.get(), "{}", CommentLines(source));
  write(table, file.get(), arguments.precision);
  file.Close();
}

// Writes all tables to one file. Returns in words how many samples and cycles it holds.
std::string WriteAll(Recording&& recording, const std::string& sampling, FileWriter* write,
                     const std::string& path) {
  const OutputFile writable(path);  // Fails with our message before the library does.
  const Provenance provenance = WithSampling(ProvenanceOf(recording.job), sampling);
  std::vector<DataTable> tables{CyclesTable(recording.job), GroupsTable(recording.job),
                                IterationsTable(recording.iterations), BodiesTable(recording.job)};
  tables.insert(tables.begin(), SeriesTable(std::move(recording)));
  write(tables, provenance, path);
  return fmt::format("{}, {}",
                     Count(static_cast<std::int64_t>(tables[0].rows()), "sample", "samples"),
                     Count(static_cast<std::int64_t>(tables[1].rows()), "cycle", "cycles"));
}

// Sets `sampling` to the note on the samples from which the part was taken.
Recording Read(Client& client, const std::string& job, const SeriesSelection& part,
               const Settings& settings, std::string* sampling) {
  Recording recording = ReadRecording(client, job, settings, part.max_points == 0);
  if (part.max_points > 0) {
    recording.columns = ThinnedSeries(client, job, part);
    *sampling = SamplingNote(client, job, part, settings);
  } else if (!recording.columns.empty()) {
    *sampling = SamplingNote(recording.job, recording.columns.front().values, part);
    Narrow(part, &recording.columns);
  }
  return recording;
}

// Which part of the series is written.
void AddPart(CommandLine& line, CLI::App& command, SeriesSelection* part) {
  AddListOption(line, command, "--channels", &part->channels, ValueKind::kChannel,
                "Only these columns of the series, such as B1.velocity,B1-B2.contact_force");
  command.add_option("--from,--t0", part->from, "Only samples from this simulated time on")
      ->type_name("SECONDS");
  command.add_option("--to,--t1", part->to, "Only samples up to this simulated time")
      ->type_name("SECONDS");
  AddCount(command, "--every", &part->every, "Keep one of N samples, beginning with the first");
  AddCount(command, "--max-points", &part->max_points,
           "At most N samples; the server chooses them so that no peak is lost");
}

void RequireUse(const ExportArguments& arguments, OutputFormat format) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw Failure(ExitCode::kUsage, what);
  };
  const bool text = TableWriterOf(format) != nullptr;
  const bool tables = text || FileWriterOf(format) != nullptr;
  const std::string_view name = NameOf(format);
  require(text || !arguments.file.empty(), fmt::format("{} is no text; give a file with -f", name));
  require(!text || arguments.table == "series" || arguments.part.empty(),
          "channels, time range and thinning are of the series");
  require(tables || arguments.part.empty(),
          fmt::format("{} has all that was recorded, no part of it", name));
  require(format == OutputFormat::kCsv || !arguments.comments, "--comments are of csv");
  require(text || arguments.precision == 0, "--precision is of csv and jsonl");
  require(arguments.part.max_points == 0 || arguments.part.every == 1,
          "--every and --max-points do not go together");
}

// Writes the job in the format. Returns in words how much that was.
std::string Write(const ExportArguments& arguments, OutputFormat format, const Settings& settings) {
  TableWriter* const table_writer = TableWriterOf(format);
  FileWriter* const file_writer = FileWriterOf(format);
  Client client = Connect(settings);
  const std::string job = FindJob(client, arguments.job);
  if (table_writer == nullptr && file_writer == nullptr) {  // protobuf: events instead of tables.
    return Count(WriteProtobuf(client, job, settings, arguments.file), "event", "events");
  }
  std::string sampling;
  Recording recording = Read(client, job, arguments.part, settings, &sampling);
  if (table_writer != nullptr && arguments.table != "series") sampling.clear();
  TellSampling(sampling, job);
  if (file_writer != nullptr) {
    return WriteAll(std::move(recording), sampling, file_writer, arguments.file);
  }
  const Provenance source = WithSampling(SourceOf(recording.job), sampling);
  const DataTable table = Chosen(arguments.table, std::move(recording));
  WriteTable(table, source, table_writer, arguments);
  return Count(static_cast<std::int64_t>(table.rows()), "row", "rows");
}

ExitCode Export(const ExportArguments& arguments, const Settings& settings) {
  const OutputFormat format = Format(arguments, settings);
  RequireUse(arguments, format);
  if (!arguments.file.empty()) RequireWritable(arguments.file);
  const std::string what = Write(arguments, format, settings);
  if (!arguments.file.empty()) Tell("{}  {}\n", arguments.file, what);
  return ExitCode::kOk;
}

}  // namespace

void AddExport(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<ExportArguments>();
  AddJob(line, command, &arguments->job);
  AddOption(line, command, "-f,--file", &arguments->file, ValueKind::kFile,
            fmt::format("Where to; without -o its ending tells the format: {}. Default: the "
                        "standard output",
                        FormatEndings(kData)));
  AddOption(line, command, "--table", &arguments->table,
            {"series", "cycles", "groups", "iterations", "bodies"},
            "For csv and jsonl: series, cycles, groups, iterations or bodies; the others have them "
            "all")
      ->type_name("TABLE")
      ->capture_default_str();
  command.add_flag("--comments", arguments->comments, kCommentsAbout);
  command
      .add_option("--precision", arguments->precision,
                  "Significant digits of csv and jsonl. Default: those that give the same number "
                  "back")
      ->check(CLI::Range(1, 17))
      ->type_name("N");
  AddPart(line, command, &arguments->part);
  line.SetAction(command, arguments, Export);
}

}  // namespace contact::cli
