#include "cli/settings/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "base/spelling.h"

namespace contact::cli {
namespace {

// What stands for a value of this kind in the help; empty: what the option has.
std::string_view Placeholder(ValueKind kind) {
  static const std::map<ValueKind, std::string_view> kPlaceholders = {
      {ValueKind::kJob, "JOB"},           {ValueKind::kChannel, "NAME"},
      {ValueKind::kContact, "CONTACT"},   {ValueKind::kArtifact, "ARTIFACT"},
      {ValueKind::kMetric, "METRIC"},     {ValueKind::kState, "STATE"},
      {ValueKind::kEventKind, "KIND"},    {ValueKind::kTemplate, "TEMPLATE"},
      {ValueKind::kLaw, "LAW"},           {ValueKind::kPaperItem, "ITEM"},
      {ValueKind::kConfigKey, "KEY"},     {ValueKind::kProfile, "PROFILE"},
      {ValueKind::kCommand, "COMMAND"},   {ValueKind::kAssignment, "FIELD=VALUE"},
      {ValueKind::kScenarioFile, "FILE"}, {ValueKind::kFile, "FILE"},
      {ValueKind::kDirectory, "DIR"}};
  const auto found = kPlaceholders.find(kind);
  return found == kPlaceholders.end() ? std::string_view() : found->second;
}

// Braces, as the help of CLI11 shows a set.
std::string Braced(const std::vector<std::string>& words) {
  return fmt::format("{{{}}}", fmt::join(words, ","));
}

// The global flags about what is printed.
void AddPrinting(CommandLine& line) {
  CLI::App& app = line.app();
  Settings& settings = line.settings();
  CLI::Option* output = app.add_option_function<std::string>(
      "-o,--output", [&settings](const std::string& name) { settings.SetOutput(name); },
      fmt::format("How to print: {}. export writes {}; plot draws {}", FormatHelp(kPrinted),
                  FormatHelp(kData), FormatHelp(kFigure)));
  line.SetWords(output, FormatNames(kPrinted | kData | kFigure))
      ->type_name("FORMAT")
      ->default_str(std::string(NameOf(settings.output)));
  CLI::Option* color =
      app.add_option("--color", settings.color, "auto, always or never; NO_COLOR is heeded");
  line.SetWords(color, {"auto", "always", "never"})->type_name("WHEN")->capture_default_str();
  CLI::Option* progress =
      app.add_option("--progress", settings.progress,
                     "How to tell how far a job is: bar, plain (a line for each tenth), json (an "
                     "object a line, for programs) or none; auto is a bar on a terminal");
  line.SetWords(progress, {"auto", "bar", "plain", "json", "none"})
      ->type_name("HOW")
      ->capture_default_str();
}

// The files by which client and server know each other.
void AddCredentials(CommandLine& line) {
  CLI::App& app = line.app();
  Settings& settings = line.settings();
  const auto add = [&](const char* name, std::string* file, const char* about) {
    line.SetKind(app.add_option(name, *file, about), ValueKind::kFile);
  };
  add("--tls-ca", &settings.tls_ca, "Use TLS; the server's certificate is of these authorities");
  add("--cert", &settings.cert, "Certificate that shows the server who you are");
  add("--key", &settings.key, "Private key of --cert");
  add("--token-file", &settings.token_file, "File with a token that shows the server who you are");
}

// Takes the value of -o of a command that draws a figure.
void TakeFigureOutput(CommandLine& line, CLI::App& command, const std::string& value) {
  if (FormatOfFile(value, kFigure)) {
    command.get_option("--file")->add_result(value);
    return;
  }
  if (!FindFormat(value)) {
    const std::vector<std::string> formats = FormatNames(kFigure);
    throw CLI::ValidationError(
        "-o", WithHint(fmt::format("{} is neither one of {} nor a file that ends in {}", value,
                                   Braced(formats), FormatEndings(kFigure)),
                       DidYouMean(value, {formats.begin(), formats.end()})));
  }
  CLI::Option* output = line.app().get_option("--output");
  output->add_result(value);
  output->run_callback();
}

}  // namespace

CommandLine::CommandLine(const std::string& about) : app_(about, "contactctl") {
  app_.fallthrough();
  app_.require_subcommand(0, 1);  // So `schema sweep` is an argument, not the command sweep.
}

void CommandLine::SetAction(CLI::App& command, Action act) {
  command.callback([this, act = std::move(act)] { action_ = act; });
}

void CommandLine::SetAction(CLI::App& command, ExitCode (*act)(const Settings&)) {
  SetAction(command, [this, act] { return act(settings_); });
}

CLI::Option* CommandLine::SetKind(CLI::Option* option, ValueKind kind) {
  values_[option].kind = kind;
  const std::string_view placeholder = Placeholder(kind);
  if (!option->get_positional() && !placeholder.empty()) {
    option->type_name(fmt::format("{}{}", placeholder, IsList(*option) ? ",…" : ""));
  }
  return option;
}

CLI::Option* CommandLine::SetWords(CLI::Option* option, const std::vector<std::string>& words) {
  values_[option] = {ValueKind::kWord, words};
  const auto check = [words](const std::string& word) {
    if (std::ranges::find(words, word) != words.end()) return std::string();
    return WithHint(fmt::format("{} not in {}", word, Braced(words)),
                    DidYouMean(word, {words.begin(), words.end()}));
  };
  return option->check(CLI::Validator(check, Braced(words)));
}

CLI::Option* CommandLine::SuggestWords(CLI::Option* option, const std::vector<std::string>& words) {
  values_[option] = {ValueKind::kWord, words};
  const auto accept = [](const std::string&) { return std::string(); };
  return option->check(CLI::Validator(accept, Braced(words)));
}

ValueKind CommandLine::KindOf(const CLI::Option& option) const {
  const auto found = values_.find(&option);
  return found == values_.end() ? ValueKind::kAny : found->second.kind;
}

const std::vector<std::string>& CommandLine::WordsOf(const CLI::Option& option) const {
  static const std::vector<std::string> kNone;
  const auto found = values_.find(&option);
  return found == values_.end() ? kNone : found->second.words;
}

std::vector<std::string> GivenFlags(const CLI::App& command,
                                    const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) {
    const CLI::Option* option = command.get_option(name);
    const bool flag = option->get_items_expected_max() == 0;
    if (flag && option->count() > 0) words.push_back(name);
    if (flag) continue;
    for (const std::string& value : option->results()) words.push_back(name + "=" + value);
  }
  return words;
}

