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
  std::string color = "auto";
  std::string progress = "auto";
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
  Style OutputStyle() const;   ///< Of the standard output.
  Style MessageStyle() const;  ///< Of the standard error.
};

/// What the command line asks for.
using Action = std::function<ExitCode()>;

/// Writes a job to the standard output in the format asked for.
void PrintJob(const v1::Job& job, const Settings& settings);

/// The code for how a job ended: kOk also while it has not.
ExitCode Outcome(const v1::Job& job);

}  // namespace contact::cli
