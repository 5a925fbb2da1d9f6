#include <algorithm>
#include <atomic>
#include <future>
#include <map>
#include <thread>
#include <utility>

#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;

// A ball that hits a wall at so many velocities with so many restitutions.
v1::CreateJobRequest Study(int velocities, int restitutions) {
  v1::CreateJobRequest request;
  v1::Sweep& sweep = *request.mutable_job()->mutable_sweep();
  v1::Scenario& base = *sweep.mutable_base();
  v1::Body& ball = *base.add_bodies();
  ball.set_name("ball");
  ball.set_mass_kg(0.5);
  v1::Contact& contact = *base.add_contacts();
  contact.add_between("ball");
  contact.mutable_wall()->set_side(v1::Wall::RIGHT);
  contact.set_stiffness(1e8);
  base.set_end_time_s(4e-3);
  v1::Sweep::Axis& velocity = *sweep.add_axes();
  velocity.set_field("bodies[0].velocity_m_per_s");
  velocity.mutable_linear()->set_low(0.1);
  velocity.mutable_linear()->set_high(1);
  velocity.mutable_linear()->set_count(velocities);
  v1::Sweep::Axis& restitution = *sweep.add_axes();
  restitution.set_field("contacts[0].restitution");
  restitution.mutable_linear()->set_low(0.3);
  restitution.mutable_linear()->set_high(0.9);
  restitution.mutable_linear()->set_count(restitutions);
  for (const auto* metric : {"iterations", "cycles[0].mu", "final_bodies[ball].velocity_m_per_s"}) {
    sweep.add_metrics(metric);
  }
  return request;
}

class SweepTest : public JobsTest {
 protected:
  // Every cell of the log, by number; fails if one comes twice.
  std::map<int, std::string> Cells(const std::string& name) {
    std::map<int, std::string> cells;
    for (const v1::Event& event : Log(name, 0, {"sweep_cell"})) {
      if (!event.has_sweep_cell()) continue;
      const bool is_new =
          cells.emplace(event.sweep_cell().index(), event.sweep_cell().SerializeAsString()).second;
      EXPECT_TRUE(is_new) << event.sweep_cell().index();
    }
    return cells;
  }
};

TEST_F(SweepTest, ManyWorkersFindWhatOneFinds) {
  Open({.workers = 1});
  const std::string alone = Create(Study(8, 5)).value().name();
  const v1::Job job = Ended(alone);
  EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(job.convergence(), v1::Job::FULL);
  EXPECT_EQ(job.progress().cells(), 40);
  EXPECT_EQ(job.progress().cells_done(), 40);
  const auto serial = Cells(alone);
  EXPECT_EQ(serial.size(), 40U);
  Open({.workers = 4});
  const std::string together = Create(Study(8, 5)).value().name();
  Ended(together);
  EXPECT_EQ(Cells(together), serial);
}

