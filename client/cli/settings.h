#pragma once

#include <chrono>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/client.h"
#include "cli/failure.h"
#include "cli/style.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// What is wrong with a setting that does not stand on the command line.
struct Problem {
  ExitCode code;
  std::string text;
};

/// The flags that every command has.
struct Settings {
  std::string profile;  ///< Section of the config files; empty: none.
  std::string server = "127.0.0.1:7070";
  std::string output = "table";
  bool wide = false;  ///< `output` is a table with all its columns.
  bool yaml = false;  ///< `output` is json, to be written as YAML.
  std::string color = "auto";
  std::string progress = "auto";
  bool taskbar_progress = false;
  std::string timeout;  ///< Empty: the default of the command.

  /// Where each comes from, by its key in config files: a flag, a variable, or `path:line`.
  /// Without an entry it is the default.
  std::map<std::string, std::string> origins;
  std::vector<Problem> problems;

  /// Throws Failure (kUsage) unless `output` is one of these.
  void RequireOutput(std::initializer_list<std::string_view> formats) const;

  Client Connect() const;

  /// When a command that follows a job gives up; none without `timeout`.
  std::optional<std::chrono::steady_clock::time_point> Deadline() const;

  ProgressForm Progress() const;
  bool TaskbarProgress() const;  ///< Of the terminal that messages go to.
  Style OutputStyle() const;     ///< Of the standard output.
  Style MessageStyle() const;    ///< Of the standard error.
};

/// What the command line asks for.
using Action = std::function<ExitCode()>;

/// Writes a JSON document to the standard output, as YAML where that is asked for.
void PrintJson(const std::string& json, const Settings& settings);

/// Writes a job to the standard output in the format asked for; its ledger has only `columns`,
/// unless there are none.
void PrintJob(const v1::Job& job, const Settings& settings,
              const std::vector<std::string>& columns = {});

/// The code for how a job ended: kOk also while it has not.
ExitCode Outcome(const v1::Job& job);

}  // namespace contact::cli
