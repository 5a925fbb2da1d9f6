// Runs that end badly: out of budget, hanging, deadly.
#include <atomic>
#include <cstdio>
#include <future>
#include <map>
#include <new>
#include <set>

#include "jobs/job/lifecycle.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

v1::CreateJobRequest WithPriority(std::int32_t priority, double end_time_s) {
  v1::CreateJobRequest request = RequestFor(BouncingBall(end_time_s));
  request.mutable_job()->set_priority(priority);
  return request;
}

class LostRunTest : public JobsTest {
 protected:
  // Moves the clock until the job has ended. A watchdog counts one second a look at most.
  v1::Job EndedInTime(const std::string& name) {
    for (;;) {
      v1::Job job = Get(name).value();
      if (IsFinal(job.state())) return job;
      clock_.Advance(milliseconds(500));
      std::this_thread::yield();
    }
  }
  static JobOptions LookOften(JobOptions options = {}) {
    options.look_interval = milliseconds(1);
    return options;
  }
};

TEST_F(LostRunTest, LargerPriorityRunsFirstAndEqualsInOrder) {
  std::vector<double> order;
  FakeRun run([&](const Scenario& scenario, Observer&, const std::stop_token&) {
    order.push_back(scenario.end_time);
    return Outcome{};
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  Create(BouncingBall(1));
  run.AwaitStarted(1);
  std::vector<std::string> names;
  for (const auto& [priority, end_time] : {std::pair(-100, 6), {0, 4}, {7, 2}, {0, 5}, {7, 3}}) {
    names.push_back(Create(WithPriority(priority, end_time)).value().name());
  }
  EXPECT_EQ(Get(names[2]).value().priority(), 7);
  run.Allow(6);
  for (const std::string& name : names) Ended(name);
  EXPECT_THAT(order, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(LostRunTest, PriorityHoldsAfterACrash) {
  OpenWithFakeRun();
  Create();
  run_.AwaitStarted(1);
  const std::string low = Create(WithPriority(-1, 2)).value().name();
  const std::string high = Create(WithPriority(1, 3)).value().name();
  Crash();
  std::vector<double> order;
  FakeRun run([&](const Scenario& scenario, Observer&, const std::stop_token&) {
    order.push_back(scenario.end_time);
    return Outcome{};
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  run.Allow(3);
  Ended(low);
  EXPECT_THAT(order, ElementsAre(3, 1e6, 2));
}

TEST_F(LostRunTest, SpentStepsEndARealRun) {
  Open();
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  request.mutable_job()->mutable_budget()->set_steps(5000);
  const v1::Job job = Ended(Create(request).value().name());
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "BUDGET_STEPS");
  EXPECT_GE(job.summary().steps(), 5000);
  EXPECT_LT(job.summary().steps(), 5020) << "the tries of one step";
  EXPECT_GT(job.cycles_size(), 0) << "what it recorded is kept";
  EXPECT_EQ(job.attempt(), 1);
  EXPECT_EQ(job.budget().steps(), 5000);
}

TEST_F(LostRunTest, SpentOutputEndsARealRun) {
  Open();
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  request.mutable_job()->mutable_budget()->set_output_bytes(100'000);
  const v1::Job job = Ended(Create(request).value().name());
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "BUDGET_OUTPUT");
  std::size_t bytes = 0;
  int cycles = 0;
  for (v1::Event event : Log(job.name())) {
    cycles += event.has_cycle() ? 1 : 0;
    if (event.has_state_changed() || event.has_attempt_started() || event.has_progress()) continue;
    event.clear_sequence();
    bytes += event.ByteSizeLong();
  }
  EXPECT_LE(bytes, 100'000U);
  EXPECT_GT(bytes, 90'000U);
  EXPECT_EQ(job.cycles_size(), cycles) << "the ledger is that of the log";
}

TEST_F(LostRunTest, SpentOutputIsSeenAlsoWhenTheRunIsThrough) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnSamples({.first = 0, .columns = 7, .values = std::vector<double>(1400)});
    return Outcome{};
  });
  JobOptions options{.max_budget = {.output_bytes = 1000}};
  options.run = std::ref(run);
  Open(options);
  run.Allow();
  EXPECT_EQ(Ended(Create()).state_reason(), "BUDGET_OUTPUT");
}

TEST_F(LostRunTest, ALedgerThatOutgrowsTheMemoryEndsARealRunAndIsKept) {
  Open({.max_budget = {.memory_bytes = 1'000'000}});
  const v1::Job job = Ended(Create(BouncingBall()));
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "BUDGET_MEMORY");
  EXPECT_THAT(job.error().message(), HasSubstr("250000 bytes of memory for the ledger"));
  EXPECT_GT(job.cycles_size(), 100);
  EXPECT_LT(job.cycles_size(), 250'000 / 400);
}

TEST_F(LostRunTest, SpentWallTimeEndsARealRun) {
  Open(LookOften({.max_budget = {.wall_time = seconds(100)}}));
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  request.mutable_job()->mutable_budget()->mutable_wall_time()->set_seconds(10);
  const std::string name = Create(request).value().name();
  while (Get(name).value().progress().time_s() == 0) std::this_thread::yield();
  clock_.Advance(seconds(11));  // And no further: a run that does not end soon counts as lost.
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "BUDGET_WALL_TIME");
  EXPECT_THAT(job.error().message(), HasSubstr("10 s"));
  EXPECT_GT(job.summary().time_reached_s(), 0);
  EXPECT_EQ(job.attempt(), 1);
}

TEST_F(LostRunTest, JumpOfTheClockSpendsNothing) {
  Open(WithFakeRun(LookOften({.max_budget = {.wall_time = seconds(100)}})));
  const std::string name = Create();
  run_.AwaitStarted(1);
  for (const auto jump : {std::chrono::hours(-1), std::chrono::hours(24 * 3653)}) {
    clock_.Jump(jump);
    clock_.AwaitReadings(3);  // The watchdog's: nobody else asks.
    EXPECT_EQ(Get(name).value().state(), v1::Job::RUNNING);
  }
  run_.Allow();
  EXPECT_EQ(Ended(name).state(), v1::Job::SUCCEEDED);
}

TEST_F(LostRunTest, HangingRunIsGivenUpAndItsWorkerReplaced) {
  std::promise<void> release;
  const auto released = release.get_future().share();
  std::promise<void> back;
  JobOptions options{.workers = 1};
  options.run = [&](const Scenario& scenario, Observer& observer, const std::stop_token&) {
    if (scenario.end_time != 13) return Outcome{};
    observer.OnWarning("before");
    released.wait();  // Does not look at the stop token.
    observer.OnWarning("after");
    observer.OnProgress({});
    back.set_value();
    return Outcome{};
  };
  Open(LookOften(options));
  const std::string bad = Create(BouncingBall(13));
  const std::string next = Create();
  const v1::Job job = EndedInTime(bad);
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "STALLED");
  EXPECT_EQ(job.attempt(), 1);
  EXPECT_THAT(job.warnings(), ElementsAre("before"));
  EXPECT_EQ(Ended(next).state(), v1::Job::SUCCEEDED) << "another worker has taken over";
  EXPECT_EQ(manager_->Info().running_jobs(), 0);

  const v1::Job before = Get(bad).value();
  release.set_value();
  back.get_future().wait();
  manager_->Stop();
  EXPECT_EQ(Get(bad).value().SerializeAsString(), before.SerializeAsString())
      << "what it reports later goes nowhere";
}

TEST_F(LostRunTest, HangingRunCanBeCancelled) {
  std::promise<void> release;
  const auto released = release.get_future().share();
  std::promise<void> started, back;
  JobOptions options;
  options.run = [&](const Scenario&, Observer&, const std::stop_token&) {
    started.set_value();
    released.wait();
    back.set_value();
    return Outcome{};
  };
  Open(LookOften(options));
  const std::string name = Create();
  started.get_future().wait();
  ASSERT_TRUE(Cancel(name).ok());
  EXPECT_EQ(EndedInTime(name).state(), v1::Job::CANCELLED);
  release.set_value();
  back.get_future().wait();
  manager_->Stop();  // Waits for the worker that was given up, which uses what is above.
}

TEST_F(LostRunTest, StalledRunThatHearsKeepsItsResult) {
  std::atomic<bool> stopped = false;
  JobOptions options;
  options.run = [&](const Scenario&, Observer& observer, const std::stop_token& stop) {
    const std::stop_callback told(stop, [&] { stopped = true; });
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait(lock, stop, [] { return false; });
    observer.OnWarning("it was hard");
    return Ending(Outcome::End::kStopped);
  };
  Open(LookOften(options));
  const std::string name = Create();
  while (!stopped) {  // And no further: a run that does not end soon counts as lost.
    clock_.Advance(milliseconds(500));
    std::this_thread::yield();
  }
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.state_reason(), "STALLED");
  EXPECT_THAT(job.warnings(), ElementsAre("it was hard", testing::HasSubstr("sample_interval_s")));
  EXPECT_TRUE(job.has_summary());
}

TEST_F(LostRunTest, HangingRunDoesNotHoldUpTheEnd) {
  auto release = std::make_shared<std::promise<void>>();
  const auto released = release->get_future().share();
  std::promise<void> started, back;
  JobOptions options;
  options.run = [&, released](const Scenario&, Observer&, const std::stop_token&) {
    started.set_value();
    released.wait();
    back.set_value();
    return Outcome{};
  };
  Open(options);
  const std::string name = Create();
  started.get_future().wait();
  const auto begin = std::chrono::steady_clock::now();
  manager_->Stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
  release->set_value();
  back.get_future().wait();
  OpenWithFakeRun();
  run_.Allow();
  EXPECT_EQ(Ended(name).attempt(), 2);
}

TEST_F(LostRunTest, RunThatDoesNotFitIntoMemoryFailsItsJobOnly) {
  JobOptions options{.workers = 2};
  options.run = [](const Scenario& scenario, Observer&, const std::stop_token&) -> Outcome {
    if (scenario.end_time == 13) throw std::bad_alloc();
    if (scenario.end_time == 14) throw 42;
    if (scenario.end_time == 15) throw std::out_of_range("index 7");
    return {};
  };
  Open(options);
  std::vector<std::string> names;
  for (const double end : {1, 13, 14, 15, 2}) names.push_back(Create(BouncingBall(end)));
  EXPECT_EQ(Ended(names[0]).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(names[4]).state(), v1::Job::SUCCEEDED);
  EXPECT_THAT(Ended(names[1]).error().message(), StartsWith("std::bad_alloc"));
  EXPECT_EQ(Ended(names[2]).error().message(), "unknown exception");
  EXPECT_EQ(Ended(names[3]).error().message(), "std::out_of_range: index 7");
  for (const std::size_t i : {1U, 2U, 3U}) EXPECT_EQ(Ended(names[i]).state_reason(), "INTERNAL");
}

TEST_F(LostRunTest, DeadlyJobIsSetAsideAfterThreeCrashes) {
  for (int crash = 0; crash < 3; ++crash) {
    OpenWithFakeRun();
    const std::string name = crash == 0 ? Create() : "jobs/a1";
    run_.AwaitStarted(crash + 1);
    while (Get(name).value().state() != v1::Job::RUNNING) std::this_thread::yield();
    Crash();
  }
  OpenWithFakeRun();
  const v1::Job job = Ended("jobs/a1");
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "CRASHED");
  EXPECT_EQ(job.attempt(), 3);
  EXPECT_THAT(job.error().message(), HasSubstr("the server died"));
  EXPECT_EQ(run_.started(), 3);
}

