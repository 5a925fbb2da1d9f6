#include "storage/sqlite/database.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <tuple>

#include "testing/temp_directory.h"

namespace contact {
namespace {

class DatabaseTest : public testing::Test {
 protected:
  DatabaseTest() {
    auto opened = Database::Open(*DataDirectory::Open(folder_.path() / "data"), 0);
    if (!opened.ok()) throw std::runtime_error(opened.status().ToString());
    database_ = *std::move(opened);
    database_->connection().exec("CREATE TABLE things(number INTEGER PRIMARY KEY, bytes BLOB)");
  }

  TempDirectory folder_;
  std::unique_ptr<Database> database_;
};

TEST_F(DatabaseTest, ValuesComeBackAsTheyWereBound) {
  const std::string blob("\0\xff\0 with zeros", 13);
  enum class Kind { kThird = 3 };
  for (const std::int64_t number : {INT64_MIN, std::int64_t{-1}, INT64_MAX}) {
    Execute(*database_, "INSERT INTO things VALUES(?,?)", number, Query::Blob{blob});
    EXPECT_EQ(database_->LastInsertRowid(), number);
    Query row(*database_, "SELECT number, bytes, ?, ? FROM things WHERE number=?", Kind::kThird,
              std::string("text"), number);
    ASSERT_TRUE(row.Next());
    EXPECT_EQ(row.Integer(0), number);
    EXPECT_EQ(row.Bytes(1), blob);
    EXPECT_EQ(row.Integer(2), 3);
    EXPECT_EQ(row.Bytes(3), "text");
    EXPECT_FALSE(row.Next());
  }
}

TEST_F(DatabaseTest, NullIsZeroAndEmpty) {
  Execute(*database_, "INSERT INTO things(number) VALUES(1)");
  Query row(*database_, "SELECT bytes, SUM(bytes) FROM things WHERE number=1");
  ASSERT_TRUE(row.Next());
  EXPECT_EQ(row.Bytes(0), "");
  EXPECT_EQ(row.Integer(1), 0);
}

TEST_F(DatabaseTest, StatementIsPreparedOnceAndForgetsItsLastValues) {
  const std::string insert = "INSERT INTO things(number, bytes) VALUES(?,?)";
  EXPECT_EQ(Query(*database_, insert, 1, std::string("one")).Run(), 1);
  const SQLite::Statement* const prepared = &database_->Prepared(insert);
  EXPECT_EQ(Query(*database_, insert, 2).Run(), 1);
  EXPECT_EQ(&database_->Prepared(insert), prepared);
  Query row(*database_, "SELECT bytes IS NULL FROM things WHERE number=2");
  ASSERT_TRUE(row.Next());
  EXPECT_EQ(row.Integer(0), 1);
}

TEST_F(DatabaseTest, CheckpointEmptiesTheLog) {
  EXPECT_GT(database_->log_pages(), 0) << "the table of this test";
  database_->Checkpoint();
  EXPECT_EQ(database_->log_pages(), 0);
  Execute(*database_, "INSERT INTO things(number) VALUES(1)");
  EXPECT_GT(database_->log_pages(), 0);
}

TEST(ToStatus, TellsNoSpaceFromDamageFromAFailedDisk) {
  using Code = absl::StatusCode;
  for (const auto& [error, code] : {std::tuple{SQLITE_FULL, Code::kResourceExhausted},
                                    {SQLITE_NOMEM, Code::kResourceExhausted},
                                    {SQLITE_CORRUPT, Code::kDataLoss},
                                    {SQLITE_NOTADB, Code::kDataLoss},
                                    {SQLITE_IOERR, Code::kUnavailable},
                                    {SQLITE_CANTOPEN, Code::kUnavailable},
                                    {SQLITE_READONLY, Code::kUnavailable},
                                    {SQLITE_CONSTRAINT, Code::kInternal},
                                    {SQLITE_MISUSE, Code::kInternal}}) {
    const absl::Status status = ToStatus(SQLite::Exception("what SQLite says", error));
    EXPECT_EQ(status.code(), code) << error;
    EXPECT_NE(status.message().find("what SQLite says"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace contact
