#include "simulation/sampler.h"

#include <gtest/gtest.h>

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
  ASSERT_EQ(values.size(), 3u * 1001);
  for (std::size_t i = 0; i <= 1000; ++i) {
    const double t = static_cast<double>(i) * 1e-3;
    EXPECT_NEAR(values[3 * i], t, 1e-15);
    EXPECT_NEAR(values[3 * i + 1], 1 + 3 * t, 1e-13);
    EXPECT_NEAR(values[3 * i + 2], 3, 1e-13);
  }
  EXPECT_EQ(values[3000], 1);  // The end itself, whatever 1000 times the interval is.
}

TEST(Sampler, ChunksAreFullButTheLastAndFollowEachOther) {
  Flight flight(1e-3);
  flight.FlyUntil(1);
  EXPECT_EQ(flight.observer.chunks.size(), 3u);  // Those that are full.
  EXPECT_EQ(flight.sampler.pending().rows(), 1001 - 3 * kSamplesPerChunk);
  flight.sampler.Flush();
  flight.sampler.Flush();  // Nothing is left.
  ASSERT_EQ(flight.observer.chunks.size(), 4u);
  std::int64_t next = 0;
  for (const Samples& chunk : flight.observer.chunks) {
    EXPECT_EQ(chunk.first, next);
    EXPECT_EQ(chunk.columns, 3);
    next += chunk.rows();
  }
  EXPECT_EQ(next, 1001);
}

TEST(Sampler, AnIntervalThatDoesNotDivideTheRunEndsBefore) {
  Flight flight(0.3);
  flight.FlyUntil(1);
  EXPECT_EQ(flight.sampler.pending().rows(), 4);
  EXPECT_NEAR(flight.sampler.pending().values[9], 0.9, 1e-15);
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
  flight.FlyUntil(0.2);
  const State before = flight.motion.Save();
  flight.sampler.Hold();
  flight.FlyUntil(0.9);
  EXPECT_TRUE(flight.observer.chunks.empty());  // Though two chunks are full.
  flight.sampler.TakeBack();
  EXPECT_EQ(flight.sampler.pending().rows(), 201);
  flight.motion.Begin(before, true);
  ExpectSameAtTheEnd(flight, straight, 0.2);
}

TEST(Sampler, WhatIsHeldComesInOrderWhenReleased) {
  Flight flight(1e-3), straight(1e-3);
  flight.sampler.Hold();
  flight.FlyUntil(0.9);
  EXPECT_TRUE(flight.observer.chunks.empty());
  flight.sampler.Release();
  EXPECT_EQ(flight.observer.chunks.size(), 3u);
  ExpectSameAtTheEnd(flight, straight, 0.9);
}

TEST(Sampler, AnotherOneGoesOnWithWhatWasPending) {
  Flight flight(1e-3), later(1e-3);
  flight.FlyUntil(0.4);
  later.sampler.Restore(flight.sampler.pending());
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

TEST(Sampler, AStopEndsAStepOfManySamplesAfterAChunk) {
  Flight flight(1e-6);
  flight.stop.request_stop();
  flight.FlyUntil(1);
  EXPECT_TRUE(flight.sampler.cut_short());
  ASSERT_EQ(flight.observer.chunks.size(), 1u);
  EXPECT_EQ(flight.observer.chunks[0].rows(), kSamplesPerChunk);
}

}  // namespace
}  // namespace contact
