#include "storage/sqlite/fsck.h"

#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <sstream>

#include "storage/store.h"
#include "storage/store_fixture.h"

namespace contact {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class FsckTest : public StoreTest {
 protected:
  void Fill() {
    Open();
    for (const char* name : {"jobs/a", "jobs/b"}) {
      ASSERT_TRUE(Create(MakeJob(name)).ok());
      ASSERT_TRUE(Append(name, {LogEvent("2"), FrameEvent(), LogEvent("4")}).ok());
    }
  }

  // Every file of the directory and what is in it.
  std::map<std::string, std::string> Files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(path())) {
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files[entry.path().filename()] = text.str();
    }
    return files;
  }

  absl::StatusOr<FsckReport> Check() {
    const auto before = Files();
    findings_.clear();
    auto report = Fsck(path(), [this](const std::string& line) { findings_.push_back(line); });
    EXPECT_EQ(Files(), before) << "it writes nothing";
    return report;
  }

  // Changes the tables behind the store's back, then checks.
  std::vector<std::string> After(const std::string& sql) {
    SQLite::Database(database(), SQLite::OPEN_READWRITE).exec(sql);
    EXPECT_TRUE(Check().ok());
    return findings_;
  }

  std::vector<std::string> findings_;
};

TEST_F(FsckTest, DroppedFrameChunksAreNotMissed) {
  Fill();
  v1::Job ended = MakeJob("jobs/a");
  ended.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Update({.name = "jobs/a", .job = &ended}).ok());
  ASSERT_TRUE(Compact("jobs/a").ok());
  store_.reset();
  EXPECT_THAT(After("UPDATE jobs SET bytes=bytes"), ElementsAre());
  EXPECT_THAT(After("DELETE FROM events WHERE job=2 AND sequence=2"),
              Contains(HasSubstr("events 2 to 2 are missing")));
}

TEST_F(FsckTest, GoodStoreHasNoFindings) {
  Fill();
  store_.reset();
  const auto report = Check();
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_THAT(findings_, ElementsAre());
  EXPECT_EQ(report->jobs, 2);
  EXPECT_EQ(report->events, 8);
}

TEST_F(FsckTest, StoreOfACrashIsReadWithItsLog) {
  Fill();
  const std::filesystem::path image = directory_.path() / "image";
  std::filesystem::copy(path(), image);
  store_.reset();
  std::filesystem::remove_all(path());
  std::filesystem::rename(image, path());
  const auto report = Check();
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_THAT(findings_, ElementsAre());
  EXPECT_EQ(report->events, 8);
}

TEST_F(FsckTest, EachKindOfDamageIsOneLine) {
  Fill();
  store_.reset();
  EXPECT_THAT(After("UPDATE events SET payload=zeroblob(9) WHERE job=1 AND sequence=3"),
              ElementsAre(HasSubstr("jobs/a: event 3 fails its checksum"), HasSubstr("takes")));
  EXPECT_THAT(After("DELETE FROM events WHERE job=1 AND sequence=3"),
              ElementsAre(HasSubstr("jobs/a: events 3 to 3 are missing"), HasSubstr("takes")));
  EXPECT_THAT(After("DELETE FROM events WHERE job=1"),
              ElementsAre(HasSubstr("jobs/a: its last event is 0, its row says 4")));
  EXPECT_THAT(After("DELETE FROM jobs WHERE number=1; DELETE FROM specs WHERE job=2"),
              testing::IsSupersetOf({HasSubstr("a row of specs belongs to no job"),
                                     HasSubstr("jobs/b: its spec is missing")}));
}

TEST_F(FsckTest, ColumnsThatNoChecksumCoversAreComparedWithTheJob) {
  Fill();
  store_.reset();
  EXPECT_THAT(After("UPDATE jobs SET end_time=1 WHERE number=1"),
              ElementsAre("jobs/a: the job is not what its row says"));
  EXPECT_THAT(After("UPDATE labels SET value='x' WHERE job=2"),
              Contains("jobs/b: its labels are not those that it was given"));
}

