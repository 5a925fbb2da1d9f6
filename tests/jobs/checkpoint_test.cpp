// A long run that the server's death has cut goes on from its last checkpoint.
#include <SQLiteCpp/SQLiteCpp.h>

#include <thread>

#include "jobs/job/lifecycle.h"
#include "jobs/log/job_log.h"
#include "jobs/run/assignment.h"
#include "jobs/run/log_writer.h"
#include "jobs/run/replay.h"
#include "jobs/run/run_recorder.h"
#include "jobs/run/run_state_codec.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using std::chrono::seconds;

// Passes on what a run tells, and makes a second pass before each boundary. At one of them the run
// hangs until it is stopped.
class Interrupter final : public Observer {
 public:
  Interrupter(Observer& observer, FakeClock& clock, std::stop_token stop, int hang_at)
      : observer_(observer), clock_(clock), stop_(std::move(stop)), hang_at_(hang_at) {}

  void OnIteration(const Iteration& iteration) override { observer_.OnIteration(iteration); }
  void OnCycle(const Cycle& cycle) override { observer_.OnCycle(cycle); }
  void OnGrowth(const Group& group) override { observer_.OnGrowth(group); }
  void OnGroup(const Group& group) override { observer_.OnGroup(group); }
  void OnSamples(const Samples& samples) override { observer_.OnSamples(samples); }
  void OnProgress(const Progress& progress) override { observer_.OnProgress(progress); }
  void OnWarning(const std::string& warning) override { observer_.OnWarning(warning); }
  void OnStep() override { observer_.OnStep(); }
  void OnBoundary(const std::function<RunState()>& state) override {
    clock_.Advance(seconds(1));
    observer_.OnBoundary(state);
    if (++boundaries_ != hang_at_) return;
    while (!stop_.stop_requested()) {
      observer_.OnProgress({});  // Lets the log be written.
      std::this_thread::yield();
    }
  }

 private:
  Observer& observer_;
  FakeClock& clock_;
  const std::stop_token stop_;
  const int hang_at_;
  int boundaries_ = 0;
};

class CheckpointTest : public JobsTest {
 protected:
  static constexpr int kNever = -1;

  // The real solver; runs that begin anew hang at a boundary.
  JobOptions Options(int hang_at) {
    JobOptions options;
    options.checkpoint_interval = seconds(1);
    options.run = [this, hang_at](const Scenario& scenario, Observer& observer,
                                  const std::stop_token& stop) {
      ++begun_;
      Interrupter interrupter(observer, clock_, stop, hang_at);
      return contact::Run(scenario, interrupter, stop);
    };
    options.resume = [this](const Scenario& scenario, const RunState& from, Observer& observer,
                            const std::stop_token& stop) {
      resumed_from_.push_back(from.state.time);
      return contact::Resume(scenario, from, observer, stop);
    };
    return options;
  }

  StoredJob Stored(const std::string& name) {
    Await<absl::StatusOr<StoredJob>> job;
    store_->Read(name, JobPart::kRun, job.callback());
    return *job.Get();
  }

  // Starts the job, and kills the server once a checkpoint after so many events is stored.
  std::string CutShort(std::uint64_t sequence) {
    Open(Options(60));
    std::string name = Create(Bouncing());
    while (Stored(name).checkpoint_sequence < sequence) std::this_thread::yield();
    Crash();
    return name;
  }

  static v1::Scenario Bouncing() {
    v1::Scenario scenario = BouncingBall(10);
    scenario.mutable_output()->set_sample_interval_s(0.01);
    scenario.mutable_contacts(0)->set_restitution(0.99);
    return scenario;
  }

  // The durable events of the last attempt, without times and places; and the result.
  std::vector<std::string> Told(const std::string& name) {
    const v1::Job job = Ended(name);
    std::vector<std::string> told;
    for (v1::Event event : Log(name)) {
      if (event.has_attempt_started()) told.clear();
      if (event.has_attempt_started() || event.has_progress()) continue;
      event.clear_sequence();
      event.clear_event_time();
      told.push_back(event.SerializeAsString());
    }
    v1::Job result;
    EXPECT_GT(job.groups_size(), 0);
    *result.mutable_cycles() = job.cycles();
    *result.mutable_groups() = job.groups();
    *result.mutable_final_bodies() = job.final_bodies();
    *result.mutable_warnings() = job.warnings();
    *result.mutable_summary() = job.summary();
    result.mutable_summary()->clear_wall_time_s();
    told.push_back(result.SerializeAsString());
    return told;
  }

  // Where each attempt that the log tells of began; none: at the start.
  std::vector<std::optional<double>> Starts(const std::string& name) {
    std::vector<std::optional<double>> starts;
    for (const v1::Event& event : Log(name, 0, {"attempt_started"})) {
      if (!event.has_attempt_started()) continue;
      const v1::AttemptStarted& start = event.attempt_started();
      starts.push_back(start.has_resume_time_s() ? std::optional(start.resume_time_s())
                                                 : std::nullopt);
    }
    return starts;
  }

