#include "simulation/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/course/sample_log.h"
#include "simulation/run.h"
#include "testing/cases.h"

namespace contact {
namespace {

// Free flights have no cycles.
class NoCycles final : public CycleHost {
 public:
  Factor OnStart(ContactState&, double, double) override { return {}; }
  void OnEnd(ContactState&, const Eigen::ArrayXd&, const Eigen::ArrayXd&, double, double) override {
  }
};

struct Chunks final : Observer {
  std::vector<Samples> chunks;
  void OnSamples(const Samples& samples) override { chunks.push_back(samples); }

  std::vector<double> Values() const {
    std::vector<double> values;
    for (const Samples& s : chunks) values.insert(values.end(), s.values.begin(), s.values.end());
    return values;
  }
};

// Expects that each chunk begins where the one before it ends, and the first at 0; the number of
// samples.
std::int64_t ExpectNoHole(const std::vector<Samples>& chunks) {
  std::int64_t next = 0;
  for (const Samples& chunk : chunks) {
    EXPECT_EQ(chunk.first, next);
    next += chunk.rows();
  }
  return next;
}

// A ball that flies from x = 1 with 3 m/s, sampled at equal intervals until t = 1.
struct Flight {
  Scenario scenario;
  Motion motion{scenario};
  Chunks observer;
  std::stop_source stop;
  Sampler sampler{scenario, motion, observer, stop.get_token()};
  NoCycles host;

