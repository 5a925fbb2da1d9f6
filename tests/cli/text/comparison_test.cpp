#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/text/comparison/job_comparison.h"
#include "cli/text/comparison/render_comparison.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

v1::Job Job(const std::string& name, double peak_force = 100) {
  v1::Job job;
  job.set_name(name);
  job.set_state(v1::Job::SUCCEEDED);
  job.mutable_scenario()->set_end_time_s(1);
  v1::Cycle& cycle = *job.add_cycles();
  cycle.set_contact("A-B");
  cycle.set_number(1);
  cycle.set_mu(1e6);
  cycle.set_restitution_out(NAN);
  cycle.set_peak_force_n(peak_force);
  job.mutable_summary()->set_wall_time_s(peak_force);
  return job;
}

const JobComparison::Result& Find(const JobComparison& comparison, const std::string& name) {
  return *std::ranges::find(comparison.results, name, &JobComparison::Result::name);
}

// Two jobs whose peak force differs by this part.
JobComparison Differing(double part) {
  return Compare({Job("jobs/a"), Job("jobs/b", 100 * (1 + part))}, {});
}

TEST(Compare, AJobEqualsItself) {
  const JobComparison comparison = Compare({Job("jobs/a"), Job("jobs/a")}, {});
  EXPECT_TRUE(comparison.Holds());  // NaN equals NaN.
  EXPECT_THAT(comparison.parameters, IsEmpty());
}

TEST(Compare, ANumberHoldsWithinTheToleranceOnly) {
  EXPECT_TRUE(Differing(0.9e-6).Holds());
  EXPECT_FALSE(Differing(1.1e-6).Holds());
  EXPECT_FALSE(Differing(-1.1e-6).Holds());
  const Tolerance wide{.relative = 0.1};
  EXPECT_TRUE(Compare({Job("a"), Job("b", 109)}, wide).Holds());
  EXPECT_FALSE(Compare({Job("a"), Job("b", NAN)}, wide).Holds());
}

TEST(Compare, WhatARunCostIsShownAndNotJudged) {
  const JobComparison comparison = Compare({Job("a"), Job("b", 109)}, {.relative = 0.1});
  EXPECT_THAT(Find(comparison, "wall time").values, testing::SizeIs(2));
  EXPECT_TRUE(comparison.Holds(Find(comparison, "wall time")));
  EXPECT_NEAR(Find(comparison, "wall time").Deviation(1), 0.09, 1e-12);
}

TEST(Compare, DeviationIsAbsoluteWhereTheBaselineIsZero) {
  const JobComparison comparison = Compare({Job("a", 0), Job("b", -3)}, {});
  EXPECT_EQ(Find(comparison, "A-B #1 peak force").Deviation(1), -3);
  EXPECT_TRUE(std::isnan(Find(comparison, "state").Deviation(1)));
}

TEST(Compare, FindsEveryFieldOfTheScenarioThatDiffers) {
  v1::Job other = Job("jobs/b");
  other.mutable_scenario()->set_end_time_s(2);
  other.mutable_scenario()->add_bodies()->set_mass_kg(0.5);
  other.mutable_scenario()->mutable_solver()->set_method(v1::Solver::RK4);
  const JobComparison comparison = Compare({Job("jobs/a"), other}, {});
  std::vector<std::string> paths;
  for (const auto& parameter : comparison.parameters) paths.push_back(parameter.path);
  EXPECT_THAT(paths, ElementsAre("bodies[0].mass_kg", "end_time_s", "solver.method"));
  EXPECT_THAT(comparison.parameters[0].values, ElementsAre("", "0.5"));
  EXPECT_THAT(comparison.parameters[2].values, ElementsAre("", "RK4"));
}

TEST(Compare, ACycleThatOneJobLacksDiffers) {
  v1::Job shorter = Job("jobs/b");
  shorter.clear_cycles();
  const JobComparison comparison = Compare({Job("jobs/a"), shorter}, {});
  EXPECT_FALSE(comparison.Holds(Find(comparison, "A-B #1 μ")));
  EXPECT_THAT(RenderComparison(comparison, {}), HasSubstr("DIFFERENT: not all within"));
}

