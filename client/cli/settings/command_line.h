#pragma once

#include <CLI/App.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/settings.h"

namespace contact::cli {

/// What the value of an option names. Completion offers values by their kind, and help shows the
/// placeholder of the kind, such as JOB.
enum class ValueKind {
  kAny,           ///< Nothing is known about it.
  kWord,          ///< One of CommandLine::WordsOf.
  kJob,           ///< A job of the server.
  kChannel,       ///< A channel of the job that the line names.
  kContact,       ///< A contact of that job.
  kArtifact,      ///< An artifact of the job that the line names.
  kMetric,        ///< A metric of the sweep that the line names.
  kState,         ///< A state of jobs.
  kEventKind,     ///< A kind of events.
  kTemplate,      ///< A shipped scenario.
  kLaw,           ///< A damping law.
  kPaperItem,     ///< A figure or table of the paper.
  kConfigKey,     ///< A key of config files.
  kProfile,       ///< A profile of config files.
  kCommand,       ///< A command of contactctl.
  kResultWord,    ///< A word that contactctl explains, such as INFEASIBLE.
  kAssignment,    ///< FIELD=VALUE of the scenario that the line names.
  kScenarioFile,  ///< A YAML or JSON file.
  kFile,          ///< Any file.
  kDirectory,     ///< A folder.
};

/// The command line: verbs add their commands and flags to it, the parser fills the settings and
/// chooses the action. Not for use by several threads.
class CommandLine {
 public:
  /// `about` is the text of the help of the program.
  explicit CommandLine(const std::string& about);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The parser. Commands may keep references to it.
  CLI::App& app() { return app_; }
  const CLI::App& app() const { return app_; }

  /// The global flags. Their values are final when the action runs.
  Settings& settings() { return settings_; }
  const Settings& settings() const { return settings_; }

  /// What the parsed line asks for; empty if it names no command.
  const Action& action() const { return action_; }

  /// Makes `act` the action of a line that names `command`.
  void SetAction(CLI::App& command, Action act);

  /// The same for a function of the settings.
  void SetAction(CLI::App& command, ExitCode (*act)(const Settings&));

  /// The same for a function of the command's own arguments and the settings.
  template <class Arguments>
  void SetAction(CLI::App& command, std::shared_ptr<Arguments> arguments,
                 ExitCode (*act)(const Arguments&, const Settings&)) {
    SetAction(command, [this, arguments, act] { return act(*arguments, settings_); });
  }

  /// Declares what the value of `option` names. A flag has the kind's placeholder in the help,
  /// `WORD,…` if it is a list; a positional keeps its name. Returns `option`.
  CLI::Option* SetKind(CLI::Option* option, ValueKind kind);

  /// Declares that `option` takes one of `words`: kind kWord, and another word is a usage error
  /// that suggests the nearest one. Returns `option`.
  CLI::Option* SetWords(CLI::Option* option, const std::vector<std::string>& words);

  /// Declares words that help and completion show, although other values are valid. Returns
  /// `option`.
  CLI::Option* SuggestWords(CLI::Option* option, const std::vector<std::string>& words);

  /// The kind of values of an option; kAny if none was declared.
  ValueKind KindOf(const CLI::Option& option) const;

  /// The words of an option of kind kWord, else none.
  const std::vector<std::string>& WordsOf(const CLI::Option& option) const;

 private:
  /// What was declared about the values of an option.
  struct Values {
    ValueKind kind = ValueKind::kAny;
    std::vector<std::string> words;
  };

  CLI::App app_;
  Settings settings_;
  Action action_;
  /// By option. The options are those of app_, which outlives this map.
  std::map<const CLI::Option*, Values> values_;
};

/// Those of these flags of a command that the parsed line has, as words of a command line such as
/// `--from=0.1`.
std::vector<std::string> GivenFlags(const CLI::App& command, const std::vector<std::string>& names);

/// True if an option takes several values with commas between.
bool IsList(const CLI::Option& option);

/// Adds --server, --output and the other flags that every command has.
void AddGlobalFlags(CommandLine& line);

/// What may name a job, for the help; see FindJob.
inline constexpr char kJobAbout[] =
    "ID, or its first letters if only one job has them; last is the newest job, last~2 the second "
    "before it";

/// Adds the positional JOB, one that must be given.
void AddJob(CommandLine& line, CLI::App& command, std::string* job);

/// Adds a flag for the path that a command writes to, for commands that print in no other format:
/// `names`, such as `-f,--file`, and -o as a second spelling, which help does not show because -o
/// chooses the format elsewhere. The name of a format after -o is a usage error, so that `-o json`
/// makes no file of this name. Returns the flag.
CLI::Option* AddDestination(CommandLine& line, CLI::App& command, const std::string& names,
                            std::string* path, const std::string& about);

/// Adds the flags of a command that draws a figure: `-f,--file`, the path, of which `about` says
/// what it is by default; and a second spelling of the global -o, which takes a format, as it does
/// elsewhere, or a path that ends as a figure does. The help of -f tells both.
void AddFigureFile(CommandLine& line, CLI::App& command, std::string* path,
                   const std::string& about);

}  // namespace contact::cli