  explicit Flight(double interval) : scenario(OneBall(interval)) {
    motion.Begin(InitialState(scenario), true);
    sampler.RecordStart(InitialState(scenario));
  }
  static Scenario OneBall(double interval) {
    Scenario s;
    s.bodies = {testing::Ball(1, 3)};
    s.end_time = 1;
    s.sample_interval = interval;
    return s;
  }
  // Goes on from where the motion is.
  void FlyUntil(double time) {
    motion.Begin(motion.Save(), true);
    ASSERT_EQ(motion.Advance(time, host, &sampler, {}, 1'000'000), Motion::Pause::kTimeUp);
  }
};

TEST(Sampler, RowsLieOnTheTrajectoryAtEqualIntervals) {
  Flight flight(1e-3);
  flight.FlyUntil(1);
  flight.sampler.Flush();
  const std::vector<double> values = flight.observer.Values();
  ASSERT_EQ(values.size(), 9u * 1001);
  for (std::size_t i = 0; i <= 1000; ++i) {
    const double t = static_cast<double>(i) * 1e-3;
    EXPECT_NEAR(values[9 * i], t, 1e-15);
    EXPECT_NEAR(values[9 * i + 1], 1 + 3 * t, 1e-13);
    EXPECT_NEAR(values[9 * i + 2], 3, 1e-13);
  }
  EXPECT_EQ(values[9000], 1);  // The end itself, whatever 1000 times the interval is.
}

TEST(Sampler, ChunksAreFullButTheLastAndFollowEachOther) {
  Flight flight(1e-3);
  flight.FlyUntil(1);
  constexpr std::size_t kFull = 1001 / kSamplesPerChunk;
  EXPECT_EQ(flight.observer.chunks.size(), kFull);
  EXPECT_EQ(flight.sampler.Save().pending.rows(), 1001 % kSamplesPerChunk);
  flight.sampler.Flush();
  flight.sampler.Flush();  // Nothing is left.
  ASSERT_EQ(flight.observer.chunks.size(), kFull + 1);
  EXPECT_EQ(ExpectNoHole(flight.observer.chunks), 1001);
  for (const Samples& chunk : flight.observer.chunks) EXPECT_EQ(chunk.columns, 9);
}

TEST(Sampler, AnIntervalThatDoesNotDivideTheRunEndsBefore) {
  Flight flight(0.3);
  flight.FlyUntil(1);
  EXPECT_EQ(flight.sampler.Save().pending.rows(), 4);
  EXPECT_NEAR(flight.sampler.Save().pending.values[27], 0.9, 1e-15);
}

TEST(Sampler, WithoutAnIntervalThereAreNoSamples) {
  Flight flight(0);
  flight.FlyUntil(1);
  flight.sampler.Flush();
  EXPECT_TRUE(flight.observer.chunks.empty());
}

// However a run is cut in stretches.
TEST(Sampler, StretchesMakeNoDifferenceToTheTimes) {
  Flight whole(1e-3), pieces(1e-3);
  whole.FlyUntil(1);
  for (const double time : {0.1, 0.1005, 0.4, 0.4 + 1e-12, 1.0}) pieces.FlyUntil(time);
  whole.sampler.Flush();
  pieces.sampler.Flush();
  const std::vector<double> a = whole.observer.Values(), b = pieces.observer.Values();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
}

// Both fly on until t = 1; `straight`, which has not begun, makes a stretch until `time` first.
void ExpectSameAtTheEnd(Flight& flight, Flight& straight, double time) {
  flight.FlyUntil(1);
  flight.sampler.Flush();
  straight.FlyUntil(time);
  straight.FlyUntil(1);
  straight.sampler.Flush();
  EXPECT_EQ(flight.observer.Values(), straight.observer.Values());
}

TEST(Sampler, WhatIsTakenBackIsTakenAgain) {
  Flight flight(1e-3), straight(1e-3);
  flight.FlyUntil(0.1);
  const State before = flight.motion.Save();
  flight.sampler.Hold();
  flight.FlyUntil(0.9);
  EXPECT_TRUE(flight.observer.chunks.empty());  // Though some chunks are full.
  flight.sampler.TakeBack();
  EXPECT_EQ(flight.sampler.Save().pending.rows(), 101);
  flight.motion.Begin(before, true);
  ExpectSameAtTheEnd(flight, straight, 0.1);
}

TEST(Sampler, WhatIsHeldComesInOrderWhenReleased) {
  Flight flight(1e-3), straight(1e-3);
  flight.sampler.Hold();
  flight.FlyUntil(0.9);
  EXPECT_TRUE(flight.observer.chunks.empty());
  flight.sampler.Release();
  EXPECT_EQ(flight.observer.chunks.size(), 901u / kSamplesPerChunk);
  ExpectSameAtTheEnd(flight, straight, 0.9);
}

TEST(Sampler, OfWhatIsHeldNothingFollowsAHoleOnceTheRunIsStopped) {
  Flight flight(1e-3);
  flight.sampler.Hold();
  flight.FlyUntil(0.9);
  flight.stop.request_stop();
  flight.sampler.Release();
  flight.sampler.Flush();
  EXPECT_TRUE(flight.sampler.cut_short());
  ExpectNoHole(flight.observer.chunks);
}

TEST(Sampler, AnotherOneGoesOnWithWhatWasPending) {
  Flight flight(1e-3), later(1e-3);
  flight.FlyUntil(1.5e-3 * kSamplesPerChunk);
  later.sampler.Restore(flight.sampler.Save());
  later.motion.Begin(flight.motion.Save(), true);
  later.FlyUntil(1);
  later.sampler.Flush();
  ASSERT_EQ(flight.observer.chunks.size(), 1u);
  EXPECT_EQ(later.observer.chunks.front().first, kSamplesPerChunk);
  flight.FlyUntil(1);
  flight.sampler.Flush();
  std::vector<double> values = flight.observer.chunks.front().values;
  const std::vector<double> rest = later.observer.Values();
  values.insert(values.end(), rest.begin(), rest.end());
  EXPECT_EQ(values, flight.observer.Values());
}

TEST(Sampler, ManyColumnsMakeShortChunksThatFitMessages) {
  Scenario many = Flight::OneBall(1e-3);
  many.bodies.resize(1000, many.bodies.front());
  Chunks chunks;
  contact::Run(many, chunks, {});
  EXPECT_EQ(ExpectNoHole(chunks.chunks), 1001);
  for (const Samples& chunk : chunks.chunks) {
    EXPECT_LE(chunk.values.size(), std::size_t{kValuesPerChunk});
    EXPECT_GT(chunk.rows(), chunk.first < 1000 - 65 ? kValuesPerChunk / 3006 - 1 : 0);
  }
  EXPECT_EQ(RowsPerChunk(kValuesPerChunk + 1), 1);
}

// A chunk waits for its 128th row, or for so many steps that a watcher would see no motion.
TEST(Sampler, ChunksThatFillSlowlyAreHandedOutBySteps) {
  Scenario slow = Flight::OneBall(1.0 / 200);
  slow.solver.fixed_step = 2.5e-6;
  struct Slow final : Observer {
    std::int64_t steps = 0, last = 0, longest = 0;
    std::vector<Samples> chunks;
    void OnStep() override { ++steps; }
    void OnSamples(const Samples& samples) override {
      longest = std::max(longest, steps - std::exchange(last, steps));
      chunks.push_back(samples);
    }
  } seen;
  contact::Run(slow, seen, {});
  EXPECT_EQ(ExpectNoHole(seen.chunks), 201);
  EXPECT_GT(seen.chunks.size(), 5u);
  EXPECT_LT(seen.longest, (1 << 19) / seen.chunks[0].columns + 2000);  // That of a row.
}

TEST(Sampler, TheLongerARunIsTheMoreRarelyChunksAreHandedOutBySteps) {
  const Scenario s = Flight::OneBall(1e-5);
  std::size_t chunks = 0;
  SampleLog log(s, {}, [&](const Samples&) { ++chunks; });
  constexpr std::int64_t kStepsPerRow = 100'000;  // For a row; 58,000 are due at first.
  for (std::int64_t row = 0; row <= 100'000; ++row) {
    log.TakeUntil(
        1e-5 * static_cast<double>(row), {}, {}, kStepsPerRow * row,
        [](double, std::vector<double>* values) { values->resize(9 * (values->size() / 9 + 1)); });
  }
  // 64 (1 + ln(t/t₀)) until 128 rows are a 64th of the run, then full ones: 410 and 720.
  EXPECT_GT(chunks, 1000U);
  EXPECT_LT(chunks, 1200U);
}

TEST(Sampler, AStopEndsAStepOfManySamplesAfterAChunk) {
  Flight flight(1e-6);
  flight.stop.request_stop();
  flight.FlyUntil(1);
  EXPECT_TRUE(flight.sampler.cut_short());
  ASSERT_EQ(flight.observer.chunks.size(), 1u);
  EXPECT_EQ(flight.observer.chunks[0].rows(), kSamplesPerChunk);
}

// Asks its run to stop before the given step.
struct Stopping final : Observer {
  std::int64_t steps = 0;
  std::stop_source stop;
  Chunks chunks;
  explicit Stopping(std::int64_t before) : steps(before) {}
  void OnStep() override {
    if (steps-- == 0) stop.request_stop();
  }
  void OnSamples(const Samples& samples) override { chunks.OnSamples(samples); }
};

TEST(Sampler, ARunStoppedBeforeAnyOfItsStepsHasNoHole) {
  Scenario chain = testing::TripleChain();
  chain.sample_interval = chain.end_time / 1000;
  Stopping whole(-1);
  contact::Run(chain, whole, whole.stop.get_token());
  EXPECT_EQ(ExpectNoHole(whole.chunks.chunks), 1001);
  const std::int64_t count = -1 - whole.steps;
  ASSERT_GT(count, 50);
  for (std::int64_t step = 0; step < count; ++step) {
    Stopping stopped(step);
    contact::Run(chain, stopped, stopped.stop.get_token());
    ExpectNoHole(stopped.chunks.chunks);
  }
}

// Samples in cycles: of runs, for a flight has none.

using testing::Record;
using testing::RunAndRecord;

constexpr int kPerContact = 100;

// With a sample at each end, and those in cycles.
Record Sampled(Scenario s) {
  s.sample_interval = s.end_time;
  s.samples_per_contact = kPerContact;
  return RunAndRecord(s);
}

// The rows of samples from `start` to `end`, both included.
std::vector<int> RowsIn(const Record& r, double start, double end) {
  std::vector<int> rows;
  for (int i = 0; i < r.rows(); ++i) {
    if (r.Sample(i, 0) >= start && r.Sample(i, 0) <= end) rows.push_back(i);
  }
  return rows;
}

TEST(CycleSamples, AreEvenlySpreadFromTheStartOfEachCycle) {
  const Record r = Sampled(testing::Collision(0.3, 2, 5e7, 1.5, 0.7));
  ASSERT_EQ(r.cycles.size(), 1u);
  const Cycle& cycle = r.cycles[0];
  const std::vector<int> rows = RowsIn(r, cycle.start_time, cycle.end_time);
  EXPECT_GE(static_cast<int>(rows.size()), kPerContact * 9 / 10);
  EXPECT_LE(static_cast<int>(rows.size()), kPerContact * 2);
  const double spacing = r.Sample(rows[1], 0) - r.Sample(rows[0], 0);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_NEAR(r.Sample(rows[i], 0) - r.Sample(rows[i - 1], 0), spacing, 1e-9 * spacing);
  }
  EXPECT_LE(cycle.end_time - r.Sample(rows.back(), 0), spacing);
}

TEST(CycleSamples, ThatNobodyAskedForAreOnlyWhereThoseOfTheIntervalAreRarer) {
  Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.7);
  s.samples_per_contact = 20;
  s.wants_all_contact_samples = false;
  s.sample_interval = s.end_time / 1e5;
  EXPECT_EQ(RunAndRecord(s).rows(), 100'001);
  s.sample_interval = s.end_time;
  const Record r = RunAndRecord(s);
  const std::vector<int> rows = RowsIn(r, r.cycles.at(0).start_time, r.cycles.at(0).end_time);
  EXPECT_GE(static_cast<int>(rows.size()), 18);
  EXPECT_LE(static_cast<int>(rows.size()), 40);
}

TEST(CycleSamples, EveryBounceHasThemHoweverLongTheFlights) {
  const Record r = Sampled(testing::BouncingBall());
  ASSERT_GE(r.cycles.size(), 2u);
  for (const Cycle& cycle : r.cycles) {
    if (cycle.end != Cycle::End::kSeparation) continue;
    const std::vector<int> rows = RowsIn(r, cycle.start_time, cycle.end_time);
    EXPECT_GE(static_cast<int>(rows.size()), kPerContact * 9 / 10) << cycle.number;
  }
  EXPECT_LT(r.rows(), 3 * kPerContact * static_cast<int>(r.cycles.size()) + 2);
}

// The trapezoidal rule over the samples: the area of a loop is the energy lost.
TEST(CycleSamples, LoopsHaveTheAreaOfTheEnergyLost) {
  const Record r = Sampled(testing::BouncingBall());
  const Cycle& cycle = r.cycles.at(0);
  double area = 0;
  const std::vector<int> rows = RowsIn(r, cycle.start_time, cycle.end_time);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto value = [&](std::size_t at, int column) { return r.Sample(rows[at], column); };
    area += (value(i, 5) + value(i - 1, 5)) / 2 * (value(i, 3) - value(i - 1, 3));
  }
  const double lost = cycle.work_compression + cycle.work_restitution;
  EXPECT_NEAR(area, lost, 2e-3 * lost);
}

