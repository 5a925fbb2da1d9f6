#include "cli/input/file_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cli/base/files.h"
#include "cli/input/scenario_file.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FileTableTest : public testing::Test {
 protected:
  void Write(const std::string& text) const { WriteText(text, folder_.path() / "m.csv"); }

  // A scenario with this load or motion, in a file beside m.csv.
  ScenarioFile Open(const std::string& table, const std::string& kind = "table",
                    const VariableValues& variables = {}) const {
    const std::string path = folder_.path() / "s.yaml";
    WriteText(kind == "table"
                  ? fmt::format("variables: {{gain: 2}}\nbodies: [{{name: B, mass_kg: 1}}]\n"
                                "loads:\n  - {{body: B, table: {}}}\nend_time_s: 1\n",
                                table)
                  : fmt::format("bodies:\n  - {{name: B, motion: {{{}: {}}}}}\nend_time_s: 1\n",
                                kind, table),
              path);
    ScenarioFile file = ScenarioFile::Open(path, variables);
    file.Check();
    return file;
  }

  v1::Load::Table Table(const std::string& table, const VariableValues& variables = {}) const {
    const ScenarioFile file = Open(table, "table", variables);
    for (const Diagnostic& mistake : file.diagnostics()) ADD_FAILURE() << Format(mistake);
    return file.scenario().loads(0).table();
  }

  std::vector<std::string> Mistakes(const std::string& table,
                                    const std::string& kind = "table") const {
    std::vector<std::string> lines;
    for (const Diagnostic& mistake : Open(table, kind).diagnostics()) {
      std::string line = Format(mistake);
      line.erase(0, line.find_last_of('/', line.find(':')) + 1);
      lines.push_back(line);
    }
    return lines;
  }

  const TempDirectory folder_;
};

TEST_F(FileTableTest, BecomesTheListsOfTheContract) {
  Write("time [ms];force [kN]\n0;0\n1,5;2,25\n3;-4,5\n");
  const auto table = Table("{file: m.csv, period_s: 0.5}");
  EXPECT_THAT(table.times_s(), ElementsAre(0, 0.0015, 0.003));
  EXPECT_THAT(table.forces_n(), ElementsAre(0, 2250, -4500));
  EXPECT_EQ(table.period_s(), 0.5);
  EXPECT_THAT(table.points(), IsEmpty());
}

TEST_F(FileTableTest, IsTheSameScenarioAsTheListsInEachDialect) {
  const std::string lists = Open("{times_s: [0, 0.0005, 0.0015], forces_n: [0, 40, 90.5]}")
                                .scenario()
                                .SerializeAsString();
  for (const std::string text :
       {"t [ms],F [N]\n0,0\n0.5,40\n1.5,90.5\n", "t [ms];F [N]\n0;0\n0,5;40\n1,5;90,5\n",
        "t [s]\tF [kN]\n0\t0\n5e-4\t0.04\n0.0015\t0.0905\n",
        "  t (ms)   F (N)\n  0  0\n  0.5  40.0\n  1.5  90.5\n",
        "Logger\nRate;2\nTime;Force\nms;N\n0;0\n0,5;40\n1,5;90,5\n",
        "\xEF\xBB\xBF\"t [us]\",\"F [N]\"\r\n0,0\r\n500,40\r\n1500,90.5\r\n"}) {
    Write(text);
    const ScenarioFile file = Open("{file: m.csv}");
    EXPECT_THAT(file.diagnostics(), IsEmpty()) << text;
    EXPECT_EQ(file.scenario().SerializeAsString(), lists) << text;
  }
}

TEST_F(FileTableTest, KeysChooseScaleAndShift) {
  Write("a,F,t,G\n1,2,-3,4\n2,3,-1,7\n");
  auto table =
      Table("{file: m.csv, column: G, unit: lbf, scale: -2, time_unit: ms, shift_s: 0.25}");
  EXPECT_THAT(table.times_s(), ElementsAre(-0.003 + 0.25, -0.001 + 0.25));
  EXPECT_THAT(table.forces_n(), ElementsAre(4 * 4.4482216152605 * -2, 7 * 4.4482216152605 * -2));
  table = Table("{file: m.csv, column: 2, time_column: 1, scale: \"${gain}\"}", {{"gain", "3"}});
  EXPECT_THAT(table.times_s(), ElementsAre(1, 2));
  EXPECT_THAT(table.forces_n(), ElementsAre(6, 9));
}

