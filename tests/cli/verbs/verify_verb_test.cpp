// What verify asks of the server, and how it ends: the server is scripted.

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/verbs/verb_case.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

class VerifyVerbTest : public testing::Test {
 protected:
  VerifyVerbTest() {
    own_.mutable_scenario()->add_bodies()->set_name("A");
    own_.mutable_scenario()->mutable_solver()->set_method(v1::Solver::RK4);
    own_.mutable_scenario()->mutable_solver()->set_step_s(kStep);
    own_.mutable_scenario()->set_end_time_s(1);
    Solve(own_);
    server_.solve = [this](v1::Job& job) { Solve(job); };
  }

  // The velocity is 1 m/s, but for an error of order 4 in the step.
  void Solve(v1::Job& job) const {
    const double step = job.scenario().solver().step_s() / kStep;
    job.add_final_bodies()->set_name("A");
    job.mutable_final_bodies(0)->set_velocity_m_per_s(1 + error_ * std::pow(step, 4));
  }

  End Run(const std::vector<std::string>& words) { return EndOf(words, server_.address()); }

  std::vector<std::string> Deleted() const {
    std::vector<std::string> names;
    for (const auto& request : server_.Asked<v1::DeleteJobRequest>())
      names.push_back(request.name());
    return names;
  }

  static constexpr double kStep = 1e-5;
  double error_ = 1e-9;
  ScriptedServer server_;
  v1::Job& own_ = server_.Add("jobs/own", v1::Job::SUCCEEDED);
};

TEST_F(VerifyVerbTest, RunsTheJobThreeTimesAndDeletesTheRuns) {
  const End end = Run({"verify", "jobs/own"});
  EXPECT_EQ(end.told, "");
  EXPECT_EQ(end.code, ExitCode::kOk);
  std::vector<double> steps;
  for (const auto& request : server_.Asked<v1::CreateJobRequest>()) {
    steps.push_back(request.job().scenario().solver().step_s());
    EXPECT_TRUE(request.job().scenario().output().ledger_only());
    EXPECT_GT(request.job().time_to_live().seconds(), 0);
    EXPECT_THAT(request.job().labels(), Contains(Pair("verifies", "own")));
  }
  EXPECT_THAT(steps, ElementsAre(5e-6, 2.5e-6, 1.25e-6));
  EXPECT_THAT(Deleted(), ElementsAre("jobs/new", "jobs/new2", "jobs/new3"));
  EXPECT_THAT(end.said, HasSubstr("jobs/own has solver.step_s 1e-05, and runs again with 5e-06"));
  EXPECT_THAT(end.printed, HasSubstr("verified: all within 1e-08"));
}

TEST_F(VerifyVerbTest, KeepsTheRunsWhereAskedFor) {
  const json document = json::parse(Run({"verify", "jobs/own", "--keep", "-o", "json"}).printed);
  EXPECT_EQ(document["runs"][2]["job"], "jobs/new3");
  EXPECT_THAT(Deleted(), IsEmpty());
  for (const auto& request : server_.Asked<v1::CreateJobRequest>()) {
    EXPECT_FALSE(request.job().has_time_to_live());
    EXPECT_FALSE(request.job().scenario().output().ledger_only());
  }
}

TEST_F(VerifyVerbTest, AJobThatIsFarOffEndsWithItsCode) {
  error_ = 1e-7;
  own_.clear_final_bodies();
  Solve(own_);
  EXPECT_EQ(Run({"verify", "jobs/own"}).code, ExitCode::kDiffers);
  EXPECT_EQ(Run({"verify", "jobs/own", "--rel", "2e-7"}).code, ExitCode::kOk);
}

TEST_F(VerifyVerbTest, ARunThatFailsIsNamedAndTheRunsAreDeleted) {
  server_.solve = [](v1::Job& job) {
    job.set_state(v1::Job::FAILED);
    job.set_state_reason("NUMERIC");
  };
  const End end = Run({"verify", "jobs/own"});
  EXPECT_EQ(end.code, ExitCode::kRunFailed);
  EXPECT_EQ(end.told, "jobs/new did not succeed: NUMERIC");
  EXPECT_EQ(Deleted().size(), 3U);
}

TEST_F(VerifyVerbTest, WhatDidNotSucceedOrIsASweepIsRefused) {
  server_.Add("jobs/broken", v1::Job::FAILED).set_state_reason("CRASHED");
  EXPECT_EQ(Run({"verify", "jobs/broken"}).code, ExitCode::kRunFailed);
  server_.Add("jobs/grid", v1::Job::SUCCEEDED).mutable_sweep();
  const End end = Run({"verify", "jobs/grid"});
  EXPECT_EQ(end.code, ExitCode::kUsage);
  EXPECT_EQ(end.told, "jobs/grid is a sweep, not a run");
  EXPECT_THAT(server_.Asked<v1::CreateJobRequest>(), IsEmpty());
}

}  // namespace
}  // namespace contact::cli
