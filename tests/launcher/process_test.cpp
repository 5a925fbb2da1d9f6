#include "launcher/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "launcher/exec_fleet.h"

namespace contact::launcher {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

Program Shell(const std::string& script) { return {{"sh", "-c", script}, {"PATH=/usr/bin:/bin"}}; }

TEST(ProcessTest, OutputIsWhatTheProgramWrites) {
  EXPECT_EQ(OutputOf(Shell("echo one; echo two")).value(), "one\ntwo\n");
}

TEST(ProcessTest, ProgramReadsItsInput) {
  const std::string input(1 << 20, 'x');
  EXPECT_EQ(OutputOf({{"cat"}, {"PATH=/bin"}}, input).value(), input);
}

TEST(ProcessTest, WordsAreNotReadByAShell) {
  EXPECT_EQ(OutputOf({{"printf", "%s", "$HOME; `id` 'a' \"b\" \\ *"}, {}}).value(),
            "$HOME; `id` 'a' \"b\" \\ *");
}

TEST(ProcessTest, ProgramHasTheEnvironmentThatIsGiven) {
  EXPECT_EQ(OutputOf({{"/usr/bin/env"}, {"A=b c"}}).value(), "A=b c\n");
}

TEST(ProcessTest, FailureIsToldByItsFirstLine) {
  const auto output = OutputOf(Shell("echo why >&2; echo more >&2; exit 3"));
  EXPECT_EQ(output.status().message(), "sh ended with code 3: why");
}

TEST(ProcessTest, ProgramThatIsNotThereIsNamed) {
  EXPECT_EQ(OutputOf({{"no-such-program"}, {}}).status().message(),
            "cannot run no-such-program: No such file or directory");
}

TEST(ProcessTest, ProgramThatDoesNotEndIsEnded) {
  EXPECT_EQ(OutputOf(Shell("exec sleep 60"), "", 50ms).status().message(), "sh does not end");
}

TEST(ExecFleetTest, CountsWorkersUntilTheyEnd) {
  ExecFleet fleet(Shell("read nothing; exec sleep 60"));
  ASSERT_TRUE(fleet.Start(3).ok());
  EXPECT_EQ(fleet.Count().value(), 3);
}

TEST(ExecFleetTest, WorkersThatEndedAreNoLongerCounted) {
  ExecFleet fleet(Shell("exit 3"));
  ASSERT_TRUE(fleet.Start(2).ok());
  while (fleet.Count().value() > 0) {
  }
}

TEST(ExecFleetTest, CommandThatIsNotThereFails) {
  ExecFleet fleet({{"/no/such/worker"}, {}});
  EXPECT_THAT(std::string(fleet.Start(1).message()), HasSubstr("cannot run /no/such/worker"));
  EXPECT_EQ(fleet.Count().value(), 0);
}

// A file that holds 1 for a worker that was asked to end.
TEST(ExecFleetTest, EndsItsWorkersAndWaitsForThem) {
  const std::string file = testing::TempDir() + "exec_fleet_test";
  {
    ExecFleet fleet(Shell("trap 'echo 1 > " + file + "; exit 0' TERM; echo 0 > " + file +
                          "; while :; do sleep 0.01; done"));
    ASSERT_TRUE(fleet.Start(1).ok());
    while (OutputOf({{"cat", file}, {}}).value_or("") != "0\n") {
    }
  }
  EXPECT_EQ(OutputOf({{"cat", file}, {}}).value(), "1\n");
  std::remove(file.c_str());
}

TEST(ExecFleetTest, WorkerThatDoesNotListenIsEndedAfterTheGrace) {
  ExecFleet fleet(Shell("trap '' TERM; while :; do sleep 0.01; done"), 100ms);
  ASSERT_TRUE(fleet.Start(2).ok());
}

}  // namespace
}  // namespace contact::launcher
