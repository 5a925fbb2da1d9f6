#pragma once

#include <string>
#include <vector>

#include "cli/base/table.h"
#include "cli/settings/command_line.h"

namespace contact::cli {

/// The flag --columns of a command that prints a table.
class ColumnChoice {
 public:
  /// Adds the flag. Help and completion show `known`, the columns that the table always has. `csv`:
  /// the command prints csv too. This object must outlive the parsing.
  void AddTo(CommandLine& line, CLI::App& command, const std::vector<Table::Column>& known = {},
             bool csv = true);

  /// Throws Failure (kUsage) if a chosen column is not among `columns`, or if columns are chosen
  /// and the output is neither a table nor csv.
  void Check(const std::vector<Table::Column>& columns, const Settings& settings) const;

  /// The chosen columns, in the order asked for; empty: all.
  const std::vector<std::string>& names() const { return names_; }

  /// How to write the table to the standard output.
  Style OutputStyle(const Settings& settings) const;

 private:
  /// What has the columns, for messages.
  std::string what_ = "table";
  /// The values of --columns; empty without the flag.
  std::vector<std::string> names_;
};

}  // namespace contact::cli
