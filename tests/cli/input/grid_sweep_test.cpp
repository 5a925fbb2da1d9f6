#include "cli/input/grid_sweep.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kScenario[] =
    "end_time_s: 4e-3\n"
    "bodies:\n"
    "- {name: A, mass_kg: 0.5, position_m: 0, radius_m: 0.05, velocity_m_per_s: 0.2}\n"
    "- {name: B, mass_kg: 0.5, position_m: 0.1, radius_m: 0.05}\n"
    "contacts:\n"
    "- {between: [A, B], stiffness: 1e10, restitution: 0.8}\n";

class GridSweepTest : public testing::Test {
 protected:
  GridSweepTest() { WriteText(kScenario, file_); }

  v1::Sweep Grid(const std::vector<std::string>& axes, const DrawnCells& drawn = {}) {
    return MakeGrid(ScenarioFile::Open(file_), axes, {}, drawn);
  }

  Failure Refused(const std::vector<std::string>& axes, const DrawnCells& drawn = {}) {
    try {
      Grid(axes, drawn);
    } catch (const Failure& failure) {
      return failure;
    }
    ADD_FAILURE() << axes.front();
    return {ExitCode::kOk, ""};
  }

  const TempDirectory folder_;
  const std::string file_ = folder_.path() / "two.yaml";
};

TEST_F(GridSweepTest, ARangeIsSteppedFromItsFirstToItsLastValue) {
  const v1::Sweep sweep = Grid({"contacts[0].restitution=0.5:0.9:5", "end_time_s=4e-3:1e-3:2"});
  ASSERT_EQ(sweep.axes_size(), 2);
  EXPECT_EQ(sweep.axes(0).field(), "contacts[0].restitution");
  EXPECT_THAT(sweep.axes(0).values(), ElementsAre(0.5, 0.6, 0.7, 0.8, 0.9));
  EXPECT_THAT(sweep.axes(1).values(), ElementsAre(4e-3, 1e-3));
  EXPECT_THAT(Grid({"end_time_s=1e-3:5:1"}).axes(0).values(), ElementsAre(1e-3));
}

TEST_F(GridSweepTest, AListIsTakenAsItStands) {
  EXPECT_THAT(Grid({"contacts[0].restitution=0.9, 0.5,7e-1"}).axes(0).values(),
              ElementsAre(0.9, 0.5, 0.7));
}

TEST_F(GridSweepTest, WordsOfAnEnumAreItsNumbers) {
  EXPECT_THAT(Grid({"solver.phase_split=PEAK_FORCE,PEAK_DEFORMATION"}).axes(0).values(),
              ElementsAre(v1::Solver::PEAK_FORCE, v1::Solver::PEAK_DEFORMATION));
  EXPECT_THAT(Grid({"contacts[A-B].damping=exact,Hunt-Crossley"}).axes(0).values(),
              ElementsAre(v1::Contact::EXACT, v1::Contact::HUNT_CROSSLEY));
}

TEST_F(GridSweepTest, BaseAndMetricComeAlong) {
  const v1::Sweep sweep = Grid({"contacts[0].restitution=0.5"});
  EXPECT_EQ(sweep.base().bodies(1).name(), "B");
  EXPECT_THAT(sweep.metrics(), ElementsAre("iterations"));
  EXPECT_EQ(sweep.combination(), v1::Sweep::COMBINATION_UNSPECIFIED);
  const ScenarioFile base = ScenarioFile::Open(file_);
  EXPECT_THAT(MakeGrid(base, {"contacts[0].restitution=0.5"}, {"cycles[0].mu", "steps"}).metrics(),
              ElementsAre("cycles[0].mu", "steps"));
}

TEST_F(GridSweepTest, DrawnCellsHaveRangesCountAndSeed) {
  const DrawnCells drawn{.count = 8, .latin_hypercube = true, .seed = 3};
  const v1::Sweep sweep = Grid({"contacts[0].restitution=0.5:0.9"}, drawn);
  EXPECT_EQ(sweep.axes(0).linear().low(), 0.5);
  EXPECT_EQ(sweep.axes(0).linear().high(), 0.9);
  EXPECT_EQ(sweep.combination(), v1::Sweep::LATIN_HYPERCUBE);
  EXPECT_EQ(sweep.count(), 8);
  EXPECT_EQ(sweep.seed(), 3);
  EXPECT_EQ(Grid({"contacts[0].restitution=0.5,0.9"}, {.count = 2}).combination(),
            v1::Sweep::RANDOM);
}

