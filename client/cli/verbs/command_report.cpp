#include <fmt/format.h>

#include <memory>

#include "cli/base/files.h"
#include "cli/export/provenance.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/verbs/job/contactsim.h"
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

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  RequireWritable(arguments.file);
  std::vector<std::string> words = {"report", "--file=" + arguments.file, "--"};
  Client client = Connect(settings);
  for (const std::string& text : arguments.jobs) {
    const std::string name = FindJob(client, text);
    if (GetJob(client, name).has_sweep()) {
      throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep; see sweep export", text));
    }
    words.push_back(name);
  }
  BecomeContactsim(words, settings);
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
