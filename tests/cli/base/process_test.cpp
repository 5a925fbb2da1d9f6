#include "cli/base/process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>

#include "base/file_descriptor.h"

namespace contact::cli {
namespace {

TEST(Process, ExitCodeIsThatOfTheProgramOrOfItsSignal) {
  EXPECT_EQ(WaitForProcess(StartProcess({"true"})), 0);
  EXPECT_EQ(WaitForProcess(StartProcess({"sh", "-c", "exit 42"})), 42);
  EXPECT_EQ(WaitForProcess(StartProcess({"sh", "-c", "kill -9 $$"})), 128 + SIGKILL);
}

TEST(Process, AProgramThatIsMissingThrowsTheReason) {
  try {
    StartProcess({"/no/such/program"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("/no/such/program"));
  }
  try {
    StartProcess({"/etc/passwd"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::permission_denied);
  }
}

TEST(Process, WordsReachTheProgramAsTheyAreWithoutAShell) {
  EXPECT_EQ(OutputOf({"printf", "%s|", "a b", "$HOME", "it's", ";", ""}), "a b|$HOME|it's|;||");
}

TEST(Process, OutputIsWholeHoweverLongItIs) {
  const auto text = OutputOf({"sh", "-c", "head -c 1000000 /dev/zero | tr '\\0' x"});
  EXPECT_EQ(text, std::string(1'000'000, 'x'));
}

TEST(Process, ErrorsGoWhereTheyAreSent) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("process_test." + std::to_string(getpid()));
  const FileDescriptor file(open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  ASSERT_GE(file.get(), 0);
  WaitForProcess(StartProcess({"sh", "-c", "printf wrong >&2"}, {.errors = file.get()}));
  std::array<char, 8> said{};
  EXPECT_EQ(pread(file.get(), said.data(), said.size(), 0), 5);
  EXPECT_STREQ(said.data(), "wrong");
  std::filesystem::remove(path);
}

TEST(Process, OutputOfAProgramThatFailsIsNothing) {
  EXPECT_EQ(OutputOf({"sh", "-c", "echo x; exit 1"}), std::nullopt);
  EXPECT_EQ(OutputOf({"/no/such/program"}), std::nullopt);
}

TEST(Process, SignalsThatAreBlockedHereAreNotBlockedThere) {
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const auto mask = OutputOf({"grep", "SigBlk", "/proc/self/status"});
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(mask, "SigBlk:\t0000000000000000\n");
}

TEST(Process, AGroupOfItsOwnIsLedByTheProcess) {
  const FileDescriptor null(open("/dev/null", O_WRONLY | O_CLOEXEC));
  const pid_t process = StartProcess({"sleep", "1000"}, {.own_group = true, .output = null.get()});
  EXPECT_EQ(getpgid(process), process);
  kill(process, SIGTERM);
  EXPECT_EQ(WaitForProcess(process), 128 + SIGTERM);
}

TEST(Process, SilentErrorsDoNotReachOurStandardError) {
  ::testing::internal::CaptureStderr();
  WaitForProcess(StartProcess({"sh", "-c", "echo hidden >&2"}, {.silent_errors = true}));
  WaitForProcess(StartProcess({"sh", "-c", "echo shown >&2"}));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "shown\n");
}

}  // namespace
}  // namespace contact::cli