// Its cells last until they are let go, and make steps.
TEST_F(SweepTest, HelperLeavesItsCellToAnotherJobAndTheCellIsComputedLater) {
  std::atomic<int> begun = 0;
  std::atomic<bool> let_go = false;
  JobOptions options{.workers = 2};
  options.run = [&](const Scenario& scenario, Observer& observer, const std::stop_token& stop) {
    if (scenario.end_time == 1e-3) return Outcome{};  // The other job.
    ++begun;
    while (!let_go && !stop.stop_requested()) {
      observer.OnStep();
      std::this_thread::yield();
    }
    return stop.stop_requested() ? Ending(Outcome::End::kStopped) : Outcome{};
  };
  Open(std::move(options));
  const std::string study = Create(Study(2, 1)).value().name();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (begun < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_EQ(Ended(Create(BouncingBall(1e-3))).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Get(study).value().state(), v1::Job::RUNNING);
  let_go = true;
  EXPECT_EQ(Ended(study).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Cells(study).size(), 2U);
  EXPECT_GE(begun, 3);
}

TEST_F(SweepTest, CellEqualsAJobOfItsScenario) {
  Open();
  const v1::CreateJobRequest study = Study(3, 3);
  const std::string name = Create(study).value().name();
  const auto cells = Cells(name);
  v1::SweepCell cell;
  cell.ParseFromString(cells.at(5));
  v1::Scenario scenario = study.job().sweep().base();
  scenario.mutable_bodies(0)->set_velocity_m_per_s(cell.values(0));
  scenario.mutable_contacts(0)->set_restitution(cell.values(1));
  const v1::Job job = Ended(Create(scenario));
  EXPECT_THAT(cell.metrics(), ElementsAre(job.summary().iterations(), job.cycles(0).mu(),
                                          job.final_bodies(0).velocity_m_per_s()));
  EXPECT_THAT(cell.sources(), testing::Each(v1::SweepCell::RESULT));
  EXPECT_EQ(cell.cycles(), job.cycles_size());
}

TEST_F(SweepTest, MetricsOfSamplesAreThoseOfTheTrajectoryWhichIsNotStored) {
  Open();
  v1::CreateJobRequest study = Study(3, 3);
  v1::Sweep& sweep = *study.mutable_job()->mutable_sweep();
  sweep.clear_metrics();
  sweep.add_metrics("series[ball-wall.contact_force].max");
  sweep.add_metrics("series[ball.velocity].last");
  sweep.add_metrics("series[ball-wall.contact_force].time_of_max");
  const std::string name = Create(study).value().name();
  const auto cells = Cells(name);
  const auto log = Log(name, 0, {"frame_chunk"});
  EXPECT_TRUE(std::ranges::none_of(log, &v1::Event::has_frame_chunk));
  v1::SweepCell cell;
  cell.ParseFromString(cells.at(5));
  v1::Scenario scenario = sweep.base();
  scenario.mutable_bodies(0)->set_velocity_m_per_s(cell.values(0));
  scenario.mutable_contacts(0)->set_restitution(cell.values(1));
  const v1::Job job = Ended(Create(scenario));
  ASSERT_EQ(cell.metrics_size(), 3);
  EXPECT_EQ(cell.metrics(1), job.final_bodies(0).velocity_m_per_s());
  EXPECT_LE(cell.metrics(0), job.cycles(0).peak_force_n());
  EXPECT_GT(cell.metrics(0), 0.9 * job.cycles(0).peak_force_n());
  EXPECT_GT(cell.metrics(2), job.cycles(0).start_time_s());
  EXPECT_LT(cell.metrics(2), job.cycles(0).end_time_s());
}

TEST_F(SweepTest, CellTellsOfWhatTheEndCutsAndOfContactsThatItDoesNotTouch) {
  JobOptions options{.workers = 1};
  options.run = [](const Scenario& scenario, Observer& observer, const std::stop_token&) {
    if (scenario.contacts[0].restitution == 0.3) return Outcome{};
    observer.OnCycle({.status = Cycle::Status::kCut, .mu = 5});
    Outcome outcome;
    outcome.cut_cycles = 1;
    return outcome;
  };
  Open(std::move(options));
  const auto cells = Cells(Create(Study(1, 2)).value().name());
  v1::SweepCell cell;
  cell.ParseFromString(cells.at(0));
  EXPECT_EQ(cell.sources(1), v1::SweepCell::NO_CONTACT);
  EXPECT_TRUE(cell.has_cycles());
  EXPECT_EQ(cell.cycles(), 0);
  cell.ParseFromString(cells.at(1));
  EXPECT_EQ(cell.sources(1), v1::SweepCell::CUT);
  EXPECT_EQ(cell.metrics(1), 5);
  EXPECT_EQ(cell.cycles_cut(), 1);
}

TEST_F(SweepTest, IdleWorkersHelp) {
  JobOptions options = WithFakeRun({.workers = 3});
  Open(options);
  const std::string name = Create(Study(4, 2)).value().name();
  run_.AwaitStarted(3);  // At the same time: none of them is let go.
  run_.Allow(8);
  EXPECT_EQ(Ended(name).progress().cells_done(), 8);
}

TEST_F(SweepTest, HelpersLeaveForAJobThatWaits) {
  JobOptions options{.workers = 2};
  std::atomic<int> cells = 0;
  options.run = [&](const Scenario& scenario, Observer&, const std::stop_token&) {
    if (scenario.end_time == 3) return Outcome{};
    ++cells;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(11);
    while (std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return Outcome{};
  };
  Open(options);
  const std::string study = Create(Study(100, 100)).value().name();
  while (cells < 4) std::this_thread::yield();
  Ended(Create(BouncingBall(3)));
  EXPECT_EQ(Get(study).value().state(), v1::Job::RUNNING);
  EXPECT_LT(cells, 5000);
  Cancel(study);
  EXPECT_EQ(Ended(study).state(), v1::Job::CANCELLED);
}

TEST_F(SweepTest, FailuresStayInTheirCells) {
  JobOptions options{.workers = 2};
  options.run = [](const Scenario& scenario, Observer& observer, const std::stop_token& stop) {
    if (scenario.bodies[0].velocity == 0.02) return Ending(Outcome::End::kNumeric, "blew up");
    if (scenario.bodies[0].velocity == 0.03) throw std::runtime_error("broke");
    Outcome outcome = contact::Run(scenario, observer, stop);
    if (scenario.bodies[0].velocity == 0.04) outcome.all_converged = false;
    return outcome;
  };
  Open(options);
  v1::CreateJobRequest request = Study(1, 1);
  v1::Sweep::Axis& axis = *request.mutable_job()->mutable_sweep()->mutable_axes(0);
  axis.clear_linear();
  for (const double velocity : {0.01, 0.02, 0.03, 0.04, 1e10}) axis.add_values(velocity);
  const std::string name = Create(request).value().name();
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(job.convergence(), v1::Job::PARTIAL);
  EXPECT_EQ(job.progress().cells_done(), 5);
  EXPECT_EQ(job.progress().cells_failed(), 3);
  EXPECT_EQ(job.progress().cells_not_converged(), 1);
  EXPECT_THAT(job.warnings(), ElementsAre("3 of 5 cells failed"));
  std::vector<std::string> reasons;
  std::vector<std::string> messages;
  for (const auto& [index, bytes] : Cells(name)) {
    v1::SweepCell cell;
    cell.ParseFromString(bytes);
    reasons.push_back(cell.state_reason());
    messages.push_back(cell.message());
  }
  EXPECT_THAT(reasons, ElementsAre("", "NUMERIC", "INTERNAL", "", "SCENARIO_INVALID"));
  EXPECT_EQ(messages[1], "blew up");
  EXPECT_EQ(messages[2], "std::runtime_error: broke");
  EXPECT_EQ(messages[4], "bodies[0].velocity_m_per_s: is 10000000000; must be in [-1e6, 1e6]");
}

TEST_F(SweepTest, AfterACrashFinishedCellsAreNotComputedAgain) {
  std::atomic<int> allowed = 7;
  JobOptions options{.workers = 2};
  options.run = [&](const Scenario&, Observer& observer, const std::stop_token& stop) {
    if (--allowed >= 0) return Outcome{};
    while (!stop.stop_requested()) {
      std::this_thread::yield();
      observer.OnProgress({});
    }
    return Ending(Outcome::End::kStopped);
  };
  Open(options);
  const std::string name = Create(Study(5, 4)).value().name();
  LogReader reader;
  auto watched = Watch(name, reader, 0, {"sweep_cell"});
  for (std::size_t cells = 0; cells < 7;) {
    for (const v1::Event& event : reader.Next(*watched.value().cursor)) {
      cells += event.has_sweep_cell() ? 1 : 0;
    }
  }
  watched.value().cursor.reset();
  Crash();

  std::atomic<int> computed = 0;
  options.run = [&](const auto&...) {
    ++computed;
    return Outcome{};
  };
  Open(options);
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(job.attempt(), 2);
  EXPECT_EQ(job.progress().cells_done(), 20);
  EXPECT_EQ(computed, 13);
  EXPECT_EQ(Cells(name).size(), 20U);
}

TEST_F(SweepTest, ShutdownKeepsFinishedCellsToo) {
  JobOptions options = WithFakeRun({.workers = 2});
  Open(options);
  const std::string name = Create(Study(3, 3)).value().name();
  run_.Allow(4);
  run_.AwaitStarted(6);
  manager_->Stop();
  Open(options);
  run_.Allow(100);
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.attempt(), 1);
  EXPECT_EQ(Cells(name).size(), 9U);
  EXPECT_EQ(run_.started(), 4 + 2 + 5);
}

TEST_F(SweepTest, CancelStopsAllWorkersAndKeepsTheCells) {
  JobOptions options = WithFakeRun({.workers = 3});
  Open(options);
  const std::string name = Create(Study(10, 10)).value().name();
  run_.Allow(5);
  run_.AwaitStarted(8);
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(Cancel(name).ok());
  const v1::Job job = Ended(name);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
  EXPECT_EQ(job.state(), v1::Job::CANCELLED);
  EXPECT_EQ(job.state_reason(), "USER_REQUEST");
  EXPECT_EQ(job.progress().cells_done(), 5);
  EXPECT_EQ(Cells(name).size(), 5U);
  EXPECT_EQ(run_.started(), 8);
}

// Until it has not changed for so long.
int AwaitRest(const std::atomic<int>& number, std::chrono::milliseconds rest) {
  int last = number;
  for (auto since = std::chrono::steady_clock::now();
       std::chrono::steady_clock::now() - since < rest; std::this_thread::yield()) {
    if (std::exchange(last, number) != last) since = std::chrono::steady_clock::now();
  }
  return last;
}

TEST_F(SweepTest, NobodyRunsFarAheadOfTheDisk) {
  std::promise<void> go;
  std::promise<void> disk_works;
  std::atomic<int> computed = 0;
  JobOptions options{.workers = 3};
  options.run = [&computed, gone = go.get_future().share()](const auto&...) {
    ++computed;
    gone.wait();
    return Ending(Outcome::End::kNumeric, std::string(60'000, 'x'));
  };
  Open(options);
  const std::string name = Create(Study(50, 20)).value().name();
  while (computed < 3) std::this_thread::yield();
  store_->ReadEvents({name, 0, 0, 1}, [works = disk_works.get_future().share()](const auto&) {
    works.wait();  // On the store's thread.
  });
  go.set_value();
  // One batch that is being written, 2 MiB that wait for it, 64 cells that wait for these.
  EXPECT_LT(AwaitRest(computed, std::chrono::milliseconds(500)), 120);
  disk_works.set_value();
  EXPECT_EQ(Ended(name).progress().cells_failed(), 1000);
  EXPECT_EQ(Cells(name).size(), 1000U);
}

TEST_F(SweepTest, CellsAreCountedWhileItRuns) {
  OpenWithFakeRun();
  const std::string name = Create(Study(2, 2)).value().name();
  run_.Allow(3);
  run_.AwaitStarted(4);
  v1::Job job = Get(name).value();
  EXPECT_EQ(job.progress().cells(), 4);
  EXPECT_TRUE(job.has_sweep());
  run_.Allow();
  EXPECT_EQ(Ended(name).progress().cells_done(), 4);
}

TEST_F(SweepTest, RulesAreToldWithTheirPaths) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = Study(2, 2);
  request.mutable_job()->mutable_sweep()->mutable_axes(1)->set_field("contacts[0].restituton");
  request.mutable_job()->mutable_sweep()->add_metrics("mu");
  const auto refused = Create(request);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "SCENARIO_INVALID");
  ASSERT_EQ(refused.error().violations.size(), 2U);
  EXPECT_EQ(refused.error().violations[0].field, "sweep.axes[1].field");
  EXPECT_EQ(refused.error().violations[1].field, "sweep.metrics[3]");
}

TEST_F(SweepTest, CellsAreLimited) {
  JobOptions options = WithFakeRun();
  options.scenario_limits.max_cells = 6;
  Open(options);
  EXPECT_TRUE(Create(Study(2, 3)).ok());
  EXPECT_EQ(Create(Study(7, 1)).error().reason, "SCENARIO_INVALID");
  EXPECT_EQ(manager_->Info().limits().max_cells(), 6);
}

}  // namespace
}  // namespace contact
