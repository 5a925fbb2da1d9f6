#include "cli/text/comparison/signal_comparison.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/base/failure.h"
#include "cli/text/comparison/render_signals.h"
#include "cli/verbs/measured_comparison.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

double Pulse(double time) { return 100 * std::exp(-std::pow((time - 0.5) / 0.05, 2)); }

// A pulse of 100 N at 0.5 s, sampled every millisecond.
Recording PulseRecording() {
  Recording run;
  run.job.set_name("jobs/r");
  run.columns = {{"time", "time", "s", {}}, {"C.contact_force", "contact_force", "N", {}}};
  for (int i = 0; i <= 1000; ++i) {
    run.columns[0].values.push_back(i * 1e-3);
    run.columns[1].values.push_back(Pulse(i * 1e-3));
  }
  return run;
}

// The pulse as a recorder has it whose clock is behind by `lag`, with an error that alternates.
MeasuredSignal Measured(double lag = 0, double error = 0) {
  MeasuredSignal signal{"C.contact_force", "N"};
  for (int i = 0; i < 400; ++i) {
    const double time = 0.3 + i * 1.01e-3;
    signal.times.push_back(time - lag);
    signal.values.push_back(Pulse(time) + (i % 2 == 0 ? error : -error));
  }
  return signal;
}

SignalComparison Compared(const MeasuredSignal& signal, double shift = 0,
                          const SignalTolerance& common = {}) {
  return Compare({signal}, PulseRecording(), shift, common, {});
}

TEST(SignalComparison, ErrorsAreThoseThatWereMade) {
  const SignalComparison comparison = Compared(Measured(0, 2));
  ASSERT_EQ(comparison.rows.size(), 1U);
  const SignalComparison::Row& row = comparison.rows[0];
  EXPECT_EQ(row.points, 400U);
  EXPECT_EQ(row.outside, 0U);
  EXPECT_NEAR(row.rms, 2, 0.01);
  EXPECT_NEAR(std::abs(row.largest), 2, 0.02);
  EXPECT_NEAR(row.measured_peak, 102, 0.1);
  EXPECT_EQ(row.simulated_peak, 100);
  EXPECT_NEAR(row.allowed, 5.1, 0.01);
  EXPECT_TRUE(comparison.Holds());
}

TEST(SignalComparison, BetweenSamplesTheRunIsInterpolated) {
  MeasuredSignal signal{"C.contact_force", "N", {0.5005}, {0}};
  EXPECT_NEAR(Compared(signal).rows[0].largest, -(Pulse(0.5) + Pulse(0.501)) / 2, 1e-9);
}

TEST(SignalComparison, ToleranceIsTheLargerOfBothAndThatOfTheChannelComesFirst) {
  const MeasuredSignal signal = Measured(0, 2);
  EXPECT_FALSE(Compared(signal, 0, {.absolute = 1, .relative = 0.01}).Holds());
  EXPECT_TRUE(Compared(signal, 0, {.absolute = 3, .relative = 0.01}).Holds());
  EXPECT_TRUE(Compared(signal, 0, {.absolute = 1, .relative = 0.03}).Holds());
  const auto own = [&](const SignalTolerance& tolerance) {
    return Compare({signal}, PulseRecording(), 0, {.absolute = 50},
                   {{"C.contact_force", tolerance}})
        .Holds();
  };
  EXPECT_FALSE(own({.absolute = 1, .relative = 0}));
  EXPECT_TRUE(own({.absolute = 3, .relative = 0}));
}

TEST(SignalComparison, ALateClockDiffersUntilItIsShifted) {
  const MeasuredSignal late = Measured(0.04);
  EXPECT_FALSE(Compared(late).Holds());
  EXPECT_TRUE(Compared(late, 0.04).Holds());
}

TEST(SignalComparison, PointsOutsideOfTheRunDoNotCount) {
  const MeasuredSignal signal{"C.contact_force", "N", {-1, 0.5, 2}, {1e9, 100, 1e9}};
  const SignalComparison comparison = Compared(signal);
  EXPECT_EQ(comparison.rows[0].points, 1U);
  EXPECT_EQ(comparison.rows[0].outside, 2U);
  EXPECT_TRUE(comparison.Holds());
  EXPECT_THROW(Compared(signal, 10), Failure);
}

TEST(FitShift, FindsTheLagOfTheClock) {
  for (const double lag : {-0.0123, 0.0, 0.04}) {
    EXPECT_NEAR(FitShift({Measured(lag, 1)}, PulseRecording(), {-0.1, 0.1}), lag, 1e-4) << lag;
  }
}

TEST(FitShift, StaysWithinItsRange) {
  EXPECT_NEAR(FitShift({Measured(0.04)}, PulseRecording(), {-0.01, 0.01}), 0.01, 1e-9);
}

TEST(FitShift, ShiftsThatLeaveHalfOfThePointsOutsideAreNone) {
  EXPECT_THROW(FitShift({Measured()}, PulseRecording(), {5, 6}), Failure);
}

TEST(ReadTolerances, AreNumbersWithUnitsOrPercentages) {
  const std::vector<MeasuredSignal> signals = {{"C.contact_force", "N"}, {"B.velocity", "m/s"}};
  const auto read = ReadTolerances({"C.contact_force=0.5 kN", "B.velocity=3%"}, signals);
  EXPECT_EQ(read.at("C.contact_force").absolute, 500);
  EXPECT_EQ(read.at("C.contact_force").relative, 0);
  EXPECT_EQ(read.at("B.velocity").absolute, 0);
  EXPECT_DOUBLE_EQ(read.at("B.velocity").relative, 0.03);
  EXPECT_EQ(ReadTolerances({"B.velocity=2e-3"}, signals).at("B.velocity").absolute, 2e-3);
  for (const char* wrong : {"B.velocity=", "B.velocity=-1", "B.velocity=3 N", "B.velocity=x",
                            "B.velocty=1", "B.velocity"}) {
    EXPECT_THROW(ReadTolerances({wrong}, signals), Failure) << wrong;
  }
}

TEST(RenderSignals, AllFormsHaveTheSameNumbers) {
  SignalComparison comparison = Compared(Measured(0, 2), 0, {.absolute = 1, .relative = 0});
  comparison.file = "m.csv";
  const std::string text = RenderSignals(comparison, {});
  EXPECT_THAT(text, HasSubstr("C.contact_force [N]"));
  EXPECT_THAT(text, HasSubstr("DIFFERS"));
  EXPECT_THAT(text, HasSubstr("jobs/r and m.csv: DIFFERENT: not within tolerance"));
  EXPECT_THAT(text, Not(HasSubstr("simulated time")));  // Nothing was shifted.
  const auto json = nlohmann::json::parse(SignalsJson(comparison));
  EXPECT_EQ(json["signals"][0]["rms"], comparison.rows[0].rms);
  EXPECT_EQ(json["holds"], false);
  EXPECT_FALSE(json.contains("fitted_between_s"));
  EXPECT_THAT(SignalsCsv(comparison), HasSubstr("\nC.contact_force,N,400,0,"));
  comparison.shift = 1e-3;
  comparison.fitted = TimeRange{-1, 1};
  EXPECT_THAT(RenderSignals(comparison, {}),
              HasSubstr("simulated time = measured time +0.001 s, the best shift in [-1, 1] s"));
}

}  // namespace
}  // namespace contact::cli
