// What becomes of the databases of earlier versions: two jobs that succeeded. version_1.sql was
// dumped from one that the program of that version had made, the others from one made with the
// tables of their version, with events as its program coded them.
#include <SQLiteCpp/SQLiteCpp.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "storage/checksum.h"
#include "storage/sqlite/schema.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/store_fixture.h"
#include "testing/failing_disk.h"

namespace contact {
namespace {

std::string Text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// The header of a job without the title, which version 4 adds.
std::string Untitled(const std::string& header) {
  v1::Job job;
  if (!job.ParseFromString(header)) return header;
  job.clear_title();
  return job.SerializeAsString();
}

// The jobs and events of a database, whatever its version.
std::set<std::string> Rows(const std::filesystem::path& database) {
  std::set<std::string> rows;
  SQLite::Database raw(database, SQLite::OPEN_READWRITE);
  SQLite::Statement jobs(raw, "SELECT name || state || last_sequence, header FROM jobs");
  while (jobs.executeStep()) {
    rows.insert(jobs.getColumn(0).getString() + Untitled(jobs.getColumn(1).getString()));
  }
  for (const char* sql :
       {"SELECT job || '/' || sequence || '/' || kind || hex(payload) FROM events",
        "SELECT key || '=' || value || job FROM labels", "SELECT job || hex(spec) FROM specs",
        "SELECT job || hex(result) FROM results"}) {
    SQLite::Statement query(raw, sql);
    while (query.executeStep()) rows.insert(query.getColumn(0).getString());
  }
  return rows;
}

int Version(const std::filesystem::path& database) {
  return SQLite::Database(database, SQLite::OPEN_READWRITE)
      .execAndGet("PRAGMA user_version")
      .getInt();
}

class MigrationTest : public StoreTest, public testing::WithParamInterface<int> {
 protected:
  void MakeOldVersion() {
    store_.reset();
    std::filesystem::remove_all(path());
    std::filesystem::create_directory(path());
    SQLite::Database raw(database(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    raw.exec("PRAGMA synchronous=OFF");
    raw.exec(Text(
        absl::StrCat(CONTACT_SOURCE_DIR, "/tests/storage/sqlite/version_", GetParam(), ".sql")));
    std::ofstream(path() / "initialised") << "contactd.db belongs here\n";
  }

  // Columns of all tables, and the indices.
  std::set<std::string> Tables() {
    std::set<std::string> found;
    SQLite::Database raw(database());
    SQLite::Statement columns(raw,
                              "SELECT m.name || '.' || c.name || ' ' || c.type || c.\"notnull\" ||"
                              " COALESCE(c.dflt_value, '') || c.pk FROM sqlite_schema m,"
                              " pragma_table_xinfo(m.name) c WHERE m.type IN ('table','index')");
    while (columns.executeStep()) found.insert(columns.getColumn(0).getString());
    return found;
  }
};

TEST_P(MigrationTest, EverythingIsThereAfterwards) {
  MakeOldVersion();
  const std::set<std::string> before = Rows(database());
  Open();
  const auto jobs = List({});
  ASSERT_TRUE(jobs.ok());
  ASSERT_EQ(jobs->jobs.size(), 2U);
  for (const StoredJob& header : jobs->jobs) {
    const auto job = Read(header.job.name());
    ASSERT_TRUE(job.ok()) << job.status();
    EXPECT_GT(job->job.cycles_size(), 0);
    const auto page = ReadEvents({.name = header.job.name(), .max_bytes = 1 << 30});
    ASSERT_EQ(page->events.size(), job->job.last_sequence());
    for (const StoredEvent& stored : page->events) {
      v1::Event event;
      EXPECT_TRUE(stored.Parse(&event)) << stored.sequence;
    }
  }
  store_.reset();
  EXPECT_EQ(Version(database()), kSchemaVersion);
  EXPECT_EQ(Rows(database()), before);
}

TEST_P(MigrationTest, TablesAreThoseOfANewStore) {
  MakeOldVersion();
  Open();
  store_.reset();
  const std::set<std::string> migrated = Tables();
  std::filesystem::remove_all(path());
  Open();
  store_.reset();
  EXPECT_EQ(migrated, Tables());
}

TEST_P(MigrationTest, EndsAndSizesAreFilledIn) {
  MakeOldVersion();
  Open();
  const auto sizes = Sizes();
  ASSERT_TRUE(sizes.ok());
  ASSERT_EQ(sizes->size(), 2U);
  for (const JobSize& size : *sizes) {
    EXPECT_EQ(size.end_time, Read(size.name)->job.end_time().seconds());
    EXPECT_EQ(size.bytes, StoredBytes(size.name));
  }
}

TEST_P(MigrationTest, OldDatabaseIsKeptBesideTheNew) {
  MakeOldVersion();
  const std::set<std::string> before = Rows(database());
  Open();
  store_.reset();
  const std::filesystem::path kept = path() / absl::StrCat("contactd.db.v", GetParam());
  EXPECT_EQ(Version(kept), GetParam());
  EXPECT_EQ(Rows(kept), before);
}

TEST_P(MigrationTest, DiskThatFailsAnywhereLeavesTheOldOrTheNew) {
  MakeOldVersion();
  const std::set<std::string> before = Rows(database());
  int old_left = 0;
  bool done = false;
  for (int n = 0; !done; ++n) {
    ASSERT_LT(n, 1000);
    MakeOldVersion();
    {
      FailingDisk disk;
      disk.FailAfter(n);
      const auto opened = OpenSqlite(path());
      done = opened.ok() && !disk.failed();
    }
    // The log of SQLite, if there is one, belongs to the database.
    const std::filesystem::path image = directory_.path() / "image";
    std::filesystem::remove_all(image);
    std::filesystem::copy(path(), image);
    const int version = Version(image / "contactd.db");
    EXPECT_TRUE(version == GetParam() || version == kSchemaVersion) << n;
    if (version == GetParam()) ++old_left;
    EXPECT_EQ(Rows(image / "contactd.db"), before) << n;
    Open();
    EXPECT_EQ(Sizes()->size(), 2U);
    store_.reset();
    EXPECT_EQ(Version(database()), kSchemaVersion);
  }
  EXPECT_GT(old_left, 15) << "the test must bite";
}

// What version 3 has added is as if the job had been made by it.
TEST_P(MigrationTest, NothingIsCompactedNorGoesOn) {
  MakeOldVersion();
  Open();
  const auto jobs = List({});
  ASSERT_TRUE(jobs.ok());
  for (const StoredJob& header : jobs->jobs) {
    const auto job = Read(header.job.name(), JobPart::kRun);
    ASSERT_TRUE(job.ok()) << job.status();
    EXPECT_FALSE(job->compacted);
    EXPECT_EQ(job->job.oldest_sequence(), 1U);
    EXPECT_TRUE(job->checkpoint.empty());
  }
}

// Gives the spec of a job a title, as a client would have sent it.
void SetTitle(SQLite::Database& raw, int job, const std::string& title) {
  SQLite::Statement read(raw, "SELECT spec FROM specs WHERE job=?");
  read.bind(1, job);
  ASSERT_TRUE(read.executeStep());
  v1::Job spec;
  ASSERT_TRUE(spec.ParseFromString(read.getColumn(0).getString()));
  spec.mutable_scenario()->set_title(title);
  const std::string bytes = spec.SerializeAsString();
  SQLite::Statement write(raw, "UPDATE specs SET spec=?, crc32=? WHERE job=?");
  write.bind(1, bytes.data(), static_cast<int>(bytes.size()));
  write.bind(2, Checksum(bytes));
  write.bind(3, job);
  write.exec();
}

// What version 4 has added.
TEST_P(MigrationTest, HeadersLearnTheTitle) {
  if (GetParam() >= 4) GTEST_SKIP() << "they have it";
  MakeOldVersion();
  {
    SQLite::Database raw(database(), SQLite::OPEN_READWRITE);
    SetTitle(raw, 1, "Triple-ball chain");
  }
  Open();
  const auto jobs = List({});
  ASSERT_TRUE(jobs.ok());
  ASSERT_EQ(jobs->jobs.size(), 2U);
  EXPECT_EQ(jobs->jobs[1].job.title(), "Triple-ball chain");
  EXPECT_TRUE(jobs->jobs[1].intact);
  EXPECT_EQ(jobs->jobs[1].job.state(), v1::Job::SUCCEEDED);
  const auto other = Read(jobs->jobs[0].job.name());
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(other->job.title(), other->job.scenario().title());
  EXPECT_TRUE(Read(jobs->jobs[1].job.name()).ok());
}

TEST_P(MigrationTest, DamagedHeaderStaysDamaged) {
  MakeOldVersion();
  {
    SQLite::Database raw(database(), SQLite::OPEN_READWRITE);
    SetTitle(raw, 1, "Triple-ball chain");
    raw.exec("UPDATE jobs SET crc32=crc32+1 WHERE number=1");
  }
  Open();
  const auto jobs = List({});
  ASSERT_TRUE(jobs.ok());
  EXPECT_FALSE(jobs->jobs[1].intact);
  EXPECT_TRUE(jobs->jobs[0].intact);
}

// What version 5 has added.
TEST_P(MigrationTest, JobsAndRequestIdsBelongToEverybody) {
  MakeOldVersion();
  {
    SQLite::Database raw(database(), SQLite::OPEN_READWRITE);
    raw.exec(absl::StrCat("UPDATE jobs SET request_id='", GetParam() < 5 ? "" : "local/",
                          "again' WHERE number=1"));
  }
  Open();
  const auto jobs = List({.tenant = kLocal});
  ASSERT_TRUE(jobs.ok());
  ASSERT_EQ(jobs->jobs.size(), 2U);
  const v1::Job first = Read(jobs->jobs[1].job.name())->job;
  EXPECT_EQ(first.owner(), kLocal);
  EXPECT_EQ(first.tenant(), kLocal);
  v1::Job job = first;
  job.set_name("jobs/new");
  EXPECT_EQ(Create(job, "again")->job.name(), first.name()) << "the id is known";
  job.set_tenant("acme");
  EXPECT_EQ(Create(job, "again")->job.name(), "jobs/new") << "to the tenant that used it";
}

// What version 6 has added.
TEST_P(MigrationTest, RowsAreSealed) {
  MakeOldVersion();
  Open();
  store_.reset();
  SQLite::Database(database(), SQLite::OPEN_READWRITE).exec("UPDATE jobs SET epoch=epoch+1");
  Open();
  const auto jobs = List({});
  ASSERT_TRUE(jobs.ok());
  for (const StoredJob& job : jobs->jobs) EXPECT_FALSE(job.intact) << job.job.name();
}

INSTANTIATE_TEST_SUITE_P(FromVersion, MigrationTest, testing::Values(1, 2, 3, 4, 5, 6, 7),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace contact