TEST_F(FsckTest, LabelsAndNoteAreThoseOfTheNewestRemark) {
  Fill();
  ASSERT_TRUE(Remark({.name = "jobs/a", .labels = JobLabels{{"law", "x"}}, .note = "good"}).ok());
  store_.reset();
  EXPECT_EQ(Check()->findings, 0);
  EXPECT_THAT(After("UPDATE labels SET value='y' WHERE job=1"),
              ElementsAre("jobs/a: its labels are not those that it was given"));
  EXPECT_THAT(After("UPDATE jobs SET note=x'62' WHERE number=1"),
              Contains("jobs/a: its note fails its checksum"));
  EXPECT_THAT(After("UPDATE jobs SET labels=x'' WHERE number=1"),
              Contains("jobs/a: its labels fail their checksum"));
}

TEST_F(FsckTest, WhatBelongsToAnotherJobFailsItsChecksum) {
  Fill();
  for (const char* name : {"jobs/a", "jobs/b"}) {
    v1::Job ended = MakeJob(name);
    ended.set_state(v1::Job::SUCCEEDED);
    ended.add_cycles();
    ASSERT_TRUE(Update({.name = name, .job = &ended}).ok());
  }
  store_.reset();
  EXPECT_THAT(After("REPLACE INTO specs SELECT 1, crc32, spec FROM specs WHERE job=2"),
              ElementsAre("jobs/a: its spec fails its checksum"));
  EXPECT_THAT(After("REPLACE INTO results SELECT 1, crc32, result FROM results WHERE job=2"),
              Contains("jobs/a: its result fails its checksum"));
  EXPECT_THAT(After("REPLACE INTO events SELECT 1, sequence, kind, coding, crc32, payload"
                    " FROM events WHERE job=2 AND sequence=4"),
              Contains("jobs/a: event 4 fails its checksum"));
  Open();
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a").status()));
}

TEST_F(FsckTest, ColumnsThatStandNowhereElseHaveAChecksum) {
  Fill();
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .take = true}).ok());
  Await<absl::StatusOr<bool>> requested;
  store_->RequestCancel("jobs/b", requested.callback());
  ASSERT_TRUE(requested.Get().ok());
  store_.reset();
  EXPECT_THAT(After("UPDATE jobs SET epoch=epoch"), ElementsAre()) << "they are kept in step";
  const char* const changes[] = {"epoch=epoch+1", "request_id='local/other'", "cancel_requested=1",
                                 "compacted=1",   "oldest_sequence=0",        "name='jobs/c'"};
  for (const std::string change : changes) {
    const std::filesystem::path kept = path().string() + ".kept";
    std::filesystem::copy_file(database(), kept);
    EXPECT_THAT(After("UPDATE jobs SET " + change + " WHERE number=1"),
                Contains(HasSubstr("the job fails its checksum")))
        << change;
    std::filesystem::rename(kept, database());
  }
}

TEST_F(FsckTest, RemovedJobsAreNoDamage) {
  Fill();
  store_.reset();
  EXPECT_THAT(After("PRAGMA foreign_keys=ON; INSERT INTO removed VALUES(1);"
                    "DELETE FROM jobs WHERE number=1"),
              ElementsAre());
}

TEST_F(FsckTest, WhatCannotBeLookedAtIsSaidSo) {
  EXPECT_TRUE(absl::IsNotFound(Fsck(path(), [](const std::string&) {}).status()));
  Fill();
  EXPECT_TRUE(absl::IsUnavailable(Fsck(path(), [](const std::string&) {}).status()));
  store_.reset();
  SQLite::Database(database(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version=1");
  EXPECT_THAT(Check().status().ToString(), HasSubstr("schema version 1"));
  std::filesystem::resize_file(database(), 0);
  EXPECT_THAT(Check().status().ToString(), HasSubstr("is empty"));
}

TEST_F(FsckTest, TruncatedDatabaseIsDamage) {
  Fill();
  ASSERT_TRUE(Append("jobs/a", {LogEvent(std::string(100'000, 'x'))}).ok());
  store_.reset();
  std::filesystem::resize_file(database(), std::filesystem::file_size(database()) / 2);
  const auto report = Check();
  EXPECT_TRUE(!report.ok() || report->findings > 0);
}

}  // namespace
}  // namespace contact
