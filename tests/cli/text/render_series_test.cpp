#include "cli/text/render_series.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/text/render_estimate.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

void Add(const std::string& name, const std::string& unit, const std::vector<double>& values,
         v1::Series* series) {
  auto& column = *series->add_columns();
  column.set_name(name);
  column.set_quantity(name);
  column.set_unit(unit);
  column.set_values(values.data(), values.size() * sizeof(double));
}

v1::Series Series(const std::vector<double>& forces = {0.1, NAN}) {
  v1::Series series;
  series.set_name("jobs/a");
  series.set_samples(static_cast<int>(forces.size()));
  series.set_recorded_samples(series.samples());
  std::vector<double> time;
  for (std::size_t i = 0; i < forces.size(); ++i) time.push_back(static_cast<double>(i));
  Add("time", "s", time, &series);
  Add("B\"1\".external_force", "N", forces, &series);
  return series;
}

TEST(SeriesJson, EscapesNamesAndHasNullForNaN) {
  const auto json = nlohmann::json::parse(SeriesJson(Series()));
  EXPECT_EQ(json["name"], "jobs/a");
  EXPECT_EQ(json["samples"], 2);
  EXPECT_EQ(json["columns"][1]["name"], "B\"1\".external_force");
  EXPECT_EQ(json["columns"][1]["unit"], "N");
  EXPECT_EQ(json["columns"][1]["values"], nlohmann::json::array({0.1, nullptr}));
}

TEST(SeriesJson, NumbersComeBackAsTheyWere) {
  const std::vector<double> values{0.1, 1e-300, -2.5e17, 1.0 / 3.0};
  const auto json = nlohmann::json::parse(SeriesJson(Series(values)));
  EXPECT_EQ(json["columns"][1]["values"].get<std::vector<double>>(), values);
}

TEST(SeriesCsv, HasUnitsInItsHeaderAndAllDigits) {
  v1::Series series = Series({1.0 / 3.0});
  series.mutable_columns(1)->set_name("B1.velocity");
  series.mutable_columns(1)->set_unit("m/s");
  EXPECT_EQ(SeriesCsv(series), "time [s],B1.velocity [m/s]\n0,0.3333333333333333\n");
}

TEST(RenderSeries, LeavesTheMiddleOutAndTellsHowToGetIt) {
  v1::Series series = Series(std::vector<double>(100, 1));
  series.set_recorded_samples(5000);
  EXPECT_THAT(RenderSeries(series, {}),
              AllOf(HasSubstr("… 60 more samples; -o csv prints all\n"),
                    HasSubstr("100 of 5000 samples, no peak left out\n"), HasSubstr("time [s]")));
  EXPECT_THAT(RenderSeries(Series(), {}), Not(HasSubstr("no peak")));
}

v1::Job Estimated() {
  v1::Job job;
  v1::Estimate& estimate = *job.mutable_estimate();
  estimate.set_steps(123'456);
  estimate.set_samples(601);
  estimate.set_output_bytes(1'500'000);
  estimate.set_memory_bytes(999);
  estimate.mutable_wall_time()->set_seconds(3);
  return job;
}

TEST(RenderEstimate, IsEmptyWithoutAnEstimate) { EXPECT_EQ(RenderEstimate({}, {}, {}), ""); }

TEST(RenderEstimate, HasAtMostTwoDigitsOfWhatIsGuessed) {
  EXPECT_THAT(RenderEstimate(Estimated(), {}, {}),
              AllOf(ContainsRegex("steps +120000 +100000000"), ContainsRegex("samples +601 +-"),
                    ContainsRegex("output +1.5 MB +-"), ContainsRegex("memory +999 B +-"),
                    ContainsRegex("wall time +3 s +-")));
}

TEST(RenderEstimate, StepsAndTimeThatAreNotToldAreNotShown) {
  v1::Job job = Estimated();
  job.mutable_estimate()->clear_steps();
  job.mutable_estimate()->clear_wall_time();
  EXPECT_THAT(RenderEstimate(job, {}, {}), ContainsRegex("steps +- "));
  EXPECT_THAT(RenderEstimate(job, {}, {}), ContainsRegex("samples +601 "));
  EXPECT_THAT(RenderEstimate(job, {}, {}), ContainsRegex("wall time +- "));
}

TEST(RenderEstimate, ShowsTheLowestOfTheLimits) {
  v1::Job job = Estimated();
  job.mutable_budget()->set_steps(5000);
  job.mutable_budget()->set_output_bytes(3'000'000);
  v1::ServerLimits limits;
  limits.set_max_samples(1000);
  limits.mutable_max_budget()->set_steps(4000);
  limits.mutable_max_budget()->mutable_wall_time()->set_seconds(60);
  EXPECT_THAT(
      RenderEstimate(job, limits, {}),
      AllOf(ContainsRegex("steps +120000 +4000\n"), ContainsRegex("samples +601 +1000\n"),
            ContainsRegex("output +1.5 MB +3 MB\n"), ContainsRegex("wall time +3 s +60 s")));
  job.mutable_scenario()->mutable_solver()->set_max_steps(70);
  EXPECT_THAT(RenderEstimate(job, limits, {}), ContainsRegex("steps +120000 +70\n"));
}

}  // namespace
}  // namespace contact::cli
