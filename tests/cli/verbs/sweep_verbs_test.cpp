// The verbs of sweeps against a scripted server.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/verbs/verb_case.h"
#include "contact/v1/event.pb.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

// A sweep over 2 masses and 2 velocities. Cell 3 has failed, cell 2 has not converged.
class SweepVerbsTest : public testing::Test {
 protected:
  SweepVerbsTest() {
    v1::Job& job = server_.Add("jobs/s", v1::Job::SUCCEEDED);
    job.set_convergence(v1::Job::PARTIAL);
    v1::Sweep& sweep = *job.mutable_sweep();
    v1::Body& body = *sweep.mutable_base()->add_bodies();
    body.set_name("A");
    sweep.mutable_base()->set_end_time_s(1);
    sweep.add_axes()->set_field("bodies[0].mass_kg");
    sweep.add_axes()->set_field("bodies[0].velocity_m_per_s");
    sweep.add_metrics("iterations");
    int index = 0;
    for (const double mass : {1.0, 2.0}) {
      for (const double velocity : {0.25, 0.5}) AddCell(index++, mass, velocity);
    }
    Cell(2).set_convergence(v1::Job::PARTIAL);
    Cell(3).set_state(v1::Job::FAILED);
    Cell(3).set_state_reason("SCENARIO_INVALID");
    Cell(3).set_message("no, not so");
  }

  void AddCell(int index, double mass, double velocity) {
    v1::SweepCell& cell = *server_.events.emplace_back().mutable_sweep_cell();
    cell.set_index(index);
    cell.add_values(mass);
    cell.add_values(velocity);
    cell.add_metrics(10 + index);
    cell.set_state(v1::Job::SUCCEEDED);
    cell.set_convergence(v1::Job::FULL);
  }

  v1::SweepCell& Cell(std::size_t index) { return *server_.events[index].mutable_sweep_cell(); }

  End Run(const std::vector<std::string>& words) { return EndOf(words, server_.address()); }

  ScriptedServer server_;
};

TEST_F(SweepVerbsTest, WatchHasTheCodeOfTheSweepAndExportThatOfPrinting) {
  EXPECT_EQ(Run({"sweep", "watch", "s"}).code, ExitCode::kNotConverged);
  const End exported = Run({"sweep", "export", "s", "-o", "csv"});
  EXPECT_EQ(exported.code, ExitCode::kOk);
  EXPECT_EQ(exported.printed,
            "cell,bodies[0].mass_kg,bodies[0].velocity_m_per_s,iterations,state,convergence,"
            "message\n"
            "0,1,0.25,10,SUCCEEDED,FULL,\n"
            "1,1,0.5,11,SUCCEEDED,FULL,\n"
            "2,2,0.25,12,SUCCEEDED,PARTIAL,\n"
            "3,2,0.5,13,FAILED,,\"SCENARIO_INVALID: no, not so\"\n");
}

TEST_F(SweepVerbsTest, CommentsOfCsvNameTheSweep) {
  const End end = Run({"sweep", "export", "s", "-o", "csv", "--comments"});
  EXPECT_THAT(end.printed, testing::StartsWith("# "));
  EXPECT_THAT(end.printed, HasSubstr("jobs/s\n"));
}

TEST_F(SweepVerbsTest, WatchAsksForCellsAndProgressAndCellForCellsAlone) {
  Run({"sweep", "watch", "s"});
  Run({"sweep", "cell", "s", "0"});
  const auto asked = server_.Asked<v1::WatchJobRequest>();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_THAT(asked[0].kinds(), ElementsAre("sweep_cell", "progress"));
  EXPECT_THAT(asked[1].kinds(), ElementsAre("sweep_cell"));
}

