#include <fmt/format.h>

#include <memory>

#include "cli/help/contract/json_schema.h"
#include "cli/help/contract/reference.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct SchemaArguments {
  std::string kind = "scenario";
  bool markdown = false;
};

ExitCode Schema(const SchemaArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  const Contract contract;
  if (arguments.markdown) {
    fmt::print("{}", ReferenceInMarkdown(ScenarioReference(contract)));
  } else {
    PrintJson(JsonSchema(contract, arguments.kind), settings);
  }
  return ExitCode::kOk;
}

}  // namespace

void AddSchema(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<SchemaArguments>();
  AddOption(line, command, "KIND", &arguments->kind, {"scenario", "sweep", "job"},
            "What to describe: a scenario file, a sweep file, or the job that -o json prints")
      ->type_name("")
      ->capture_default_str();
  command.add_flag("--markdown", arguments->markdown,
                   "Print the reference of scenario and sweep files as a page instead");
  line.SetAction(command, arguments, Schema);
}

}  // namespace contact::cli
