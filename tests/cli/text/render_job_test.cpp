#include "cli/text/render_job.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>

#include "cli/settings/settings.h"
#include "cli/text/print_job.h"
#include "cli/text/render_json.h"
#include "from_text.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

v1::Job Finished() {
  return JobFrom(R"(
      name: "jobs/k3v9" state: SUCCEEDED convergence: FULL scenario { title: "Two balls" }
      cycles { contact: "A-B" number: 1 group: 1 kind: COLLISION end: SEPARATION status: CONVERGED
               iterations: 3 mu: 1.43275053327e8 mu_over_k_s_per_m: 1.43275053327
               alpha: 1.43275053327 restitution_in: 0.5 restitution_out: 0.50000000005
               start_time_s: 1e-3 end_time_s: 2.5e-3 }
      cycles { contact: "B-wall" number: 2 kind: NIRV end: RUN_END status: NOT_CONVERGED
               mu: 5e6 mu_over_k_s_per_m: 0.25 restitution_in: 0.9 restitution_out: nan
               start_time_s: 2.5e-3 end_time_s: 4e-3 }
      final_bodies { name: "A" position_m: 0.25 velocity_m_per_s: -0.5 }
      summary { steps: 250 iterations: 3 wall_time_s: 63e-6 time_reached_s: 4e-3
                momentum_residual: 1e-16 energy_residual: 2e-15 worst_identity_residual: 3e-14 }
      warnings: "the law has no velocity")");
}

TEST(RenderJob, ShowsLedgerBodiesAndBalances) {
  EXPECT_EQ(RenderJob(Finished(), {}),
            "jobs/k3v9  SUCCEEDED  4 ms simulated, 2 cycles, 3 iterations, 63 µs wall\n"
            "Two balls\n"
            "\n"
            "CONTACT  #  GROUP  KIND       END         STATUS         n             μ  α, or μ/k  "
            "ε IN  ε OUT    ERROR  t START [s]  t END [s]\n"
            "A-B      1      1  COLLISION  SEPARATION  CONVERGED      3  1.432751e+08   1.432751  "
            " 0.5    0.5  1.0e-10        0.001     0.0025\n"
            "B-wall   2      -  NIRV       RUN_END     NOT_CONVERGED  0       5000000   0.25 s/m  "
            " 0.9      -        -       0.0025      0.004\n"
            "\n"
            "BODY  POSITION [m]  VELOCITY [m/s]\n"
            "A             0.25            -0.5\n"
            "\n"
            "convergence FULL (1 of 2 cycles); residuals: momentum 1.0e-16, energy 2.0e-15, "
            "cycle identity 3.0e-14; 250 steps\n"
            "warning: the law has no velocity\n");
}

// The number that a row of earlier servers has there says nothing.
TEST(RenderJob, SettledAndReleasedCyclesHaveNeitherRestitutionNorError) {
  for (const auto status : {v1::Cycle::SETTLED, v1::Cycle::RELEASED}) {
    v1::Job job = JobFrom("cycles { restitution_in: 0.1 restitution_out: 62.8 }");
    EXPECT_THAT(RenderJob(job, {}), AllOf(HasSubstr("62.8"), HasSubstr("6.3e+02")));
    job.mutable_cycles(0)->set_status(status);
    EXPECT_THAT(RenderJob(job, {}), AllOf(Not(HasSubstr("62.8")), Not(HasSubstr("e+02"))));
  }
}

TEST(RenderJob, CutCycleHasDashesForWhatTheEndHides) {
  const v1::Job job = JobFrom(R"(
      cycles { contact: "wall" number: 1 group: 1 kind: NIRV end: RUN_END status: CUT
               mu: 5e6 mu_over_k_s_per_m: 0.25 restitution_in: 0.9 restitution_out: nan
               end_time_s: 4e-3 peak_force_n: nan delta_max_m: nan work_compression_j: nan
               work_restitution_j: nan })");
  EXPECT_THAT(RenderJob(job, {.columns = {"status", "mu", "restitution_out", "error", "peak_force",
                                          "delta_max", "work_compression", "work_restitution"}}),
              testing::ContainsRegex("CUT +5000000( +-){6}\n"));
}

TEST(RenderJob, StatusesHaveTheirColours) {
  const auto shown = [](v1::Cycle::Status status) {
    v1::Job job;
    job.add_cycles()->set_status(status);
    return RenderJob(job, {.color = true});
  };
  EXPECT_THAT(shown(v1::Cycle::LIMITED), HasSubstr("\x1b[33mLIMITED"));
  EXPECT_THAT(shown(v1::Cycle::RELEASED), HasSubstr(" RELEASED "));
  EXPECT_THAT(shown(v1::Cycle::CUT), HasSubstr("\x1b[2mCUT"));
  EXPECT_THAT(shown(v1::Cycle::UNFINISHED), HasSubstr("\x1b[2mUNFINISHED"));
}

TEST(RenderJob, RunningJobTellsWhatKeepsItBusy) {
  v1::Job job = JobFrom(R"(name: "jobs/x" state: RUNNING
                            progress { end_time_s: 3 busy_with: "ball-floor, δ 1e-9 m" })");
  EXPECT_THAT(RenderJob(job, {}), HasSubstr("\nbusy: ball-floor, δ 1e-9 m\n"));
  job.set_state(v1::Job::SUCCEEDED);
  EXPECT_THAT(RenderJob(job, {}), Not(HasSubstr("busy")));
}