TEST(CycleSamples, ComeInTheOrderOfTimeBesideThoseOfTheInterval) {
  for (Scenario s : {testing::SpringWall(), testing::TripleChain(),
                     testing::Chain(std::vector<double>(6, 0.5), std::vector<double>(5, 1e8),
                                    std::vector<double>(5, 0.8), 0.2, 0.01)}) {
    s.sample_interval = s.end_time / 700;
    s.samples_per_contact = 30;
    const Record r = RunAndRecord(s);
    std::vector<double> times;
    for (int i = 0; i < r.rows(); ++i) times.push_back(r.Sample(i, 0));
    EXPECT_TRUE(std::ranges::is_sorted(times, std::less_equal()));  // Each once.
    EXPECT_GT(times.size(), 701u);
    for (int i = 0; i <= 700; ++i) {
      const auto found = std::ranges::lower_bound(times, i * s.sample_interval * (1 - 1e-12));
      ASSERT_NE(found, times.end()) << i;
      EXPECT_NEAR(*found, i * s.sample_interval, 1e-12 * s.end_time) << i;
    }
  }
}

TEST(CycleSamples, LieOnTheTrajectory) {
  Scenario s = testing::SpringWall();
  s.sample_interval = s.end_time;
  s.samples_per_contact = 50;
  const Record r = RunAndRecord(s);
  ASSERT_GT(r.rows(), 100);
  for (int i = 0; i < r.rows(); ++i) {
    const double t = r.Sample(i, 0), x = r.Sample(i, 1), v = r.Sample(i, 2);
    EXPECT_NEAR(r.Sample(i, 6), 500 + 250 * std::sin(2000 * t) - 1e6 * x - 100 * v, 1e-6) << i;
    EXPECT_NEAR(r.Sample(i, 3), x + 0.05 - 0.048, 1e-12) << i;
  }
}

