#include <fmt/format.h>

#include <memory>

#include "cli/help/contract/json_schema.h"
#include "cli/help/contract/reference.h"
#include "cli/text/print_job.h"
#include "cli/verbs/commands.h"

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

void AddSchemaCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<SchemaArguments>();
  CLI::App* schema =
      app.add_subcommand("schema", "Print the JSON Schema of a scenario file, for editors");
  schema->add_option("KIND", arguments->kind, "What of: a file, or what -o json prints")
      ->check(CLI::IsMember({"scenario", "sweep", "job"}))
      ->type_name("")
      ->capture_default_str();
  schema->add_flag("--markdown", arguments->markdown,
                   "Print the reference of scenario and sweep files as a page instead");
  schema->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Schema(*arguments, settings); };
  });
}

}  // namespace contact::cli
