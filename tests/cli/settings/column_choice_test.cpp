#include "cli/settings/column_choice.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;

const std::vector<Table::Column> kColumns = {{"JOB"}, {"CREATED (UTC)"}, {"STATE"}};

class ColumnChoiceTest : public testing::Test {
 protected:
  ColumnChoiceTest() { choice_.AddTo(line_, line_.app(), kColumns); }

  ExitCode CheckCode(const Settings& settings) const {
    try {
      choice_.Check(kColumns, settings);
      return ExitCode::kOk;
    } catch (const Failure& failure) {
      return failure.code();
    }
  }

  CommandLine line_{"A program."};
  ColumnChoice choice_;
};

TEST_F(ColumnChoiceTest, ColumnsKeepTheOrderAskedFor) {
  line_.app().parse("--columns state,job");
  EXPECT_THAT(choice_.names(), ElementsAre("state", "job"));
  EXPECT_THAT(choice_.OutputStyle(Settings()).columns, ElementsAre("state", "job"));
  EXPECT_EQ(CheckCode(Settings()), ExitCode::kOk);
}

TEST_F(ColumnChoiceTest, WithoutAChoiceEveryOutputWillDo) {
  Settings settings;
  settings.SetOutput("json");
  EXPECT_EQ(CheckCode(settings), ExitCode::kOk);
}

TEST_F(ColumnChoiceTest, ChosenColumnsNeedATableOrCsv) {
  line_.app().parse("--columns job");
  for (const auto& [output, code] : {std::pair("table", ExitCode::kOk),
                                     {"wide", ExitCode::kOk},
                                     {"csv", ExitCode::kOk},
                                     {"json", ExitCode::kUsage},
                                     {"name", ExitCode::kUsage}}) {
    Settings settings;
    settings.SetOutput(output);
    EXPECT_EQ(CheckCode(settings), code) << output;
  }
}

TEST_F(ColumnChoiceTest, HelpSpeaksOfCsvOnlyWhereItIsPrinted) {
  CommandLine line("A program.");
  ColumnChoice ledger;
  ledger.AddTo(line, line.app(), kColumns, false);
  const auto about = [](CommandLine& of) {
    return of.app().get_option("--columns")->get_description();
  };
  EXPECT_THAT(about(line), testing::StartsWith("Only these columns of the table, in"));
  EXPECT_THAT(about(line_), testing::StartsWith("Only these columns of the table or csv, in"));
}

TEST_F(ColumnChoiceTest, UnknownColumnIsRefused) {
  line_.app().parse("--columns job,owner");
  EXPECT_EQ(CheckCode(Settings()), ExitCode::kUsage);
}

TEST_F(ColumnChoiceTest, KnownColumnsAreOffered) {
  EXPECT_THAT(line_.WordsOf(*line_.app().get_option("--columns")),
              ElementsAre(kColumns[0].Name(), kColumns[1].Name(), kColumns[2].Name()));
}

}  // namespace
}  // namespace contact::cli
