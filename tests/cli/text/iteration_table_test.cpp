#include <gmock/gmock.h>

#include "cli/text/render_live.h"
#include "cli/text/render_progress.h"

namespace contact::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

v1::Iteration::Unknown Unknown() {
  v1::Iteration::Unknown unknown;
  unknown.set_contact("B1-B2");
  unknown.set_mu(2.25e8);
  unknown.set_restitution_in(0.8);
  unknown.set_restitution_out(0.79);
  unknown.set_bracket_low(1e8);
  return unknown;
}

TEST(IterationTable, ColumnsStandBelowTheirHeaders) {
  const std::string header = IterationHeader({});
  const std::string row = IterationRow({}, Unknown(), {});
  EXPECT_EQ(row.find("B1-B2"), header.find("CONTACT"));
  EXPECT_EQ(Width(header.substr(0, header.find("NEXT"))),
            Width(row.substr(0, row.find_last_of('-'))));
}

TEST(IterationTable, WideTablesHaveTheBracketWithItsOpenSide) {
  EXPECT_THAT(IterationRow({}, Unknown(), {.wide = true}), EndsWith("[100000000, -]"));
  EXPECT_THAT(IterationRow({}, Unknown(), {}), Not(HasSubstr("[")));
  EXPECT_THAT(IterationHeader({.wide = true}), EndsWith("BRACKET OF μ"));
}

TEST(IterationTable, WideTerminalsHaveTheBracketToo) {
  EXPECT_THAT(IterationHeader({.width = 120}), EndsWith("BRACKET OF μ"));
  EXPECT_THAT(IterationHeader({.width = 119}), EndsWith("NEXT"));
}

TEST(IterationTable, RowsFitIntoEveryTerminalOfFortyColumnsOrMore) {
  v1::Iteration::Unknown unknown = Unknown();
  unknown.set_contact("the-longest-name-of-any-contact");
  unknown.set_mu(1.23456789e-100);
  unknown.set_update(v1::Iteration::PAPER_NEWTON);
  for (const int width : {40, 59, 60, 79}) {
    const std::string header = IterationHeader({.width = width});
    const std::string row = IterationRow({}, unknown, {.width = width});
    EXPECT_LE(Width(row), width);
    EXPECT_LE(Width(header), width);
    EXPECT_EQ(row.find("the-longe"), header.find("CONTACT")) << width;
    EXPECT_EQ(Width(row), Width(header)) << width;
  }
}

TEST(IterationTable, SaysWhatComesNext) {
  v1::Iteration pass;
  v1::Iteration::Unknown unknown = Unknown();
  EXPECT_THAT(IterationRow(pass, unknown, {}), EndsWith("  -"));
  unknown.set_update(v1::Iteration::BISECTION);
  EXPECT_THAT(IterationRow(pass, unknown, {}), EndsWith("  BISECTION"));
  pass.set_accepted(true);
  EXPECT_THAT(IterationRow(pass, unknown, {}), EndsWith("  accepted"));
}

TEST(PartDone, IsThatOfTimeForARunAndOfCellsForASweep) {
  v1::Progress progress;
  EXPECT_EQ(PartDone(progress), 0);
  progress.set_end_time_s(4);
  progress.set_time_s(1);
  EXPECT_EQ(PartDone(progress), 0.25);
  progress.set_time_s(5);  // A last step may end behind the end.
  EXPECT_EQ(PartDone(progress), 1);
  progress.set_cells(8);
  progress.set_cells_done(4);
  EXPECT_EQ(PartDone(progress), 0.5);
}

TEST(TimeToGo, IsUnknownAtTheStartAndZeroAtTheEnd) {
  EXPECT_FALSE(TimeToGo(0.001, 60));
  EXPECT_EQ(TimeToGo(0.25, 10), 30);
  EXPECT_EQ(TimeToGo(1, 10), 0);
}

}  // namespace
}  // namespace contact::cli
