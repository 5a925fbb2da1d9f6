// What becomes of the databases of earlier versions. version_1.sql and version_2.sql are dumps of
// tables and functions, each later one makes its version of the one before. All have the same jobs:
// three that succeeded, one of them a sweep and one being compacted; one that ran, with a
// checkpoint; a sweep that a worker has, which lends its cells; one that waits and is to be
// cancelled; one that was deleted. Two workers had them and are dead.
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "storage/checksum.h"
#include "storage/every_store.h"
#include "storage/postgres/schema.h"

namespace contact {
namespace {

using postgres::Connection;
using testing::HasSubstr;

class PostgresMigrationTest : public StoreTest, public testing::WithParamInterface<int> {
 protected:
  PostgresMigrationTest() { MakeOldVersion(); }
  ~PostgresMigrationTest() override { store_.reset(); }

  absl::StatusOr<std::unique_ptr<Store>> OpenStore(StoreOptions options) override {
    return OpenPostgres(database_.address(), std::move(options));
  }
  absl::Status Migrate(const postgres::Grants& grants = {}) {
    return MigratePostgres(database_.address(), grants);
  }

  void MakeOldVersion() {
    Script("DROP SCHEMA IF EXISTS contactd CASCADE");
    Script(Text(std::min(GetParam(), 2)));
    for (int version = 3; version <= GetParam(); ++version) Script(Text(version));
  }
  static std::string Text(int version) {
    std::ostringstream text;
    text << std::ifstream(absl::StrCat(CONTACT_SOURCE_DIR, "/tests/storage/postgres/version_",
                                       version, ".sql"))
                .rdbuf();
    return text.str();
  }

  void Script(const std::string& sql) {
    const absl::Status done = connection_->RunScript(sql);
    ASSERT_TRUE(done.ok()) << done;
  }
  std::int64_t Ask(const std::string& sql) { return connection_->Run({sql})->Integer(0, 0); }
  // The texts that a query answers, one a row.
  std::set<std::string> Texts(const std::string& sql) {
    const auto rows = connection_->Run({sql});
    EXPECT_TRUE(rows.ok()) << rows.status();
    std::set<std::string> texts;
    for (int i = 0; rows.ok() && i < rows->size(); ++i) texts.insert(rows->Bytes(i, 0));
    return texts;
  }

  // The rows of all tables; of a job without the columns of version 6 that nobody has filled.
  std::set<std::string> Everything() {
    std::set<std::string> rows;
    for (const std::string& table : Texts("SELECT tablename::text FROM pg_tables WHERE"
                                          " schemaname = 'contactd' AND tablename <> 'version'")) {
      rows.merge(
          Texts(absl::StrCat("SELECT '", table, " ' || replace(t::text, '",
                             R"(,-1,"\\x",-1,"\\x"))", "', ')') FROM contactd.", table, " t")));
    }
    return rows;
  }
  // Columns, tables, constraints, indices and functions.
  std::set<std::string> Definitions() {
    return Texts(
        "SELECT concat_ws(' ', attrelid::regclass, attname, format_type(atttypid, atttypmod),"
        "   attnotnull, attstorage, attcollation, attidentity, pg_get_expr(adbin, adrelid))"
        " FROM pg_attribute LEFT JOIN pg_attrdef ON adrelid = attrelid AND adnum = attnum"
        " JOIN pg_class c ON c.oid = attrelid WHERE relnamespace = 'contactd'::regnamespace"
        "   AND attnum > 0 AND NOT attisdropped"
        " UNION SELECT concat_ws(' ', relname, reloptions, relacl) FROM pg_class"
        "   WHERE relnamespace = 'contactd'::regnamespace"
        " UNION SELECT concat_ws(' ', conrelid::regclass, pg_get_constraintdef(oid))"
        "   FROM pg_constraint WHERE connamespace = 'contactd'::regnamespace"
        " UNION SELECT indexdef FROM pg_indexes WHERE schemaname = 'contactd'"
        " UNION SELECT concat_ws(' ', pg_get_functiondef(oid), proacl)"
        "   FROM pg_proc WHERE pronamespace = 'contactd'::regnamespace");
  }

