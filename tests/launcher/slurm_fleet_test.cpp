#include "launcher/slurm_fleet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "launcher/worker_program.h"

namespace contact::launcher {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(SbatchTest, AsksForWhatTheOptionsSay) {
  SlurmOptions options;
  options.partition = "all";
  options.account = "lab";
  options.time = 4h;
  options.job_name = "mine";
  options.output = "/logs/%j";
  options.options = {"--mem=4G", "--output=/other"};
  EXPECT_THAT(SbatchWords(options, 8),
              ElementsAre("sbatch", "--parsable", "--job-name=mine", "--nodes=1", "--ntasks=1",
                          "--cpus-per-task=8", "--signal=B:TERM@60", "--export=ALL", "--no-requeue",
                          "--output=/logs/%j", "--partition=all", "--account=lab", "--time=240",
                          "--mem=4G", "--output=/other"));
}

TEST(SbatchTest, LeavesToSlurmWhatNobodySaid) {
  for (const char* flag : {"--partition", "--account", "--time"}) {
    EXPECT_THAT(SbatchWords({}, 1), Not(Contains(StartsWith(flag)))) << flag;
  }
}

TEST(SbatchTest, NoticeComesWithinTheTimeLimit) {
  SlurmOptions options;
  EXPECT_THAT(SbatchWords(options, 1), Contains("--signal=B:TERM@60"));
  options.time = 1min;
  EXPECT_THAT(SbatchWords(options, 1), Contains("--signal=B:TERM@15"));
}

TEST(SbatchTest, ScriptBecomesTheWorkerWhateverItsWordsHold) {
  const std::vector<std::string> words = {"printf", "%s|", "$HOME", "a'b", "`id`", "c d\ne", ""};
  const auto output = OutputOf({{"sh"}, {"PATH=/usr/bin:/bin"}}, BatchScript(words));
  EXPECT_EQ(output.value(), "$HOME|a'b|`id`|c d\ne||");
}

TEST(SqueueTest, AsksForOwnJobsOfTheNameThatAreNotEnding) {
  SlurmOptions options;
  options.job_name = "mine";
  EXPECT_THAT(SqueueWords(options),
              ElementsAre("squeue", "--me", "--noheader", "--name=mine",
                          "--states=PENDING,RUNNING,CONFIGURING", "--format=%i"));
}

TEST(SqueueTest, CountsALineAJob) {
  EXPECT_EQ(CountJobs("").value(), 0);
  EXPECT_EQ(CountJobs("17\n").value(), 1);
  EXPECT_EQ(CountJobs("17\n18  \n\n19").value(), 3);
}

TEST(SqueueTest, AnswerThatIsNoListIsRefused) {
  EXPECT_THAT(std::string(CountJobs("17\nslurm_load_jobs error").status().message()),
              HasSubstr("slurm_load_jobs"));
}

TEST(WorkerProgramTest, PasswordIsInNoWord) {
  const Program worker = WorkerProgram({}, "postgresql://ada:secret@db/contactd", {"HOME=/home"});
  for (const std::string& word : worker.words) EXPECT_THAT(word, Not(HasSubstr("secret")));
  EXPECT_THAT(worker.environment,
              ElementsAre("HOME=/home", "CONTACTD_STORE=postgresql://ada:secret@db/contactd"));
}

TEST(WorkerProgramTest, SettingsOfTheLauncherAreNotThoseOfItsWorkers) {
  const Program worker =
      WorkerProgram({}, "db", {"CONTACTD_ROLE=launcher", "CONTACTD_STORE=x", "PATH=/bin"});
  EXPECT_THAT(worker.environment, ElementsAre("PATH=/bin", "CONTACTD_STORE=db"));
}

TEST(WorkerProgramTest, WorkerIsToldItsThreadsAndWhenToLeave) {
  LauncherOptions options;
  options.worker = {.command = "contactd", .exit_when_idle = 90s, .options = {"--lease=1m"}};
  options.limits.threads = 8;
  EXPECT_THAT(WorkerProgram(options, "db", {}).words,
              ElementsAre("contactd", "--role=worker", "--workers=8", "--exit-when-idle=90s",
                          "--lease=1m"));
  options.engine = Engine::kSlurm;
  options.slurm.time = 60min;
  EXPECT_THAT(WorkerProgram(options, "db", {}).words, Contains("--stop-after=3480s"));
}

TEST(WorkerProgramTest, WorkerIsThisProgramUnlessToldOtherwise) {
  EXPECT_THAT(WorkerProgram({}, "db", {}).words.front(), HasSubstr("launcher_test"));
}

// Slurm's notice comes 60 s before the limit, and may come as much earlier.
TEST(WorkerProgramTest, WorkerLeavesBeforeTheNoticeWhereTheLimitAllowsIt) {
  for (const auto limit : {4min, 60min, 10'000min}) EXPECT_EQ(limit - StopAfter(limit), 2min);
  EXPECT_EQ(StopAfter(1min), 30s);
  EXPECT_EQ(StopAfter(0s), 0s);
}

}  // namespace
}  // namespace contact::launcher
