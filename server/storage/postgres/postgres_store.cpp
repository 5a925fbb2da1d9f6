#include "storage/postgres/postgres_store.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <libpq-fe.h>

#include <optional>
#include <string_view>
#include <utility>

#include "storage/postgres/migration.h"
#include "storage/postgres/query_thread.h"
#include "storage/postgres/statements.h"

namespace contact {
namespace {

using postgres::Connection;
using postgres::Rows;
using postgres::Statement;

// Opens a connection that keeps other programs from the store.
absl::StatusOr<std::unique_ptr<Connection>> OpenAlone(const std::string& address) {
  auto connection = Connection::Open(address);
  if (!connection.ok()) return connection;
  const absl::Status alone = (*connection)->RunScript(postgres::kTakeStore);
  if (absl::IsAborted(alone)) {
    return absl::UnavailableError((*connection)->Name() + " is used by another contactd");
  }
  if (!alone.ok()) return alone;
  return connection;
}

// The calls of Store, each a statement of the one thread.
class PostgresStore : public Store {
 public:
  PostgresStore(const std::string& address, std::unique_ptr<Connection> connection,
                StoreOptions options)
      : queries_([address] { return OpenAlone(address); }, std::move(connection), postgres::Purge(),
                 std::move(options.metrics), *options.clock) {}

  using Store::Update;
  void Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) override {
    Post<std::uint64_t>(
        postgres::ChangeJob(*change, epoch),
        [change](const Rows& rows) { return postgres::Changed(rows, change->name); },
        std::move(done));
  }

  void RequestCancel(std::string name, Callback<bool> done) override {
    Statement statement = postgres::RequestCancel(name);
    Post<bool>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::Done(rows, name); },
        std::move(done));
  }

  void Read(std::string name, JobPart part, Callback<StoredJob> done) override {
    Statement statement = postgres::ReadJob(name, std::nullopt, part);
    PostRead(std::move(statement), std::move(name), std::move(done));
  }

  void ReadOf(std::string tenant, std::string name, JobPart part,
              Callback<StoredJob> done) override {
    Statement statement = postgres::ReadJob(name, std::move(tenant), part);
    PostRead(std::move(statement), std::move(name), std::move(done));
  }

  void Owner(std::string tenant, std::string name, Callback<JobOwner> done) override {
    Statement statement = postgres::FindOwner(tenant, name);
    Post<JobOwner>(
        std::move(statement),
        [name = std::move(name), tenant = std::move(tenant)](const Rows& rows) {
          return postgres::OwnerOf(rows, name, tenant);
        },
        std::move(done));
  }

  void OwnerBytes(JobOwner whose, Callback<std::int64_t> done) override {
    Post<std::int64_t>(
        postgres::SumBytes(whose),
        [](const Rows& rows) -> absl::StatusOr<std::int64_t> { return rows.Integer(0, 0); },
        std::move(done));
  }

  void List(JobQuery query, Callback<JobPage> done) override {
    Post<JobPage>(
        postgres::ListJobs(query),
        [limit = query.limit](const Rows& rows) { return postgres::PageOf(rows, limit); },
        std::move(done));
  }

  void ListUnfinished(Callback<std::vector<StoredJob>> done) override {
    Post<std::vector<StoredJob>>(postgres::ListUnfinished(), postgres::JobsOf, std::move(done));
  }

  void Sizes(Callback<std::vector<JobSize>> done) override {
    Post<std::vector<JobSize>>(postgres::ListSizes(), postgres::SizesOf, std::move(done));
  }

  void ReadEvents(EventQuery query, Callback<EventPage> done) override {
    Statement statement = postgres::ReadEvents(query);
    Post<EventPage>(
        std::move(statement),
        [query = std::move(query)](const Rows& rows) { return postgres::EventsOf(rows, query); },
        std::move(done));
  }

  void Delete(std::string name, std::string expected_uid, Callback<JobOwner> done) override {
    Statement statement = postgres::RemoveJob(name, expected_uid);
    Post<JobOwner>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::Removed(rows, name); },
        std::move(done));
  }

  void Compact(std::string name, Callback<JobOwner> done) override {
    Statement statement = postgres::CompactJob(name);
    Post<JobOwner>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::Compacted(rows, name); },
        std::move(done));
  }

  void Backup(std::stop_token /*stop*/, Callback<std::unique_ptr<BackupFile>> done) override {
    queries_.Post({{}, [done = std::move(done)](const absl::StatusOr<Rows>& /*told*/) {
                     done(absl::FailedPreconditionError(
                         "the store is a PostgreSQL database; copy it with pg_dump"));
                   }});
  }

  void Flush(std::function<void()> done) override {
    queries_.Post({{}, [done = std::move(done)](const absl::StatusOr<Rows>& /*told*/) { done(); }});
  }

 private:
  void Insert(JobInsert job, Callback<StoredJob> done) override {
    Statement statement = postgres::CreateJob(job);
    Post<StoredJob>(
        std::move(statement),
        [name = std::move(job.name)](const Rows& rows) { return postgres::Created(rows, name); },
        std::move(done));
  }

  void PostRead(Statement statement, std::string name, Callback<StoredJob> done) {
    Post<StoredJob>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::JobOf(rows, name); },
        std::move(done));
  }

  // Runs the statement, and gives `done` what `read` makes of its rows once that is committed.
  template <class T, class Read>
  void Post(Statement statement, Read read, Callback<T> done) {
    queries_.Post({std::move(statement), [read = std::move(read), done = std::move(done)](
                                             const absl::StatusOr<Rows>& rows) {
                     if (rows.ok()) {
                       done(read(*rows));
                     } else {
                       done(rows.status());
                     }
                   }});
  }

  postgres::QueryThread queries_;
};

}  // namespace

bool IsPostgresAddress(const std::string& address) {
  return absl::StartsWith(address, "postgresql://") || absl::StartsWith(address, "postgres://");
}

std::string PostgresName(const std::string& address) {
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
      PQconninfoParse(address.c_str(), nullptr), PQconninfoFree);
  std::string database, host;
  for (const PQconninfoOption* option = options.get(); option && option->keyword; ++option) {
    if (option->val == nullptr) continue;
    if (std::string_view(option->keyword) == "dbname") database = option->val;
    if (std::string_view(option->keyword) == "host") host = option->val;
  }
  return absl::StrCat("PostgreSQL database ", database, host.empty() ? "" : " at ", host);
}

absl::Status MigratePostgres(const std::string& address) {
  const auto connection = Connection::Open(address);
  return connection.ok() ? postgres::Migrate(**connection) : connection.status();
}

absl::StatusOr<std::unique_ptr<Store>> OpenPostgres(const std::string& address,
                                                    StoreOptions options) {
  if (absl::Status made = MigratePostgres(address); !made.ok()) return made;
  auto connection = OpenAlone(address);
  if (!connection.ok()) return connection.status();
  return std::make_unique<PostgresStore>(address, *std::move(connection), std::move(options));
}

}  // namespace contact
