// What a store does with a disk that fails or is full.
#include <sys/resource.h>

#include <csignal>
#include <set>

#include "storage/sqlite/fsck.h"
#include "storage/store.h"
#include "storage/store_fixture.h"
#include "testing/failing_disk.h"

namespace contact {
namespace {

class FailingDiskTest : public StoreTest, public testing::WithParamInterface<bool> {};

// Nothing that was answered is lost and nothing that was refused is claimed, wherever it fails.
TEST_P(FailingDiskTest, FailedWriteOrSyncIsNeverASuccess) {
  const bool once = GetParam();
  int writes = 0, syncs = 0;
  for (int n = 0; n < 200; ++n) {
    FailingDisk disk;
    int notices = 0;
    std::filesystem::remove_all(path());
    Open({.on_failure = [&](const absl::Status& status) {
      EXPECT_TRUE(absl::IsUnavailable(status)) << status;
      ++notices;
    }});
    ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
    once ? disk.FailOnceAfter(n) : disk.FailAfter(n);
    std::set<std::uint64_t> answered;  // First sequences of what was appended.
    absl::Status refused;
    for (int i = 0; i < 100 && !disk.failed(); ++i) {
      const auto first = Append("jobs/a", {LogEvent(std::string(2000, 'x')), LogEvent("y")});
      if (first.ok()) answered.insert(*first);
      refused.Update(first.status());
    }
    ASSERT_TRUE(disk.failed());
    const auto after = Append("jobs/a", {LogEvent("z"), LogEvent("y")});
    if (after.ok()) answered.insert(*after);
    refused.Update(after.status());
    // A write that failed may be tried again; after a failed sync nobody knows, whatever the disk
    // says next.
    const bool sync = absl::IsUnavailable(refused);
    EXPECT_TRUE(sync || absl::IsResourceExhausted(refused)) << refused << n;
    EXPECT_EQ(notices, sync ? 1 : 0) << n;
    EXPECT_EQ(Read("jobs/a").ok(), !sync);
    EXPECT_EQ(after.ok(), once && !sync) << n;
    ++(sync ? syncs : writes);
    store_.reset();
    disk.Heal();
    const auto report = Fsck(path(), [](const std::string& finding) { ADD_FAILURE() << finding; });
    ASSERT_TRUE(report.ok()) << report.status();
    Open();
    const auto page = ReadEvents({.name = "jobs/a", .max_bytes = 1 << 30});
    ASSERT_TRUE(page.ok());
    EXPECT_EQ(page->events.size(), Read("jobs/a")->job.last_sequence()) << n;
    for (const std::uint64_t first : answered) EXPECT_LT(first, page->events.size()) << n;
    // What was refused may be there after a failed sync only, and then at most that one.
    EXPECT_LE(page->events.size(), 1 + 2 * (answered.size() + (sync ? 1 : 0))) << n;
    store_.reset();
  }
  EXPECT_GT(syncs, 10) << "the test must bite";
  EXPECT_GT(writes, 20);
}

INSTANTIATE_TEST_SUITE_P(Ever, FailingDiskTest, testing::Values(false));
INSTANTIATE_TEST_SUITE_P(Once, FailingDiskTest, testing::Values(true));

TEST_F(StoreTest, FullDiskTakesDeletionsByItsReserveAndNothingElse) {
  FailingDisk disk;
  const auto reserve = path() / "reserve";
  Open({.reserve_bytes = 3 << 20});
  EXPECT_EQ(std::filesystem::file_size(reserve), 3U << 20);
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  ASSERT_TRUE(Append("jobs/a", std::vector(100, LogEvent(std::string(2000, 'x')))).ok());
  job.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &job}).ok());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  disk.FullWhile([&] { return std::filesystem::file_size(reserve) > 0; });
  EXPECT_TRUE(absl::IsResourceExhausted(Append("jobs/b", {LogEvent("x")}).status()));
  EXPECT_TRUE(Delete("jobs/a").ok());
  // Its events go after it, some between two calls.
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(Read("jobs/a").ok());
  EXPECT_EQ(std::filesystem::file_size(reserve), 3U << 20);
  EXPECT_TRUE(absl::IsResourceExhausted(Append("jobs/b", {LogEvent("x")}).status()));
  store_.reset();
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