TEST_F(LostRunTest, NeighboursOfADeadlyJobAllSucceed) {
  // The one that ends at 13 brings the server down as soon as it runs.
  std::atomic<int> deadly = 0;
  std::set<std::string> names;
  JobOptions options{.workers = 2};
  FakeRun run([&](const Scenario&, Observer&, const std::stop_token&) { return Outcome{}; });
  options.run = [&](const Scenario& scenario, Observer& observer, const std::stop_token& stop) {
    if (scenario.end_time != 13) return run(scenario, observer, stop);
    ++deadly;
    deadly.notify_all();
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait(lock, stop, [] { return false; });
    return Ending(Outcome::End::kStopped);
  };
  Open(options);
  for (int i = 0; i < 4; ++i) names.insert(Create(BouncingBall(1)));
  const std::set<std::string> first = names;
  const std::string bad = Create(BouncingBall(13));
  for (int i = 0; i < 16; ++i) names.insert(Create(BouncingBall(1)));
  for (int crash = 0; crash < 3; ++crash) {
    if (crash == 0) {
      run.Allow(4);  // So that it comes to the bad one.
      for (const std::string& name : first) Ended(name);
    }
    v1::ListJobsRequest running;
    running.add_states(v1::Job::RUNNING);
    // The deadly one, and beside it one that the crash puts under suspicion too.
    while (deadly == crash || List(running).value().jobs_size() < 2) std::this_thread::yield();
    Crash();
    Open(options);
  }
  run.Allow(100);
  EXPECT_EQ(Ended(bad).state_reason(), "CRASHED");
  EXPECT_EQ(deadly, 3);
  for (const std::string& name : names) EXPECT_EQ(Ended(name).state(), v1::Job::SUCCEEDED) << name;
}