TEST(RenderJob, ShowsHowTheJobIsTreated) {
  v1::Job job = JobFrom(R"(
      name: "jobs/k3v9" state: QUEUED priority: -5 time_to_live { seconds: 60 }
      budget { wall_time { seconds: 1 nanos: 500000000 } steps: 1000 output_bytes: 20 })");
  EXPECT_THAT(RenderJob(job, {}),
              HasSubstr("\npriority -5, budget 1.5 s wall, budget 1000 steps, budget 20 bytes, "
                        "kept 60 s after its end\n"));
  job.set_state(v1::Job::FAILED);
  job.mutable_expire_time()->set_seconds(60);
  EXPECT_THAT(RenderJob(job, {}), HasSubstr("kept until 1970-01-01 00:01:00 UTC"));
}

TEST(RenderJob, LongLedgerSaysHowToGetAll) {
  v1::Job job = Finished();
  while (job.cycles_size() < 200) *job.add_cycles() = job.cycles(0);
  const std::string text = RenderJob(job, {});
  EXPECT_THAT(text, HasSubstr("\n… 160 more cycles; -o json prints all\n"));
  EXPECT_LT(std::ranges::count(text, '\n'), 60);
}

TEST(RenderJob, FailedJobShowsItsError) {
  const v1::Job job = JobFrom(R"(name: "jobs/x" state: FAILED state_reason: "NUMERIC"
                                  error { code: 13 message: "the step vanished at t = 1 s" })");
  EXPECT_EQ(RenderJob(job, {}), "jobs/x  FAILED (NUMERIC)\nerror: the step vanished at t = 1 s\n");
}

TEST(RenderJob, RunningJobShowsHowFarItIs) {
  const v1::Job job = JobFrom(R"(name: "jobs/x" state: RUNNING
                                  progress { time_s: 1 end_time_s: 3 cycles: 12 })");
  EXPECT_EQ(RenderJob(job, {}), "jobs/x  RUNNING  1 s of 3 s simulated, 12 cycles\n");
}

TEST(RenderJob, ColorsOnlyWhereAsked) {
  EXPECT_THAT(RenderJob(Finished(), {}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(RenderJob(Finished(), {.color = true}), HasSubstr("\x1b[32mSUCCEEDED\x1b[0m"));
}

TEST(ToJson, HasTheNamesOfTheProtoAndItsZeros) {
  const std::string text = ToJson(Finished());
  EXPECT_THAT(text, HasSubstr("\"start_time_s\": 0.001"));
  EXPECT_THAT(text, HasSubstr("\"delta_end_m\": 0"));
  EXPECT_THAT(text, HasSubstr("\"restitution_out\": \"NaN\""));
  EXPECT_THAT(text, HasSubstr("\"kind\": \"COLLISION\""));
}

TEST(ToJson, PrintsTheErrorOfAJobWithItsDetails) {
  v1::Job job = JobFrom(R"(name: "jobs/x" error { code: 13 message: "m" })");
  job.mutable_error()->add_details()->PackFrom(job.progress());
  EXPECT_THAT(ToJson(job), HasSubstr("contact.v1.Progress"));
}

TEST(ToJson, WholeNumbersAreNumbersWhereADoubleHoldsThem) {
  v1::Job job = JobFrom(R"(
      name: "481" last_sequence: 7 labels { key: "steps" value: "481" }
      scenario { title: "\"steps\": \"481\"" solver { max_steps: 9007199254740992 } }
      summary { steps: 481 evaluations: 9007199254740993 growths: -5 }
      warnings: "12" create_time { seconds: 60 })");
  const std::string line = ToJsonLine(job);
  EXPECT_THAT(line, HasSubstr(R"("summary":{"steps":481,"evaluations":"9007199254740993",)"));
  EXPECT_THAT(line, HasSubstr(R"("growths":-5)"));
  EXPECT_THAT(line, HasSubstr(R"("max_steps":9007199254740992)"));
  EXPECT_THAT(line, HasSubstr(R"("last_sequence":7)"));
  for (const char* text : {R"("name":"481")", R"("labels":{"steps":"481"})", R"("warnings":["12"])",
                           R"("create_time":"1970-01-01T00:01:00Z")"}) {
    EXPECT_THAT(line, HasSubstr(text));
  }
  EXPECT_THAT(line, HasSubstr(R"(\"steps\": \"481\")"));
  v1::Job again;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line, &again).ok());
  EXPECT_EQ(again.SerializeAsString(), job.SerializeAsString());
  EXPECT_THAT(ToJson(job), HasSubstr("\"steps\": 481,"));
}

TEST(ToJson, LineIsOneLine) {
  const std::string line = ToJsonLine(Finished());
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

TEST(Outcome, TellsHowAJobEnded) {
  EXPECT_EQ(CodeOf(JobFrom("state: SUCCEEDED convergence: FULL")), ExitCode::kOk);
  EXPECT_EQ(CodeOf(JobFrom("state: SUCCEEDED convergence: PARTIAL")), ExitCode::kNotConverged);
  EXPECT_EQ(CodeOf(JobFrom("state: FAILED convergence: PARTIAL")), ExitCode::kRunFailed);
  EXPECT_EQ(CodeOf(JobFrom("state: CANCELLED")), ExitCode::kRunFailed);
  EXPECT_EQ(CodeOf(JobFrom("state: RUNNING")), ExitCode::kOk);
}

}  // namespace
}  // namespace contact::cli