TEST(CycleSamples, DoNotChangeTheResult) {
  const Scenario s = testing::TripleChain();
  const Record bare = RunAndRecord(s), sampled = Sampled(s);
  ASSERT_EQ(bare.cycles.size(), sampled.cycles.size());
  for (std::size_t i = 0; i < bare.cycles.size(); ++i) {
    EXPECT_EQ(bare.cycles[i].mu, sampled.cycles[i].mu);
    EXPECT_EQ(bare.cycles[i].end_time, sampled.cycles[i].end_time);
  }
}

// A damping far beyond use: after the turn the ball creeps back for many times the duration of the
// impact.
TEST(CycleSamples, OfACycleThatCreepsGrowOnlyWithEachDoubling) {
  Scenario s = testing::Collision(0.5, 1, 1e8, 1.5, 0.5);
  s.contacts[0].damping = DampingLaw::kGiven;
  s.contacts[0].mu = 1e10;
  s.end_time = 1;
  const Record r = Sampled(s);
  ASSERT_EQ(r.cycles.size(), 1u);
  EXPECT_GT(r.rows(), 2 * kPerContact);
  EXPECT_LT(r.rows(), 15 * kPerContact);
}

TEST(CycleSamples, OfAContactThatRestsThereAreNone) {
  Scenario s = testing::BouncingBall();
  s.end_time = 10;
  const Record r = Sampled(s);
  const Cycle& rest = r.cycles.back();
  ASSERT_EQ(rest.end, Cycle::End::kRunEnd);
  EXPECT_EQ(rest.status, Cycle::Status::kSettled);
  EXPECT_LE(RowsIn(r, std::nextafter(rest.start_time, s.end_time), s.end_time).size(), 1u);
}

