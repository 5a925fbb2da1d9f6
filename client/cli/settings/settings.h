#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/base/failure.h"
#include "cli/base/style.h"
#include "cli/settings/format.h"

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
  OutputFormat output = OutputFormat::kTable;
  bool wide = false;  ///< `output` is a table with all its columns.
  bool yaml = false;  ///< `output` is json, to be written as YAML.
  std::string color = "auto";
  std::string progress = "auto";
  std::string timeout;  ///< Empty: the default of the command.

  /// Where each comes from, by its key in config files: a flag, a variable, or `path:line`.
  /// Without an entry it is the default.
  std::map<std::string, std::string> origins;
  std::vector<Problem> problems;

  /// Takes the value of -o: sets `output`, `wide` and `yaml`. Without effect for an unknown name.
  void SetOutput(std::string_view name);

  /// Throws Failure (kUsage) unless `output` is one of these formats. A command that prints
  /// kTable or kJson takes `wide` or `yaml`, too.
  void RequireOutput(const std::vector<OutputFormat>& formats) const;

  /// How long a call may take: `timeout`, or 10 s without.
  std::chrono::milliseconds CallTimeout() const;

  /// When a command that follows a job gives up; none without `timeout`.
  std::optional<std::chrono::steady_clock::time_point> Deadline() const;

  ProgressForm Progress() const;
  Style OutputStyle() const;   ///< Of the standard output.
  Style MessageStyle() const;  ///< Of the standard error.
};

/// What the command line asks for.
using Action = std::function<ExitCode()>;

}  // namespace contact::cli