TEST_F(GridSweepTest, AnAxisOfAnotherFormIsAUsageErrorThatShowsIt) {
  for (const char* axis :
       {"nonsense", "=1,2", "end_time_s=", "end_time_s=1:2", "end_time_s=1:2:3:4",
        "end_time_s=1:2:0", "end_time_s=1:2:1e9", "end_time_s=a:b:3", "end_time_s=1,,2",
        "end_time_s=one", "end_time_s=[1]"}) {
    const Failure failure = Refused({axis});
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_THAT(failure.what(), HasSubstr(std::string("--grid ") + axis + ": expected FIELD="));
  }
  EXPECT_THAT(Refused({"end_time_s=1:2:3"}, {.count = 4}).what(), HasSubstr("LOW:HIGH"));
}

TEST_F(GridSweepTest, BrokenRulesNameTheAxisAndAreToldAtOnce) {
  const Failure failure =
      Refused({"contacts[0].restituton=0.5", "end_time_s=1e-3", "bodies[7].mass_kg=1"});
  EXPECT_EQ(failure.code(), ExitCode::kInvalidScenario);
  EXPECT_THAT(failure.what(), HasSubstr("--grid contacts[0].restituton=0.5: axes[0].field"));
  EXPECT_THAT(failure.what(), HasSubstr("did you mean 'restitution'?"));
  EXPECT_THAT(failure.what(), HasSubstr("--grid bodies[7].mass_kg=1: axes[2].field"));
  EXPECT_THAT(failure.what(), HasSubstr("2 errors"));
}

TEST_F(GridSweepTest, MistakesOfTheScenarioHaveTheirPlace) {
  WriteText("end_time_s: 1\nbodies:\n- {nam: A, mass_kg: 1}\n", file_);
  EXPECT_THAT(Refused({"end_time_s=1,2"}).what(), HasSubstr("two.yaml:3:4: bodies[0].nam"));
}

TEST_F(GridSweepTest, AnAxisOverAVariableSetsAllItsFields) {
  WriteText(
      "variables: {r: 0.05, law: EXACT, unused: 1}\nend_time_s: 4e-3\ntitle: ${r}\nbodies:\n"
      "- {name: A, mass_kg: 0.5, radius_m: \"${r}\", velocity_m_per_s: 0.2}\n"
      "- {name: B, mass_kg: 0.5, position_m: 0.1, radius_m: \"${r}\"}\n"
      "contacts:\n- {between: [A, B], stiffness: 1e10, restitution: 0.8, damping: \"${law}\"}\n",
      file_);
  const v1::Sweep sweep = Grid({"var:r=0.01:0.05:3", "var:law=EXACT,FLORES"});
  EXPECT_EQ(sweep.axes(0).field(), "bodies[0].radius_m");
  EXPECT_THAT(sweep.axes(0).also(), ElementsAre("bodies[1].radius_m"));
  EXPECT_EQ(sweep.axes(0).label(), "var:r");
  EXPECT_THAT(sweep.axes(0).values(), ElementsAre(0.01, 0.03, 0.05));
  EXPECT_EQ(sweep.axes(1).field(), "contacts[0].damping");
  EXPECT_THAT(sweep.axes(1).values(), ElementsAre(v1::Contact::EXACT, v1::Contact::FLORES));
  EXPECT_THAT(Refused({"var:radius=1,2"}).what(), HasSubstr("unknown variable 'radius'"));
  const Failure unused = Refused({"var:unused=1,2"});
  EXPECT_EQ(unused.code(), ExitCode::kUsage);
  EXPECT_STREQ(unused.what(),
               "--grid var:unused=1,2: 'unused' is the whole value of no number — an axis sets "
               "fields such as mass_kg: ${unused}");
}

TEST_F(GridSweepTest, VariablesAreThoseOfTheScenario) {
  WriteText("variables: {end: 1e-3}\n" + std::string(kScenario).replace(12, 4, "${end}"), file_);
  const std::vector<std::string> axes = {"contacts[0].restitution=0.5"};
  EXPECT_EQ(MakeGrid(ScenarioFile::Open(file_, {{"end", "2e-3"}}), axes, {}).base().end_time_s(),
            2e-3);
  EXPECT_THROW(MakeGrid(ScenarioFile::Open(file_, {{"begin", "0"}}), axes, {}), Failure);
}

}  // namespace
}  // namespace contact::cli
