#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/spelling.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/link/connect.h"
#include "cli/link/download.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"
#include "cli/settings/options.h"
#include "cli/text/render_json.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct ArtifactArguments {
  std::string job;
  std::string artifact;
  std::string file;
};

ExitCode ListArtifacts(const ArtifactArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJsonLines, OutputFormat::kName});
  Client client = Connect(settings);
  const v1::Job job = GetJob(client, FindJob(client, arguments.job));
  for (const v1::Artifact& artifact : job.artifacts()) {
    const bool json = settings.output == OutputFormat::kJsonLines;
    fmt::print("{}", json ? ToJsonLine(artifact) : artifact.name() + "\n");
  }
  return ExitCode::kOk;
}

ExitCode GetArtifact(const ArtifactArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  Client client = Connect(settings);
  const std::string path = arguments.file.empty()
                               ? std::filesystem::path(arguments.artifact).filename().string()
                               : arguments.file;
  const DownloadOptions options{.job = FindJob(client, arguments.job),
                                .artifact = arguments.artifact,
                                .path = path,
                                .deadline = settings.Deadline(),
                                .stopped = Interrupt::raised,
                                .lost = TellLost,
                                .regained = TellRegained};
  const Interrupt interrupt;
  const v1::Artifact artifact = Download(client, options);
  Tell("{}  {}\n", path, Count(artifact.size_bytes(), "byte", "bytes"));
  return ExitCode::kOk;
}

}  // namespace

void AddArtifact(CommandLine& line, CLI::App& group) {
  group.require_subcommand(1);
  auto arguments = std::make_shared<ArtifactArguments>();
  CLI::App* list = group.add_subcommand("list", "Name the artifacts of a job");
  AddJob(line, *list, &arguments->job);
  line.SetAction(*list, arguments, ListArtifacts);

  CLI::App* get =
      group.add_subcommand("get", "Fetch one, going on where an earlier try has left a part of it");
  AddJob(line, *get, &arguments->job);
  AddOption(line, *get, "ARTIFACT", &arguments->artifact, ValueKind::kArtifact,
            "Such as trajectory.csv")
      ->required();
  AddOption(line, *get, "-f,--file", &arguments->file, ValueKind::kFile,
            "Where to. Default: the last part of its name");
  line.SetAction(*get, arguments, GetArtifact);
}

}  // namespace contact::cli
