#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "cli/base/table.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// The flag --columns of commands that print a table.
class ColumnChoice {
 public:
  /// `known` are the columns that the table always has, for help and completion.
  void AddTo(CLI::App& command, const std::vector<Table::Column>& known = {});

  /// Throws Failure (kUsage) unless these columns have those that were asked for, and the output
  /// is a table or csv.
  void Check(const std::vector<Table::Column>& columns, const Settings& settings) const;

  const std::vector<std::string>& names() const { return names_; }

  /// How to write the table to the standard output.
  Style OutputStyle(const Settings& settings) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace contact::cli
