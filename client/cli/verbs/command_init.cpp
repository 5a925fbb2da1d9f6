#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/message.h"
#include "cli/base/table.h"
#include "cli/input/sweep_file.h"
#include "cli/input/templates.h"
#include "cli/settings/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct InitArguments {
  std::string name;
  std::string file;
  bool list = false;
  bool force = false;
};

void WriteFile(const std::string& path, std::string_view text, bool force) {
  if (!force && std::filesystem::exists(path)) {
    throw Failure(ExitCode::kLocal, path + " exists already; --force replaces it");
  }
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot write {}: {}", path, std::generic_category().message(errno)));
  }
}

// Writes the scenario that a sweep names beside it, unless a file of this name exists.
void WriteBase(const Template& sweep, const std::string& path) {
  for (const Template& scenario : Templates()) {
    const std::string name = std::string(scenario.name) + ".yaml";
    if (sweep.text.find("\nbase: " + name) == std::string_view::npos) continue;
    const std::string base = std::filesystem::path(path).replace_filename(name).string();
    if (std::filesystem::exists(base)) continue;
    WriteFile(base, scenario.text, false);
    fmt::print("{}\n", base);
  }
}

void ListTemplates(const Settings& settings) {
  Table table({{"TEMPLATE"}, {"SHOWS"}});
  for (const Template& scenario : Templates()) {
    table.Add({std::string(scenario.name), std::string(scenario.shows)});
  }
  fmt::print("{}", table.Text(settings.OutputStyle()));
  Tell("Next:  contactctl init {}\n", Templates().front().name);
}

void WriteTemplate(const Template& scenario, const std::string& path, bool force) {
  WriteFile(path, scenario.text, force);
  fmt::print("{}\n", path);
  const bool sweep = IsSweep(std::string(scenario.text));
  if (sweep) WriteBase(scenario, path);
  Tell(
      "Next:  contactctl {} {}\n"
      "       contactctl schema {}  (beside it, for your editor)\n",
      sweep ? "sweep run" : "run", path,
      sweep ? "sweep > contact-sweep.schema.json" : "> contact.schema.json");
}

ExitCode Init(const InitArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  if (arguments.list || arguments.name.empty()) {
    ListTemplates(settings);
    return ExitCode::kOk;
  }
  const Template& scenario = FindTemplate(arguments.name);
  if (arguments.file == "-") {
    fmt::print("{}", scenario.text);
    return ExitCode::kOk;
  }
  WriteTemplate(scenario, arguments.file.empty() ? arguments.name + ".yaml" : arguments.file,
                arguments.force);
  return ExitCode::kOk;
}

}  // namespace

void AddInit(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<InitArguments>();
  AddOption(line, command, "TEMPLATE", &arguments->name, ValueKind::kTemplate,
            "Its name; without it all are listed");
  AddOption(line, command, "--file", &arguments->file, ValueKind::kFile,
            "Where to; - is the standard output");
  command.add_flag("--list", arguments->list, "List the templates");
  command.add_flag("--force", arguments->force, "Replace a file that exists");
  line.SetAction(command, arguments, Init);
}

}  // namespace contact::cli
