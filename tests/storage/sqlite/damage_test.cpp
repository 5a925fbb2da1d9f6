// What a store does with files that are not as it left them.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <random>

#include "storage/sqlite/fsck.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/store_fixture.h"

namespace contact {
namespace {

using testing::HasSubstr;

std::string Contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Overwrite(const std::filesystem::path& file, std::streamoff place, const std::string& bytes) {
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(place);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

class DamageTest : public StoreTest {
 protected:
  // Some jobs with logs, closed properly.
  void Fill() {
    Open();
    for (const char* name : {"jobs/a", "jobs/b", "jobs/c"}) {
      ASSERT_TRUE(Create(MakeJob(name)).ok());
      std::vector<v1::Event> events(50, LogEvent(std::string(500, 'x')));
      for (int i = 0; i < 10; ++i) events.push_back(FrameEvent(64 * i));
      ASSERT_TRUE(Append(name, events).ok());
      v1::Job ended = MakeJob(name);
      ended.set_state(v1::Job::SUCCEEDED);
      ended.add_cycles()->set_mu(2e8);
      ASSERT_TRUE(Update({.name = name, .epoch = 0, .job = &ended}).ok());
    }
    store_.reset();
  }

  // Opens the store, which must refuse and leave the database alone.
  absl::Status Refusal() {
    const std::string before = Contents(database());
    absl::Status status = OpenSqlite(path()).status();
    EXPECT_EQ(Contents(database()), before);
    return status;
  }
};

TEST_F(DamageTest, GarbageHeaderIsRefused) {
  Fill();
  Overwrite(database(), 0, "this is no database");
  const absl::Status status = Refusal();
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_THAT(status.ToString(), HasSubstr(database().string()));
  EXPECT_THAT(status.ToString(), HasSubstr("backup"));
}

TEST_F(DamageTest, TruncatedDatabaseIsRefused) {
  Fill();
  std::filesystem::resize_file(database(), std::filesystem::file_size(database()) / 2);
  const absl::Status status = Refusal();
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
}

TEST_F(DamageTest, EmptyDatabaseIsNotTakenForANewOne) {
  Fill();
  std::filesystem::resize_file(database(), 0);
  const absl::Status status = Refusal();
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_THAT(status.ToString(), HasSubstr("empty"));
}

TEST_F(DamageTest, MissingDatabaseIsNotMadeAnew) {
  Fill();
  std::filesystem::remove(database());
  const absl::Status status = OpenSqlite(path()).status();
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_FALSE(std::filesystem::exists(database()));
}

TEST_F(DamageTest, NewerSchemaIsRefused) {
  Fill();
  SQLite::Database(database(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version=99");
  const absl::Status status = Refusal();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(status.ToString(), HasSubstr("schema version 99"));
}

TEST_F(DamageTest, SecondOpenIsRefusedAndNamesTheHolder) {
  Open();
  const absl::Status status = OpenSqlite(path()).status();
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(status.ToString(), HasSubstr("process " + std::to_string(::getpid())));
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok()) << "the holder goes on";
}

TEST_F(DamageTest, CrashBeforeTheMarkerIsNoLoss) {
  Fill();
  std::filesystem::remove(path() / "initialised");
  Open();
  EXPECT_TRUE(Read("jobs/a").ok());
  EXPECT_TRUE(std::filesystem::exists(path() / "initialised"));
}

TEST_F(DamageTest, CommittedWorkSurvivesWithoutAProperClose) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::filesystem::path image = directory_.path() / "image";
  std::filesystem::copy(path(), image);  // As a crash would leave it: the log not folded in.
  const auto copy = OpenSqlite(image);
  ASSERT_TRUE(copy.ok()) << copy.status();
  Await<absl::StatusOr<StoredJob>> job;
  (*copy)->Read("jobs/a", JobPart::kAll, job.callback());
  EXPECT_TRUE(job.Get().ok());
}

// One bit somewhere in what is stored of a job.
struct Flip {
  const char* column;
  const char* table;
  std::string row;  // Condition.

  std::string Read(const std::filesystem::path& database) const {
    SQLite::Database raw(database);
    SQLite::Statement read(raw, std::string("SELECT ") + column + " FROM " + table + row);
    EXPECT_TRUE(read.executeStep());
    return read.getColumn(0).getString();
  }
  void Write(const std::filesystem::path& database, const std::string& bytes) const {
    SQLite::Database raw(database, SQLite::OPEN_READWRITE);
    raw.exec("PRAGMA synchronous=OFF");
    SQLite::Statement update(raw, std::string("UPDATE ") + table + " SET " + column + "=?" + row);
    update.bind(1, bytes.data(), static_cast<int>(bytes.size()));
    update.exec();
  }
};

TEST_F(DamageTest, EveryFlippedBitIsFoundAndCostsThatObjectOnly) {
  Fill();
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const auto event = 1 + random() % 61;
    const Flip flip = i % 4 == 0   ? Flip{"spec", "specs", " WHERE job=1"}
                      : i % 4 == 1 ? Flip{"result", "results", " WHERE job=1"}
                                   : Flip{"payload", "events",
                                          " WHERE job=1 AND sequence=" + std::to_string(event)};
    const std::string good = flip.Read(database());
    std::string bad = good;
    bad[random() % bad.size()] ^= static_cast<char>(1U << (random() % 8));
    flip.Write(database(), bad);
    std::vector<std::string> findings;
    const auto report =
        Fsck(path(), [&](const std::string& finding) { findings.push_back(finding); });
    ASSERT_TRUE(report.ok()) << report.status();
    EXPECT_THAT(findings, testing::ElementsAre(testing::StartsWith("jobs/a: "))) << flip.table;
    Open();
    const bool log = i % 4 > 1;
    EXPECT_EQ(absl::IsDataLoss(Read("jobs/a").status()), !log);
    EXPECT_TRUE(Read("jobs/a", JobPart::kHeader).ok());
    EXPECT_TRUE(Read("jobs/b").ok());
    const auto page = ReadEvents({.name = "jobs/a", .max_bytes = 1 << 30});
    ASSERT_EQ(page->events.size(), 61U);
    for (const StoredEvent& stored : page->events) {
      v1::Event read;
      EXPECT_EQ(stored.intact, !log || stored.sequence != event);
      EXPECT_EQ(stored.Parse(&read), stored.intact);
    }
    store_.reset();
    flip.Write(database(), good);
  }
  EXPECT_EQ(Fsck(path(), [](const std::string& finding) { ADD_FAILURE() << finding; })->findings,
            0);
}

TEST_F(DamageTest, FlippedBitOfAJobCostsThatJobOnly) {
  Fill();
  for (const char* part : {"jobs SET header=CAST(header || 'x' AS BLOB) WHERE number=1",
                           "specs SET spec=CAST(spec || 'x' AS BLOB) WHERE job=2"}) {
    SQLite::Database(database(), SQLite::OPEN_READWRITE).exec(std::string("UPDATE ") + part);
  }
  Open();
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a").status()));
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/b").status()));
  EXPECT_TRUE(Read("jobs/b", JobPart::kHeader).ok());
  EXPECT_TRUE(Read("jobs/c").ok());
  const auto page = List({});
  ASSERT_TRUE(page.ok());
  ASSERT_EQ(page->jobs.size(), 3U);
  EXPECT_FALSE(page->jobs[2].intact);
  EXPECT_EQ(page->jobs[2].job.name(), "jobs/a");
}

// Whoever can change a bit of the file must not give a job to another tenant unnoticed.
TEST_F(DamageTest, TenantThatIsNotThatOfTheHeaderIsDamage) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a"), "x").ok());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  for (const char* sql : {"UPDATE jobs SET tenant='a longer umbra' WHERE name='jobs/a'",
                          "UPDATE jobs SET owner='eve' WHERE name='jobs/b'"}) {
    store_.reset();
    SQLite::Database(database(), SQLite::OPEN_READWRITE).exec(sql);
    Open();
  }
  EXPECT_TRUE(absl::IsDataLoss(ReadOf("a longer umbra", "jobs/a").status()));
  EXPECT_TRUE(absl::IsDataLoss(ReadOf(kLocal, "jobs/b").status()));
  store_.reset();
  EXPECT_EQ(Fsck(path(), [](const std::string&) {})->findings, 2);
}

}  // namespace
}  // namespace contact