TEST(CycleSamples, EndAtTheirLimitWithAWarning) {
  Scenario s = testing::TripleChain();
  s.most_contact_samples = 50;
  const Record r = Sampled(s);
  EXPECT_EQ(r.rows(), 52);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("samples_per_contact"), std::string::npos);
  EXPECT_TRUE(Sampled(testing::TripleChain()).warnings.empty());
}

// Of a second body that swings, while the ball still falls.
TEST(CycleSamples, AreAsManyAsTheirLimitHoweverManyExtremesThereAre) {
  Scenario s = testing::BouncingBall();
  s.bodies.push_back(testing::Ball(5));
  s.supports = {{.body = 1, .stiffness = 5e3, .rest_position = 4.9}};
  s.sample_interval = s.end_time;
  s.samples_per_contact = 20;
  s.most_contact_samples = 5;
  const Record without = RunAndRecord(s);
  ASSERT_EQ(without.rows(), 2 + 5);
  s.turning_channels = 5;
  const Record with = RunAndRecord(s);
  EXPECT_GT(with.rows(), 2 + 5);
  for (int row = 0; row < without.rows(); ++row) {
    const double time = without.Sample(row, 0);
    EXPECT_EQ(RowsIn(with, time, time).size(), 1u) << time;
  }
}

TEST(CycleSamples, WithoutATrajectoryThereAreNone) {
  Scenario s = testing::TripleChain();
  s.samples_per_contact = kPerContact;
  s.most_contact_samples = 0;
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.rows(), 0);
  EXPECT_TRUE(r.warnings.empty());
}

}  // namespace
}  // namespace contact
