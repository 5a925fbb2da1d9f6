#include "cli/settings/column_choice.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/base/failure.h"

namespace contact::cli {

void ColumnChoice::AddTo(CommandLine& line, CLI::App& command,
                         const std::vector<Table::Column>& known, bool csv) {
  if (csv) what_ = "table or csv";
  CLI::Option* option =
      command
          .add_option("--columns", names_,
                      fmt::format("Only these columns of the {}, in this order, however narrow the "
                                  "terminal",
                                  what_))
          ->type_name("COLUMN,…")
          ->delimiter(',')
          ->take_all()
          ->allow_extra_args(false);
  std::vector<std::string> names;
  for (const Table::Column& column : known) names.push_back(column.Name());
  if (!names.empty()) line.SuggestWords(option, names);
}

void ColumnChoice::Check(const std::vector<Table::Column>& columns,
                         const Settings& settings) const {
  if (names_.empty()) return;
  if (settings.output != OutputFormat::kTable && settings.output != OutputFormat::kCsv) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--columns are those of a {}; see --output", what_));
  }
  Table::RequireColumns(columns, names_);
}

Style ColumnChoice::OutputStyle(const Settings& settings) const {
  Style style = settings.OutputStyle();
  style.columns = names_;
  return style;
}

}  // namespace contact::cli