TEST_F(LostRunTest, ShutdownsBurnNoAttempt) {
  std::string name;
  for (int i = 0; i < 5; ++i) {
    OpenWithFakeRun();
    if (i == 0) name = Create();
    run_.AwaitStarted(i + 1);
    manager_->Stop();
  }
  OpenWithFakeRun();
  run_.Allow();
  EXPECT_EQ(Ended(name).attempt(), 1);
}

TEST_F(LostRunTest, WhatCannotChangeIsNotTriedAgain) {
  using End = Outcome::End;
  for (const End end : {End::kNumeric, End::kBudgetSteps, End::kNotConverged}) {
    std::atomic<int> runs = 0;
    JobOptions options;
    options.run = [&](const auto&, auto&, const auto&) {
      ++runs;
      return Ending(end, "no");
    };
    Open(options);
    const std::string name = Create();
    EXPECT_EQ(Ended(name).state(), v1::Job::FAILED);
    Open(options);
    EXPECT_EQ(Ended(name).attempt(), 1);
    EXPECT_EQ(runs, 1);
  }
}

// Runs of a second at least, by the way in which they keep a worker busy.
std::map<std::string, v1::CreateJobRequest> LongRuns() {
  v1::Scenario fixed = BouncingBall();
  fixed.mutable_solver()->set_method(v1::Solver::RK4);
  fixed.mutable_solver()->set_step_s(1e-3);
  fixed.mutable_solver()->set_max_steps(1'000'000'000);
  v1::Scenario dense = BouncingBall(100);  // Millions of samples between two bounces.
  dense.mutable_contacts(0)->set_stiffness(1e-3);
  dense.clear_loads();
  dense.mutable_bodies(0)->set_position_m(10);
  dense.mutable_output()->set_sample_interval_s(1.1e-5);
  v1::Scenario chain;  // One long episode of many unknowns.
  for (int i = 0; i < 60; ++i) {
    v1::Body& ball = *chain.add_bodies();
    ball.set_name("b" + std::to_string(i));
    ball.set_mass_kg(0.5);
    ball.set_radius_m(0.05);
    ball.set_position_m(0.1 * i);
    if (i == 0) ball.set_velocity_m_per_s(1);
    if (i == 0) continue;
    v1::Contact& contact = *chain.add_contacts();
    contact.add_between("b" + std::to_string(i - 1));
    contact.add_between(ball.name());
    contact.set_stiffness(1e8);
    contact.set_restitution(0.9);
  }
  chain.set_end_time_s(1);
  v1::CreateJobRequest sweep;
  *sweep.mutable_job()->mutable_sweep()->mutable_base() = BouncingBall();
  v1::Sweep::Axis& axis = *sweep.mutable_job()->mutable_sweep()->add_axes();
  axis.set_field("bodies[0].mass_kg");
  for (int i = 1; i < 20; ++i) axis.add_values(i);
  sweep.mutable_job()->mutable_sweep()->add_metrics("iterations");
  return {{"bounces", RequestFor(BouncingBall())},
          {"fixed step", RequestFor(fixed)},
          {"dense samples", RequestFor(dense)},
          {"long episode", RequestFor(chain)},
          {"sweep with helpers", sweep}};
}

TEST_F(LostRunTest, CancelTakesEffectAtOnceWhateverTheRunDoes) {
  Open({.workers = 3});
  for (const auto& [what, request] : LongRuns()) {
    const auto created = Create(request);
    ASSERT_TRUE(created.ok()) << what << ": " << created.error().message;
    const std::string name = created.value().name();
    // Into the run: it has told progress, or recorded more than that it has begun.
    v1::Job job;
    for (job = Get(name).value();
         job.state() == v1::Job::QUEUED || (!job.has_progress() && job.last_sequence() <= 3);
         job = Get(name).value()) {
      std::this_thread::yield();
    }
    ASSERT_EQ(job.state(), v1::Job::RUNNING) << what << " is too short";
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_TRUE(Cancel(name).ok());
    EXPECT_EQ(Ended(name).state(), v1::Job::CANCELLED) << what;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    RecordProperty(what, std::to_string(took.count()));
    std::printf("cancel of %s: %.3f s\n", what.c_str(), took.count());
    EXPECT_LT(took.count(), 2.5) << what << ": 0.5 s, on a machine five times slower";
  }
}

TEST_F(LostRunTest, BudgetOfASweepHoldsForAllItsCells) {
  Open({.workers = 3});
  v1::CreateJobRequest request = LongRuns().at("sweep with helpers");
  request.mutable_job()->mutable_sweep()->mutable_base()->set_end_time_s(1);
  v1::CreateJobRequest limited = request;
  limited.mutable_job()->mutable_budget()->set_steps(1000);
  const v1::Job job = Ended(Create(limited).value().name());
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "BUDGET_STEPS");
  EXPECT_GT(job.progress().cells_done(), 0) << "what it recorded is kept";
  EXPECT_LT(job.progress().cells_done(), 19);
  limited.mutable_job()->mutable_budget()->set_steps(1'000'000);
  EXPECT_EQ(Ended(Create(limited).value().name()).state(), v1::Job::SUCCEEDED);
}