TEST(Compare, GroupsOfSeveralCyclesAreComparedAndOthersAreTheirCycle) {
  std::vector<v1::Job> jobs = {Job("jobs/a"), Job("jobs/b")};
  for (v1::Job& job : jobs) {
    for (const int cycles : {1, 2}) {
      v1::Group& group = *job.add_groups();
      group.set_contact("A-B");
      group.set_number(cycles);
      group.set_first_cycle(cycles);
      group.set_cycles(cycles);
    }
  }
  EXPECT_TRUE(Compare(jobs, {}).Holds());
  jobs[1].mutable_groups(1)->set_cycles(3);
  const JobComparison comparison = Compare(jobs, {});
  EXPECT_FALSE(comparison.Holds(Find(comparison, "A-B group 2 cycles")));
  EXPECT_TRUE(std::ranges::none_of(comparison.results, [](const JobComparison::Result& result) {
    return result.name.starts_with("A-B group 1 ");
  }));
}

TEST(RenderComparison, ShowsValuesDeviationsAndVerdicts) {
  const std::string text = RenderComparison(Differing(0.25), {});
  EXPECT_THAT(text, StartsWith("The scenarios are the same.\n\n"));
  EXPECT_THAT(text,
              testing::ContainsRegex("A-B #1 peak force \\[N\\] +100 +125 +\\+25 % +DIFFERS"));
  EXPECT_THAT(text, testing::ContainsRegex("A-B #1 μ .* 0 +ok"));
  EXPECT_THAT(
      RenderComparison(Differing(1e-9), {}),
      AllOf(HasSubstr("+1.0e-09"), HasSubstr("\nequal within max(1e-12, 1e-06 |baseline|)")));
}

TEST(ComparisonJson, HasNoNumberThatJsonLacks) {
  const auto json = nlohmann::json::parse(ComparisonJson(Differing(0.25)));
  EXPECT_FALSE(json["equal"]);
  for (const auto& result : json["results"]) {
    if (result["name"] == "A-B #1 ε out") {
      EXPECT_EQ(result["values"], nlohmann::json::array({nullptr, nullptr}));
    }
    if (result["name"] == "A-B #1 peak force") {
      EXPECT_FALSE(result["holds"]);
    }
    if (result["name"] == "A-B #1 μ") {
      EXPECT_EQ(result["values"][1], 1e6);
    }
  }
}

TEST(ComparisonCsv, EveryLineHasAsManyFields) {
  v1::Job other = Job("jobs/b");
  other.mutable_scenario()->set_title("a, \"b\"");
  const std::string csv = ComparisonCsv(Compare({Job("jobs/a"), other, Job("jobs/c")}, {}));
  EXPECT_THAT(csv, StartsWith("kind,name,unit,jobs/a,jobs/b,jobs/c,deviation of jobs/b,"
                              "deviation of jobs/c,verdict\n"));
  EXPECT_THAT(csv, HasSubstr("\nparameter,title,,,\"a, \"\"b\"\"\",,,,\n"));
  EXPECT_THAT(csv, HasSubstr("\nresult,A-B #1 μ,N·s/m^(n+1),1e+06,1e+06,1e+06,0,0,ok\n"));
}

TEST(ComparisonLatex, EscapesTextsAndHasAsManyColumnsAsCells) {
  v1::Job other = Job("jobs/b_c");
  other.mutable_scenario()->set_title("5%");
  const std::string latex = ComparisonLatex(Compare({Job("jobs/a"), other}, {}));
  EXPECT_THAT(latex, AllOf(HasSubstr("\\begin{tabular}{lrr}"), HasSubstr("\\begin{tabular}{lrrr}"),
                           HasSubstr("jobs/b\\_c"), HasSubstr("title & - & 5\\% \\\\\n")));
}

}  // namespace
}  // namespace contact::cli