  // From now on a command that changes the schema fails if the condition holds.
  void FailIf(const std::string& condition) {
    Script(absl::StrCat(
        "CREATE SEQUENCE public.commands; CREATE TABLE public.allowed AS SELECT 0 AS most;"
        "CREATE FUNCTION public.stop() RETURNS event_trigger LANGUAGE plpgsql AS $$ BEGIN IF ",
        condition, " THEN RAISE 'enough'; END IF; END $$;",
        "CREATE EVENT TRIGGER stop ON ddl_command_start EXECUTE FUNCTION public.stop()"));
  }
  // The condition that there have been more commands than allowed.
  static constexpr char kEnough[] =
      "nextval('public.commands') > (SELECT most FROM public.allowed)";
  void AllowCommands(int most) {
    Script(absl::StrCat("UPDATE public.allowed SET most = ", most,
                        "; SELECT setval('public.commands', 1, false)"));
  }
  std::int64_t Commands() { return Ask("SELECT nextval('public.commands')"); }

  PostgresDatabase database_;
  const std::unique_ptr<Connection> connection_ = Connection::Open(database_.address()).value();
};

TEST_P(PostgresMigrationTest, EverythingIsThereAfterwards) {
  const std::set<std::string> before = Everything();
  ASSERT_EQ(Ask("SELECT version FROM contactd.version"), GetParam());
  ASSERT_TRUE(Migrate().ok());
  EXPECT_EQ(Ask("SELECT contactd.schema_version()"), postgres::kSchemaVersion);
  EXPECT_EQ(Everything(), before);
}

TEST_P(PostgresMigrationTest, JobsAreReadWithTheirLogs) {
  Open();
  const auto page = List({});
  ASSERT_TRUE(page.ok()) << page.status();
  ASSERT_EQ(page->jobs.size(), 6U);
  for (const StoredJob& header : page->jobs) {
    const auto job = Read(header.job.name());
    ASSERT_TRUE(job.ok()) << job.status();
    const auto events = ReadEvents({.name = header.job.name(), .max_bytes = 1 << 30});
    EXPECT_TRUE(header.compacted || events->events.size() == job->job.last_sequence());
    for (const StoredEvent& stored : events->events) {
      v1::Event event;
      EXPECT_TRUE(stored.Parse(&event)) << stored.sequence;
    }
  }
  EXPECT_EQ(Create(page->jobs.back().job, "once")->job.name(), page->jobs.back().job.name());
}

TEST_P(PostgresMigrationTest, JobsOfDeadWorkersGoOn) {
  const auto store = OpenPostgres(database_.address()).value();
  Await<absl::StatusOr<std::vector<HeldJob>>> beaten;
  store->Beat({.name = "w", .host = "h"}, beaten.callback());
  ASSERT_TRUE(beaten.Get().ok());
  Await<absl::StatusOr<std::vector<StoredJob>>> claimed;
  store->Claim({.worker = "w", .most = 9}, claimed.callback());
  const auto jobs = claimed.Get();
  ASSERT_TRUE(jobs.ok()) << jobs.status();
  ASSERT_EQ(jobs->size(), 3U);
  EXPECT_EQ((*jobs)[0].checkpoint, "where the run goes on");
  EXPECT_EQ((*jobs)[0].epoch, 3U);
  EXPECT_TRUE((*jobs)[1].job.has_sweep());
  EXPECT_TRUE((*jobs)[2].cancel_requested);
}

TEST_P(PostgresMigrationTest, TablesAndFunctionsAreThoseOfANewDatabase) {
  ASSERT_TRUE(Migrate().ok());
  const std::set<std::string> migrated = Definitions();
  Script("DROP SCHEMA contactd CASCADE");
  ASSERT_TRUE(Migrate().ok());
  EXPECT_EQ(migrated, Definitions());
}

TEST_P(PostgresMigrationTest, FailureAtAnyCommandLeavesTheOldVersion) {
  const std::set<std::string> rows = Everything();
  const std::set<std::string> definitions = Definitions();
  FailIf(kEnough);
  int failures = 0;
  for (AllowCommands(0); !Migrate().ok(); AllowCommands(++failures)) {
    ASSERT_LT(failures, 1000);
    ASSERT_EQ(Everything(), rows) << failures;
    ASSERT_EQ(Definitions(), definitions) << failures;
  }
  EXPECT_GT(failures, 50) << "the test must bite";
  EXPECT_EQ(Everything(), rows);
  EXPECT_EQ(Ask("SELECT contactd.schema_version()"), postgres::kSchemaVersion);
}

TEST_P(PostgresMigrationTest, ProgramsThatBeginAtOnceMigrateOnce) {
  FailIf(kEnough);
  AllowCommands(1'000'000);
  ASSERT_TRUE(Migrate().ok());
  const std::int64_t once = Commands();
  MakeOldVersion();
  AllowCommands(1'000'000);
  std::vector<std::thread> programs;
  const auto migrate = [this] {
    const absl::Status migrated = Migrate();
    EXPECT_TRUE(migrated.ok()) << migrated;
  };
  for (int i = 0; i < 8; ++i) programs.emplace_back(migrate);
  for (std::thread& program : programs) program.join();
  EXPECT_EQ(Commands(), once);
  EXPECT_EQ(Ask("SELECT count(*) FROM contactd.version"), 1);
}

TEST_P(PostgresMigrationTest, NoCommandIsCutShort) {
  FailIf("current_setting('statement_timeout') <> '0'");
  const absl::Status migrated = Migrate();
  EXPECT_TRUE(migrated.ok()) << migrated;
}

TEST_P(PostgresMigrationTest, GrantThatFailsLeavesTheOldVersion) {
  const std::set<std::string> definitions = Definitions();
  EXPECT_FALSE(Migrate({.front = "no such role"}).ok());
  EXPECT_EQ(Definitions(), definitions);
}

// A role of the server, until the end of the scope.
class Role {
 public:
  explicit Role(Connection& connection) : connection_(connection) {
    EXPECT_TRUE(connection_.RunScript("CREATE ROLE " + name_ + " LOGIN").ok());
  }
  ~Role() {
    EXPECT_TRUE(connection_.RunScript("DROP OWNED BY " + name_ + "; DROP ROLE " + name_).ok());
  }
  Role(const Role&) = delete;
  Role& operator=(const Role&) = delete;