TEST_F(LostRunTest, HangingCellEndsItsSweepAndFreesBothWorkers) {
  std::promise<void> release;
  const auto released = release.get_future().share();
  JobOptions options{.workers = 2};
  std::atomic<int> back = 0;
  options.run = [&](const Scenario& scenario, Observer&, const std::stop_token&) {
    if (scenario.bodies[0].mass != 7) return Outcome{};
    released.wait();
    ++back;
    return Outcome{};
  };
  Open(LookOften(options));
  const std::string name = Create(LongRuns().at("sweep with helpers")).value().name();
  const v1::Job job = EndedInTime(name);
  EXPECT_EQ(job.state_reason(), "STALLED");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Ended(Create()).state(), v1::Job::SUCCEEDED);
  release.set_value();
  manager_->Stop();
  EXPECT_EQ(back, 1);
  EXPECT_EQ(Get(name).value().SerializeAsString(), job.SerializeAsString());
}

TEST_F(LostRunTest, RetriesOfManyThreadsMakeOneJob) {
  OpenWithFakeRun();
  constexpr int kThreads = 16;
  constexpr int kCalls = 1000;
  std::vector<Await<Result<v1::Job>>> answers(kCalls);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = thread; i < kCalls; i += kThreads) {
        manager_->creator().Create(LocalPrincipal(), RequestFor(BouncingBall(), "once"),
                                   answers[static_cast<std::size_t>(i)].callback());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::set<std::string> names;
  for (auto& answer : answers) names.insert(answer.Get().value().name());
  EXPECT_EQ(names.size(), 1U);
  EXPECT_EQ(List({}).value().jobs_size(), 1);
  v1::CreateJobRequest other = RequestFor(BouncingBall(), "once");
  other.mutable_job()->set_priority(3);
  EXPECT_EQ(Create(other).error().reason, "REQUEST_ID_REUSED");
}

}  // namespace
}  // namespace contact