TEST_F(SweepVerbsTest, JsonHasTheJobAndEachCell) {
  const auto document = nlohmann::json::parse(Run({"sweep", "watch", "s", "-o", "json"}).printed);
  EXPECT_EQ(document["job"]["name"], "jobs/s");
  ASSERT_EQ(document["cells"].size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(document["cells"][static_cast<std::size_t>(i)]["index"], i);
}

TEST_F(SweepVerbsTest, CellIsShownWithTheCommandThatRunsIt) {
  const End end = Run({"sweep", "cell", "s", "mass_kg=2,velocity_m_per_s=0.25"});
  EXPECT_THAT(end.printed, HasSubstr("jobs/s cell 2  SUCCEEDED  convergence PARTIAL"));
  EXPECT_EQ(end.said, "Next:  contactctl sweep cell s 2 --run\n");
  EXPECT_TRUE(server_.Asked<v1::CreateJobRequest>().empty());
}

TEST_F(SweepVerbsTest, CellThatIsRunIsAJobWithItsScenario) {
  EXPECT_EQ(Run({"sweep", "cell", "s", "1", "--run", "-o", "name"}).printed, "jobs/new\n");
  const auto asked = server_.Asked<v1::CreateJobRequest>();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_THAT(asked[0].job().labels(), UnorderedElementsAre(Pair("sweep", "s"), Pair("cell", "1")));
  EXPECT_DOUBLE_EQ(asked[0].job().scenario().bodies(0).mass_kg(), 1);
  EXPECT_DOUBLE_EQ(asked[0].job().scenario().bodies(0).velocity_m_per_s(), 0.5);
}

TEST_F(SweepVerbsTest, NameOfACellIsOnlyForOneThatIsRun) {
  EXPECT_EQ(Run({"sweep", "cell", "s", "1", "-o", "name"}).code, ExitCode::kUsage);
}

TEST_F(SweepVerbsTest, HeatMapHasACharacterForEachKindOfCell) {
  const End end = Run({"sweep", "heatmap", "s"});
  EXPECT_THAT(end.printed, testing::StartsWith("iterations over bodies[0].mass_kg (down)"));
  EXPECT_THAT(end.printed, HasSubstr("!"));   // Cell 2.
  EXPECT_THAT(end.printed, HasSubstr("××"));  // Cell 3.
  EXPECT_EQ(Run({"sweep", "heatmap", "s", "--metric", "steps"}).told,
            "--metric steps: the sweep has none of this name");
}

TEST_F(SweepVerbsTest, RunIsNoSweep) {
  server_.Add("jobs/r", v1::Job::SUCCEEDED).mutable_scenario()->set_end_time_s(1);
  for (const char* verb : {"watch", "export", "heatmap"}) {
    const End end = Run({"sweep", verb, "r"});
    EXPECT_EQ(end.code, ExitCode::kUsage) << verb;
    EXPECT_EQ(end.told, "jobs/r is no sweep; see contactctl describe");
  }
}

// Whoever reads its cells waits for them.
TEST_F(SweepVerbsTest, RunPrintsTheNameWithoutWaitingAsSubmitDoes) {
  const std::string file = CONTACT_SOURCE_DIR "/client/scenarios/table-3-sweep.yaml";
  const End run = Run({"sweep", "run", file, "-o", "name"});
  const End submit = Run({"submit", file, "-o", "name"});
  EXPECT_EQ(run.code, ExitCode::kOk);
  EXPECT_EQ(run.printed, "jobs/new\n");
  EXPECT_EQ(submit.printed, "jobs/new2\n");
  EXPECT_EQ(run.said, submit.said);
  EXPECT_TRUE(server_.Asked<v1::WatchJobRequest>().empty());
}

TEST_F(SweepVerbsTest, GridOfTheCommandLineIsTheSweep) {
  const std::string base = CONTACT_SOURCE_DIR "/client/scenarios/two-balls.yaml";
  const End end = Run({"sweep", "run", base, "--grid", "contacts[0].restitution=0.5,0.7", "--label",
                       "a=b", "-o", "name"});
  EXPECT_EQ(end.told, "");
  const auto asked = server_.Asked<v1::CreateJobRequest>();
  ASSERT_EQ(asked.size(), 1U);
  const v1::Sweep& sweep = asked[0].job().sweep();
  ASSERT_EQ(sweep.axes_size(), 1);
  EXPECT_EQ(sweep.axes(0).field(), "contacts[0].restitution");
  EXPECT_THAT(sweep.metrics(), ElementsAre("iterations"));
  EXPECT_EQ(sweep.base().bodies_size(), 2);
  EXPECT_THAT(asked[0].job().labels(), UnorderedElementsAre(Pair("a", "b")));
}

}  // namespace
}  // namespace contact::cli