  int begun_ = 0;
  std::vector<double> resumed_from_;
};

TEST_F(CheckpointTest, RunGoesOnToTheSameBytes) {
  Open(Options(kNever));
  const std::vector<std::string> undisturbed = Told(Create(Bouncing()));
  const std::string name = CutShort(40);
  Open(Options(kNever));
  EXPECT_EQ(Told(name), undisturbed);
  ASSERT_EQ(resumed_from_.size(), 1U);
  EXPECT_GT(resumed_from_[0], 0);
  EXPECT_THAT(Starts(name), testing::ElementsAre(std::nullopt, resumed_from_[0]));
  EXPECT_EQ(begun_, 2) << "only the first attempts began at the beginning";
  EXPECT_EQ(Get(name).value().attempt(), 2);
}

TEST_F(CheckpointTest, ItGoesWithTheEndOfTheJob) {
  Open(Options(kNever));
  const std::string name = Create(Bouncing());
  Ended(name);
  EXPECT_TRUE(Stored(name).checkpoint.empty());
}

TEST_F(CheckpointTest, ThereIsNoneBeforeItsTime) {
  JobOptions options = Options(30);
  options.checkpoint_interval = seconds(100);
  Open(options);
  const std::string name = Create(Bouncing());
  while (Stored(name).job.last_sequence() < 10) std::this_thread::yield();
  EXPECT_TRUE(Stored(name).checkpoint.empty());
}

TEST_F(CheckpointTest, DamagedOneIsAsNone) {
  Open(Options(kNever));
  const std::vector<std::string> undisturbed = Told(Create(Bouncing()));
  const std::string name = CutShort(40);
  SQLite::Database(directory_.path() / "contactd.db", SQLite::OPEN_READWRITE)
      .exec("UPDATE checkpoints SET state=zeroblob(100)");
  Open(Options(kNever));
  EXPECT_EQ(Told(name), undisturbed);
  EXPECT_TRUE(resumed_from_.empty());
  EXPECT_THAT(Starts(name), testing::ElementsAre(std::nullopt, std::nullopt));
}

TEST_F(CheckpointTest, RunWhoseEventsAreDamagedBeginsAnew) {
  Open(Options(kNever));
  const std::vector<std::string> undisturbed = Told(Create(Bouncing()));
  const std::string name = CutShort(40);
  SQLite::Database(directory_.path() / "contactd.db", SQLite::OPEN_READWRITE)
      .exec("UPDATE events SET payload=zeroblob(9) WHERE job=2 AND sequence=30");
  Open(Options(kNever));
  EXPECT_EQ(Told(name), undisturbed);
  EXPECT_TRUE(resumed_from_.empty());
  ASSERT_EQ(Starts(name).size(), 3U) << "the attempt tells that it begins anew after all";
  EXPECT_EQ(Starts(name).back(), std::nullopt);
}

// A run that went on all the same told of its last samples, but not of those before them.
TEST_F(CheckpointTest, ReplayThatIsStoppedIsNotComplete) {
  Open(Options(kNever));
  const std::string name = Create(Bouncing());
  const std::uint64_t last = Ended(name).last_sequence();
  const Assignment assignment{};
  const auto control = std::make_shared<RunControl>();
  const auto writer = std::make_shared<LogWriter>(
      *store_, clock_, LogWriter::Place{"jobs/other", 0, nullptr}, control, std::stop_token());
  const Scenario scenario;
  RunRecorder recorder(scenario, clock_, assignment, *writer, seconds(1));
  control->Stop();
  EXPECT_FALSE(Replay(*store_, name, last, *control, recorder));
}

TEST(RunStateCodec, AsksForNoMoreMemoryThanItsBytes) {
  const std::string bytes = EncodeRunState({});
  // Any eight bytes may be the length of a list.
  for (std::size_t i = 0; i + 8 <= bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged.replace(i, 8, "\xff\xff\xff\xff\xff\xff\xff\x0f");
    EXPECT_NO_THROW(DecodeRunState(damaged)) << i;
  }
}

TEST(RunStateCodec, RefusesTheBytesOfAnotherBuild) {
  RunState state;
  state.state.time = 1.5;
  state.state.slips = {{.slack = 0.5, .side = -1}};
  state.sampling.pending.values = {1, kNaN};
  const std::string bytes = EncodeRunState(state);
  ASSERT_TRUE(DecodeRunState(bytes).has_value());
  EXPECT_EQ(EncodeRunState(*DecodeRunState(bytes)), bytes);
  EXPECT_EQ(DecodeRunState(bytes)->state.slips.at(0).side, -1);
  std::string other = bytes;
  ++other[8];  // The first letter of the version, after its length.
  EXPECT_FALSE(DecodeRunState(other).has_value());
  EXPECT_FALSE(DecodeRunState(bytes.substr(0, bytes.size() - 1)).has_value());
  EXPECT_FALSE(DecodeRunState("").has_value());
}

}  // namespace
}  // namespace contact