TEST_F(FileTableTest, MotionsHaveTheirUnitsExactly) {
  Write("t [s],a [g],v [mph],x [in]\n0,1,2,3\n1,2,3,4\n");
  const auto motion = [this](const std::string& kind, const std::string& column) {
    return Open(fmt::format("{{file: m.csv, column: {}}}", column), kind)
        .scenario()
        .bodies(0)
        .motion();
  };
  EXPECT_THAT(motion("acceleration_table", "a").acceleration_table().accelerations_m_per_s2(),
              ElementsAre(9.80665, 2 * 9.80665));
  EXPECT_THAT(motion("velocity_table", "v").velocity_table().velocities_m_per_s(),
              ElementsAre(2 * 0.44704, 3 * 0.44704));
  EXPECT_THAT(motion("position_table", "4").position_table().positions_m(),
              ElementsAre(3 * 0.0254, 4 * 0.0254));
}

TEST_F(FileTableTest, RulesThatItsRowsBreakAreToldWhereTheFileHasThem) {
  Write("logger 7\nt [s],F [kN]\n-1,1\n2,1e13\n2,3\n");
  EXPECT_THAT(
      Mistakes("{file: m.csv}"),
      ElementsAre("m.csv:3:1: loads[0].table: is -1; must be in [0, 1e6] — shift_s: 1 lets "
                  "the table begin at 0",
                  "m.csv:4:3: loads[0].table: is 1e+16; must be in [-1e15, 1e15]",
                  "m.csv:5:1: loads[0].table: is 2, which is not after the 2 before — points "
                  "follow one another in time"));
  Write("t [s],F [N]\n1,1\n2,x\n3,\ny,4\n4,5,6\n7,8\n8,9\n9,10\n10,11\n11,12\n");
  EXPECT_THAT(Mistakes("{file: m.csv}"),
              ElementsAre("m.csv:3:3: loads[0].table: expected a number, got 'x'",
                          HasSubstr("m.csv:4:3: loads[0].table: has no number"),
                          "m.csv:5:1: loads[0].table: expected a number, got 'y'",
                          HasSubstr("m.csv:6:5: loads[0].table: has 3 fields; others have 2")));
}

TEST_F(FileTableTest, WhatTheScenarioAsksForAndTheFileLacksIsTold) {
  Write("t [s],F [V]\n0,1\n1,2\n");
  const std::string at = "s.yaml:4:";
  EXPECT_THAT(Mistakes("{file: m.csv}"),
              ElementsAre(HasSubstr("loads[0].table.file: 'V' is no unit of a quantity in N")));
  EXPECT_THAT(
      Mistakes("{file: m.csv, unit: mm}"),
      ElementsAre(at + "42: loads[0].table.unit: 'mm' is no unit of a quantity in N — unit: "
                       "one of N, kN, mN, MN, kgf, lbf"));
  EXPECT_THAT(Mistakes("{file: m.csv, unit: N, column: G}"),
              ElementsAre(HasSubstr("m.csv has no column 'G' — it has t [s], F [V]")));
  EXPECT_THAT(Mistakes("{file: m.csv, unit: N, scale: much, skip: -1}"),
              ElementsAre(HasSubstr("skip: expected a number of lines")));
  EXPECT_THAT(Mistakes("{file: m.csv, unit: N, scale: much}"),
              ElementsAre(HasSubstr("scale: expected a number")));
  EXPECT_THAT(Mistakes("{file: none.csv}"), ElementsAre(HasSubstr("cannot read")));
  EXPECT_THAT(Mistakes("{file: m.csv, unit: N, points: []}"),
              ElementsAre(HasSubstr("loads[0].table.points: cannot stand beside file")));
  EXPECT_THAT(Mistakes("{file: m.csv, unit: N, colum: 1}"),
              ElementsAre(HasSubstr("colum: unknown field — did you mean 'column'?")));
}

TEST_F(FileTableTest, AUnitThatNothingTellsIsTold) {
  Write("0 1\n1 2\n");
  const ScenarioFile file = Open("{file: m.csv, time_unit: s}");
  EXPECT_THAT(file.diagnostics(), IsEmpty());
  ASSERT_EQ(file.advice().size(), 2U) << "and a variable that is not used";
  EXPECT_THAT(Format(file.advice()[1]),
              HasSubstr("nothing tells the unit of the values; N is taken — unit: N"));
  Write("t_ms F_kN\n0 1\n1 2\n");
  EXPECT_THAT(Table("{file: m.csv}").forces_n(), ElementsAre(1000, 2000));
}

}  // namespace
}  // namespace contact::cli
