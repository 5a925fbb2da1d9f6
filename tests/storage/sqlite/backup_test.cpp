#include "storage/sqlite/backup.h"

#include <atomic>
#include <fstream>
#include <thread>

#include "storage/sqlite/fsck.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/store_fixture.h"

namespace contact {
namespace {

class BackupTest : public StoreTest {
 protected:
  // Some megabytes, so that a backup takes several steps.
  void Fill() {
    Open();
    for (const char* name : {"jobs/a", "jobs/b"}) {
      ASSERT_TRUE(Create(MakeJob(name)).ok());
      for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(Append(name, {LogEvent(std::string(300'000, 'x')), FrameEvent(64 * i)}).ok());
      }
    }
  }

  std::filesystem::path draft() const { return path() / "backup.tmp"; }
  std::filesystem::path restored() const { return directory_.path() / "restored"; }

  // Puts the copy into an empty data directory.
  void Restore(const BackupFile& file) {
    std::filesystem::remove_all(restored());
    std::filesystem::create_directory(restored());
    std::ofstream out(restored() / "contactd.db", std::ios::binary);
    for (std::int64_t offset = 0; offset < file.size();) {
      const auto bytes = file.Read(offset, 100'000);
      ASSERT_TRUE(bytes.ok()) << bytes.status();
      out << *bytes;
      offset += static_cast<std::int64_t>(bytes->size());
    }
  }

  void ExpectNoDamage(const std::filesystem::path& folder) {
    const auto report = Fsck(folder, [](const std::string& finding) { ADD_FAILURE() << finding; });
    ASSERT_TRUE(report.ok()) << report.status();
  }
};

TEST_F(BackupTest, RestoredCopyHoldsEverythingAndNumbersOn) {
  Fill();
  const auto backup = Backup();
  ASSERT_TRUE(backup.ok()) << backup.status();
  ASSERT_TRUE(Append("jobs/a", {LogEvent("later")}).ok());
  Restore(**backup);
  ExpectNoDamage(restored());
  auto copy = OpenSqlite(restored());
  ASSERT_TRUE(copy.ok()) << copy.status();
  store_ = *std::move(copy);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 21U);
  EXPECT_EQ(ReadEvents({.name = "jobs/b", .max_bytes = 1 << 30})->events.size(), 21U);
  ASSERT_TRUE(Create(MakeJob("jobs/c")).ok());
  EXPECT_EQ(List({})->jobs.front().job.name(), "jobs/c") << "the newest";
}

TEST_F(BackupTest, CopyMadeWhileOthersWriteIsOfOneMoment) {
  Fill();
  std::atomic<bool> stop = false;
  std::atomic<std::uint64_t> last = 0;
  std::thread writer([&] {
    for (int i = 0; i < 20'000 && !stop; ++i) {
      const auto first = Append("jobs/a", {LogEvent(std::string(2000, 'y')), LogEvent("z")});
      if (first.ok()) last = *first + 1;
    }
  });
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t before = last;
    const auto backup = Backup();
    EXPECT_TRUE(backup.ok()) << backup.status();
    if (!backup.ok()) break;
    Restore(**backup);
    ExpectNoDamage(restored());
    const SQLite::Database raw(restored() / "contactd.db", SQLite::OPEN_READWRITE);
    SQLite::Statement query(raw, "SELECT last_sequence FROM jobs WHERE name='jobs/a'");
    ASSERT_TRUE(query.executeStep());
    EXPECT_GE(query.getColumn(0).getInt64(), static_cast<std::int64_t>(before));
  }
  stop = true;
  writer.join();
}

TEST_F(BackupTest, OthersAreServedWhileItIsMade) {
  Fill();
  std::atomic<bool> done = false;
  store_->Backup({}, [&](const auto&) { done = true; });
  int served = 0;
  while (!done && served < 100'000) {
    ASSERT_TRUE(Read("jobs/a", JobPart::kHeader).ok());
    ++served;
  }
  EXPECT_TRUE(done);
  EXPECT_GE(served, 3) << "of 6 MB, at 1 MiB a step";
}

TEST_F(BackupTest, FileHasNoNameOnceItIsComplete) {
  Fill();
  const auto backup = Backup();
  ASSERT_TRUE(backup.ok());
  EXPECT_GT((*backup)->size(), 5'000'000);
  EXPECT_FALSE(std::filesystem::exists(draft()));
}

TEST_F(BackupTest, StoppedBackupLeavesNothing) {
  Fill();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(absl::IsCancelled(Backup(stop.get_token()).status()));
  EXPECT_FALSE(std::filesystem::exists(draft()));
  EXPECT_TRUE(Backup().ok());
}

TEST_F(BackupTest, ClosingTheStoreEndsItsBackups) {
  Fill();
  Await<absl::StatusOr<std::unique_ptr<BackupFile>>> first, second;
  store_->Backup({}, first.callback());
  store_->Backup({}, second.callback());
  store_.reset();
  (void)first.Get();
  const auto left = second.Get();
  EXPECT_TRUE(left.ok() || absl::IsCancelled(left.status())) << left.status();
  EXPECT_FALSE(std::filesystem::exists(draft()));
}

TEST_F(BackupTest, WhatACrashLeftIsRemovedAtTheStart) {
  Fill();
  store_.reset();
  std::ofstream(draft()) << "half a backup";
  Open();
  EXPECT_FALSE(std::filesystem::exists(draft()));
}

}  // namespace
}  // namespace contact
