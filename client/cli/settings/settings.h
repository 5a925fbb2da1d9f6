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

/// What is wrong with a setting from a variable or a config file.
struct Problem {
  /// The exit code of a command that needs the settings.
  ExitCode code;
  /// What is wrong, with the name of the variable, or file and line.
  std::string text;
};

/// The values of the flags that every command has, and where they come from.
struct Settings {
  /// The section of config files that is used; empty: none.
  std::string profile;
  /// The address of the server, HOST:PORT.
  std::string server = "127.0.0.1:7070";
  /// Never kWide or kYaml: those are kTable with `wide` and kJson with `yaml`.
  OutputFormat output = OutputFormat::kTable;
  /// True to print all columns of a table.
  bool wide = false;
  /// True to print JSON as YAML.
  bool yaml = false;
  /// When to colour texts: auto, always or never; auto is on a terminal.
  std::string color = "auto";
  /// How to tell how far a job is: auto, bar, plain, json or none.
  std::string progress = "auto";
  /// A duration such as `10s`; empty: the default of the command.
  std::string timeout;
  /// Files by which client and server know each other, see CredentialsOf; each may be empty.
  std::string tls_ca;
  std::string cert;
  std::string key;
  std::string token_file;

  /// The origin of each value by its key in config files: a flag, a variable, or `path:line`. A
  /// value without an entry is the default.
  std::map<std::string, std::string> origins;
  /// What is wrong with variables and config files.
  std::vector<Problem> problems;

  /// Takes the value of -o: sets `output`, `wide` and `yaml`. Without effect for an unknown name.
  void SetOutput(std::string_view name);

  /// Throws Failure (kUsage) unless `output` is one of these formats. A command that prints
  /// kTable or kJson takes `wide` or `yaml`, too.
  void RequireOutput(const std::vector<OutputFormat>& formats) const;

  /// Throws Failure (kUsage) unless `output` is a format with this use.
  void RequireUse(FormatUse use) const;

  /// How long a call may take: `timeout`, else 10 s. Throws Failure (kUsage) if it is no duration.
  std::chrono::milliseconds CallTimeout() const;

  /// When a command that follows a job gives up, `timeout` from now; none without `timeout`. Throws
  /// Failure (kUsage) if it is no duration.
  std::optional<std::chrono::steady_clock::time_point> Deadline() const;

  /// How to tell on the standard error how far a job is.
  ProgressForm Progress() const;

  /// How to write to the standard output.
  Style OutputStyle() const;

  /// How to write to the standard error.
  Style MessageStyle() const;

 private:
  /// Throws what RequireOutput throws, with the names of the formats that would do.
  [[noreturn]] void RefuseOutput(const std::vector<std::string>& known) const;
};

/// What the command line asks for: runs the command and returns the exit code. May throw Failure.
using Action = std::function<ExitCode()>;

}  // namespace contact::cli