  const std::string& name() const { return name_; }
  absl::Status Open(const PostgresDatabase& database) const {
    return OpenPostgres(
               absl::StrReplaceAll(database.address(), {{"contactd@", absl::StrCat(name_, "@")}}))
        .status();
  }

 private:
  Connection& connection_;
  const std::string name_ = "role_" + RandomIds().NextId();
};

TEST_P(PostgresMigrationTest, RoleThatOwnsNothingIsToldToMigrateUntilItHasItsRights) {
  const Role role(*connection_);
  Script("GRANT USAGE ON SCHEMA contactd TO " + role.name() +
         "; GRANT SELECT ON ALL TABLES IN SCHEMA contactd TO " + role.name() +
         "; GRANT EXECUTE ON ALL FUNCTIONS IN SCHEMA contactd TO " + role.name());
  const std::set<std::string> definitions = Definitions();
  const absl::Status old = role.Open(database_);
  EXPECT_TRUE(absl::IsFailedPrecondition(old)) << old;
  EXPECT_THAT(std::string(old.message()),
              HasSubstr("has tables of an older version; run contactd migrate as their owner"));
  EXPECT_EQ(Definitions(), definitions);
  ASSERT_TRUE(Migrate().ok());
  const absl::Status bare = role.Open(database_);
  EXPECT_TRUE(absl::IsFailedPrecondition(bare)) << bare;
  EXPECT_THAT(std::string(bare.message()),
              HasSubstr("run contactd migrate as the owner of its tables, with --grant-front"));
  ASSERT_TRUE(Migrate({.front = role.name()}).ok());
  EXPECT_TRUE(role.Open(database_).ok());
}

INSTANTIATE_TEST_SUITE_P(FromVersion, PostgresMigrationTest, testing::Values(1, 2, 3, 4, 5),
                         testing::PrintToStringParamName());

// A database that has a version has its tables and functions. Once a version is in use, another
// schema is another version: raise kSchemaVersion, keep what the last one was, add its step.
TEST(PostgresSchemaTest, VersionNamesOneSchema) {
  const std::string schema = absl::StrCat(postgres::kTables, postgres::kFunctions,
                                          postgres::kReaderFunctions, postgres::kWorkerFunctions);
  EXPECT_EQ(std::pair(postgres::kSchemaVersion, Checksum(schema)),
            std::pair(6, std::int64_t{2310670383}));
}

}  // namespace
}  // namespace contact