bool IsList(const CLI::Option& option) { return option.get_delimiter() == ','; }

void AddGlobalFlags(CommandLine& line) {
  CLI::App& app = line.app();
  Settings& settings = line.settings();
  app.add_option("--server", settings.server, "The server")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  AddCredentials(line);
  AddPrinting(line);
  app.add_option("--timeout", settings.timeout,
                 "Give up after this time. Default: 10s for a call, none for run, watch and wait")
      ->type_name("TIME");
  line.SetKind(app.add_option("--profile", settings.profile,
                              "Use the values of this section of config files"),
               ValueKind::kProfile);
}

void AddJob(CommandLine& line, CLI::App& command, std::string* job) {
  line.SetKind(command.add_option("JOB", *job, kJobAbout)->required(), ValueKind::kJob);
}

CLI::Option* AddDestination(CommandLine& line, CLI::App& command, const std::string& names,
                            std::string* path, const std::string& about) {
  const std::string name = names.substr(names.rfind(',') + 1);
  // Added before the flag, so that the parser runs the flag after it, with the value handed on.
  CLI::Option* alias =
      command.add_option_function<std::string>("-o", [&command, name](const std::string& value) {
        if (FindFormat(value)) {
          throw CLI::ValidationError("-o", fmt::format("{} prints no {}; {} says where to write",
                                                       command.get_name(), value, name));
        }
        command.get_option(name)->add_result(value);
      });
  alias->group("");
  line.SetKind(alias, ValueKind::kFile);
  return line.SetKind(command.add_option(names, *path, about), ValueKind::kFile);
}

void AddFigureFile(CommandLine& line, CLI::App& command, std::string* path,
                   const std::string& about) {
  // Added before --file, so that the parser runs that after it, with the value handed on.
  CLI::Option* output = command.add_option_function<std::string>(
      "-o,--output",
      [&line, &command](const std::string& value) { TakeFigureOutput(line, command, value); });
  line.SuggestWords(output, FormatNames(kFigure))->group("");
  line.SetKind(command.add_option("-f,--file", *path,
                                  about + ". The ending tells the format unless -o names one; -o "
                                          "with such a file is the same as -f"),
               ValueKind::kFile);
}

}  // namespace contact::cli
