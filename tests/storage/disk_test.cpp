// What a store does with a disk that fails or is full.
#include <sys/resource.h>

#include <csignal>

#include "storage/store.h"
#include "storage/store_fixture.h"
#include "testing/failing_disk.h"

namespace contact {
namespace {

// Nothing that was answered is lost and nothing that was refused is claimed, wherever it fails.
TEST_F(StoreTest, FailedWriteOrSyncIsNeverASuccess) {
  int writes = 0, syncs = 0;
  for (int n = 0; n < 40; ++n) {
    FailingDisk disk;
    int notices = 0;
    std::filesystem::remove_all(path());
    Open({.on_failure = [&](const absl::Status& status) {
      EXPECT_TRUE(absl::IsUnavailable(status)) << status;
      ++notices;
    }});
    ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
    disk.FailAfter(n);
    std::uint64_t answered = 1;
    absl::Status refused;
    for (int i = 0; i < 20; ++i) {
      const auto first = Append("jobs/a", {LogEvent(std::string(2000, 'x')), LogEvent("y")});
      ASSERT_FALSE(!refused.ok() && first.ok()) << "it went on after a failure";
      refused = first.status();
      if (first.ok()) answered = *first + 1;
    }
    EXPECT_TRUE(disk.failed());
    // A write that failed may be tried again; after a failed sync nobody knows.
    const bool sync = absl::IsUnavailable(refused);
    EXPECT_TRUE(sync || absl::IsResourceExhausted(refused)) << refused;
    EXPECT_EQ(notices, sync ? 1 : 0) << n;
    EXPECT_EQ(Read("jobs/a").ok(), !sync);
    ++(sync ? syncs : writes);
    store_.reset();
    disk.Heal();
    Open();
    const auto job = Read("jobs/a");
    ASSERT_TRUE(job.ok()) << job.status();
    EXPECT_GE(job->job.last_sequence(), answered) << n;
    const auto page = ReadEvents({.name = "jobs/a"});
    EXPECT_EQ(page->events.size(), job->job.last_sequence()) << n;
    store_.reset();
  }
  EXPECT_GT(syncs, 2) << "the test must bite";
  EXPECT_GT(writes, 5);
}

/// Restores the limit at the end of the scope.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_ = {};
};

TEST_F(StoreTest, FullDiskRefusesWritesUntilThereIsSpace) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::vector<v1::Event> events = {LogEvent(std::string(100'000, 'x'))};
  std::uint64_t answered = 1;
  {
    const FileSizeLimit limit(1 << 20);
    absl::StatusOr<std::uint64_t> first = answered;
    for (int i = 0; i < 100 && first.ok(); ++i) {
      answered = *first;
      first = Append("jobs/a", events);
    }
    EXPECT_TRUE(absl::IsResourceExhausted(first.status())) << first.status();
    EXPECT_EQ(Read("jobs/a")->job.last_sequence(), answered) << "reads work";
  }
  EXPECT_TRUE(Append("jobs/a", events).ok());
  EXPECT_EQ(ReadEvents({.name = "jobs/a", .max_bytes = 1 << 30})->events.size(), answered + 1);
}

}  // namespace
}  // namespace contact
