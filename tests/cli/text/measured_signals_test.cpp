#include "cli/text/comparison/measured_signals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Recording ShortRecording() {
  Recording run;
  run.job.set_name("jobs/r");
  run.columns = {{"time", "time", "s", {0, 1}},
                 {"B1.velocity", "velocity", "m/s", {0, 1}},
                 {"B1-B2.contact_force", "contact_force", "N", {0, 1}}};
  return run;
}

MeasuredTable Table(const std::vector<std::string>& headers,
                    const std::vector<std::vector<double>>& values) {
  std::string text = fmt::format("{}\n", fmt::join(headers, ","));
  for (std::size_t row = 0; row < values[0].size(); ++row) {
    for (const std::vector<double>& column : values) text += fmt::format("{},", column[row]);
    text += "\n";
  }
  return {"m.csv", text};
}

std::string Refused(const std::vector<std::string>& headers,
                    const std::map<std::string, std::string>& map = {}) {
  try {
    FindSignals(Table(headers, std::vector<std::vector<double>>(headers.size(), {1.0})),
                ShortRecording(), map);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    return failure.what();
  }
  return "no failure";
}

TEST(FindSignals, HeadersAreChannelsAndTheirUnitsBecomeSi) {
  const MeasuredSignals found =
      FindSignals(Table({"time [ms]", "B1.velocity [mm/s]", "B1-B2.contact_force [kN]"},
                        {{0, 500}, {1, 2}, {3, 4}}),
                  ShortRecording(), {});
  ASSERT_EQ(found.signals.size(), 2U);
  EXPECT_EQ(found.signals[0].channel, "B1.velocity");
  EXPECT_EQ(found.signals[0].unit, "m/s");
  EXPECT_THAT(found.signals[0].times, ElementsAre(0, 0.5));
  EXPECT_THAT(found.signals[0].values, ElementsAre(1e-3, 2e-3));
  EXPECT_THAT(found.signals[1].values, ElementsAre(3000, 4000));
  EXPECT_THAT(found.left_out, IsEmpty());
}

TEST(FindSignals, AMapJoinsOtherHeadersByNameOrWhole) {
  const MeasuredSignals found =
      FindSignals(Table({"clock [s]", "force_N", "v"}, {{0}, {7}, {3}}), ShortRecording(),
                  {{"clock", "time"}, {"force_N", "B1-B2.force"}, {"v", "B1.velocity [mm/s]"}});
  ASSERT_EQ(found.signals.size(), 2U);
  EXPECT_EQ(found.signals[0].channel, "B1-B2.contact_force");
  EXPECT_THAT(found.signals[0].values, ElementsAre(7));
  EXPECT_THAT(found.signals[1].values, ElementsAre(3e-3));
}

TEST(FindSignals, AUnitAfterTheLastUnderscoreIsTheUnitIfItFits) {
  const auto force = [](const std::string& header) {
    return FindSignals(Table({"t", header}, {{0}, {2}}), ShortRecording(),
                       {{header, "B1-B2.force"}})
        .signals[0]
        .values;
  };
  EXPECT_THAT(force("force_kN"), ElementsAre(2000));
  EXPECT_THAT(force("force_left"), ElementsAre(2));
  EXPECT_THAT(force("force"), ElementsAre(2));
}

TEST(FindSignals, WhatIsNoNumberOrNoChannelIsLeftOut) {
  const MeasuredSignals found =
      FindSignals(Table({"t", "B1.velocity", "temperature [K]"},
                        {{0, 1, std::nan("")}, {1, std::nan(""), 3}, {1, 1, 1}}),
                  ShortRecording(), {});
  EXPECT_THAT(found.signals[0].times, ElementsAre(0));
  EXPECT_THAT(found.left_out, ElementsAre("temperature [K]"));
}

TEST(FindSignals, WhatDoesNotFitIsToldWithWhatThereIs) {
  EXPECT_EQ(Refused({"t", "B1.velocity [N]"}),
            "column 'B1.velocity [N]': 'N' is no unit of a quantity in m/s");
  EXPECT_THAT(Refused({"x", "B1.velocity"}), HasSubstr("m.csv has no column time — it has x, B1"));
  EXPECT_THAT(
      Refused({"t", "speed"}),
      HasSubstr("no column is a channel of jobs/r; it has t, speed — channels are time, B1"));
  EXPECT_EQ(Refused({"t", "v"}, {{"v", "B1.velocty"}}),
            "--map: jobs/r recorded no 'B1.velocty' — did you mean 'B1.velocity'?");
  EXPECT_EQ(Refused({"t", "v"}, {{"w", "B1.velocity"}}),
            "--map w=B1.velocity: m.csv has no column 'w' — it has t, v");
}

}  // namespace
}  // namespace contact::cli
