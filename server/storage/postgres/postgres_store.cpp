#include "storage/postgres/postgres_store.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <libpq-fe.h>

#include <optional>
#include <string_view>
#include <utility>

#include "base/mutex.h"
#include "storage/postgres/bulletin.h"
#include "storage/postgres/migration.h"
#include "storage/postgres/query_thread.h"
#include "storage/postgres/statements.h"
#include "storage/postgres/worker_statements.h"

namespace contact {
namespace {

using postgres::Connection;
using postgres::Rows;
using postgres::Statement;

// Opens a connection that takes part in the use of the store as `lock` says.
absl::StatusOr<std::unique_ptr<Connection>> OpenLocked(const std::string& address,
                                                       const char* lock) {
  auto connection = Connection::Open(address);
  if (!connection.ok()) return connection;
  const absl::Status taken = (*connection)->RunScript(lock);
  if (absl::IsAborted(taken)) {
    return absl::UnavailableError((*connection)->Name() + " is used by another contactd");
  }
  if (!taken.ok()) return taken;
  return connection;
}

// The calls of SharedStore, each a statement of the one thread.
class PostgresStore : public SharedStore {
 public:
  PostgresStore(const std::string& address, const char* lock,
                std::unique_ptr<Connection> connection, StoreOptions options)
      : address_(address),
        queries_([address, lock] { return OpenLocked(address, lock); }, std::move(connection),
                 postgres::Purge(), std::move(options.metrics), *options.clock) {}

  using Store::Update;
  void Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) override {
    Post<std::uint64_t>(
        postgres::ChangeJob(*change, epoch),
        [this, change](const Rows& rows) {
          auto first = postgres::Changed(rows, change->name);
          if (first.ok()) {
            Tell({.name = change->name,
                  .tenant = rows.Bytes(0, 2),
                  .last_sequence = *first + change->events.size() - 1,
                  .state = change->state});
          }
          return first;
        },
        std::move(done),
        {.id = change->id, .patient = change->take && change->state == v1::Job::RUNNING});
  }

  bool Recall(const Encoded& change) override { return queries_.Recall(change->id); }

  void RequestCancel(std::string name, Callback<bool> done) override {
    Statement statement = postgres::RequestCancel(name);
    Post<bool>(
        std::move(statement),
        [this, name = std::move(name)](const Rows& rows) {
          auto asked = postgres::Done(rows, name);
          if (asked.ok()) Tell({.kind = Note::Kind::kCancel, .name = name});
          return asked;
        },
        std::move(done));
  }

  void Remark(JobRemark remark, Callback<JobOwner> done) override {
    Statement statement = postgres::RemarkJob(remark);
    Post<JobOwner>(
        std::move(statement),
        [this, name = std::move(remark.name)](const Rows& rows) {
          auto whose = postgres::Remarked(rows, name);
          if (whose.ok()) {
            Tell({.name = name,
                  .tenant = whose->tenant,
                  .state = static_cast<int>(rows.Integer(0, 4))});
          }
          return whose;
        },
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
    Post<JobOwner>(std::move(statement),
                   [this, name = std::move(name)](const Rows& rows) {
                     auto whose = postgres::Removed(rows, name);
                     if (whose.ok())
                       Tell({.name = name, .tenant = whose->tenant, .state = v1::Job::SUCCEEDED});
                     return whose;
                   },
                   std::move(done), {.untidy = true});
  }

  void Compact(std::string name, Callback<JobOwner> done) override {
    Statement statement = postgres::CompactJob(name);
    Post<JobOwner>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::Compacted(rows, name); },
        std::move(done), {.untidy = true});
  }

  void Backup(std::stop_token /*stop*/, Callback<std::unique_ptr<BackupFile>> done) override {
    queries_.Post({.done = [done = std::move(done)](const absl::StatusOr<Rows>& /*told*/) {
      done(absl::FailedPreconditionError(
          "the store is a PostgreSQL database; copy it with pg_dump"));
    }});
  }

  void Flush(std::function<void()> done) override {
    queries_.Post(
        {.done = [done = std::move(done)](const absl::StatusOr<Rows>& /*told*/) { done(); }});
  }

  void Beat(const WorkerProcess& worker, Callback<std::vector<HeldJob>> done) override {
    Post<std::vector<HeldJob>>(postgres::Beat(worker), postgres::HeldJobsOf, std::move(done));
  }

  void Claim(const JobClaim& claim, Callback<std::vector<StoredJob>> done) override {
    Post<std::vector<StoredJob>>(postgres::Claim(claim), postgres::ClaimedOf, std::move(done));
  }

  void Leave(const std::string& worker, Callback<bool> done) override {
    Post<bool>(
        postgres::Leave(worker), [](const Rows&) -> absl::StatusOr<bool> { return true; },
        std::move(done));
  }

  void Lend(const std::string& worker, const std::string& job, const std::vector<Loan>& loans,
            Callback<bool> done) override {
    Post<bool>(
        postgres::Lend(worker, job, loans),
        [this, job](const Rows&) -> absl::StatusOr<bool> {
          Tell({.kind = Note::Kind::kLoans, .name = job});
          return true;
        },
        std::move(done));
  }

  void SettleLoans(const std::string& worker, const std::string& job,
                   const std::vector<std::int64_t>& numbers, bool back,
                   Callback<std::vector<LoanEnd>> done) override {
    Post<std::vector<LoanEnd>>(postgres::SettleLoans(worker, job, numbers, back),
                               postgres::LoanEndsOf, std::move(done));
  }

  void TakeLoan(const std::string& worker, Callback<std::optional<Loan>> done) override {
    Post<std::optional<Loan>>(postgres::TakeLoan(worker), postgres::LoanOf, std::move(done));
  }

  void ReturnLoan(const std::string& worker, const Loan& loan, const LoanCounts& counts,
                  absl::Span<const v1::Event> events, Callback<std::uint64_t> done) override {
    const JobChange change = ToChange({.name = loan.job, .epoch = loan.epoch, .events = events});
    Post<std::uint64_t>(
        postgres::ReturnLoan(worker, loan, counts, change),
        [this, job = loan.job, count = events.size()](const Rows& rows) {
          auto first = postgres::Changed(rows, job);
          if (first.ok()) {
            Tell({.name = job, .tenant = rows.Bytes(0, 2), .last_sequence = *first + count - 1});
          }
          return first;
        },
        std::move(done));
  }

  void RefuseLoan(const std::string& worker, const Loan& loan, Callback<bool> done) override {
    Post<bool>(
        postgres::RefuseLoan(worker, loan),
        [](const Rows&) -> absl::StatusOr<bool> { return true; }, std::move(done));
  }

  void Count(Callback<Demand> done) override {
    Post<Demand>(postgres::Count(), postgres::DemandOf, std::move(done));
  }

  void CountOf(const JobOwner& whose, Callback<OwnerCounts> done) override {
    Post<OwnerCounts>(postgres::CountOf(whose), postgres::OwnerCountsOf, std::move(done));
  }

  void Positions(const std::vector<std::string>& names,
                 Callback<std::vector<LogPosition>> done) override {
    Post<std::vector<LogPosition>>(postgres::FindPositions(names), postgres::PositionsOf,
                                   std::move(done));
  }

  void Moved(std::uint64_t since, Callback<MovedJobs> done) override {
    Post<MovedJobs>(postgres::FindMoved(since), postgres::MovedJobsOf, std::move(done));
  }

  void Keep(const std::string& name, const std::string& value, bool replace,
            Callback<std::string> done) override {
    Post<std::string>(
        postgres::Keep(name, value, replace),
        [](const Rows& rows) -> absl::StatusOr<std::string> { return rows.Bytes(0, 0); },
        std::move(done));
  }

  void Listen(std::function<void(const Note&)> heard, std::function<void()> missed) override {
    auto bulletin =
        std::make_shared<postgres::Bulletin>(address_, std::move(heard), std::move(missed));
    const MutexLock lock(mutex_);
    bulletin_ = std::move(bulletin);
  }

  void Unlisten() override {
    std::shared_ptr<postgres::Bulletin> bulletin;  // Goes after the lock.
    const MutexLock lock(mutex_);
    bulletin.swap(bulletin_);
  }

  void Tell(const Note& note) override {
    std::shared_ptr<postgres::Bulletin> bulletin;
    {
      const MutexLock lock(mutex_);
      bulletin = bulletin_;
    }
    if (bulletin) bulletin->Tell(note);
  }

 private:
  void Insert(JobInsert job, Callback<StoredJob> done) override {
    Statement statement = postgres::CreateJob(job);
    Post<StoredJob>(
        std::move(statement),
        [this, name = std::move(job.name)](const Rows& rows) {
          auto stored = postgres::Created(rows, name);
          if (stored.ok() && stored->created) {
            Tell({.name = name,
                  .tenant = TenantOf(stored->job),
                  .last_sequence = stored->job.last_sequence(),
                  .state = stored->job.state()});
          }
          return stored;
        },
        std::move(done));
  }

  void PostRead(Statement statement, std::string name, Callback<StoredJob> done) {
    Post<StoredJob>(
        std::move(statement),
        [name = std::move(name)](const Rows& rows) { return postgres::JobOf(rows, name); },
        std::move(done));
  }

  using Operation = postgres::QueryThread::Operation;
  // Runs the statement, and gives `done` what `read` makes of its rows once that is committed.
  // `operation`: what else is to be said of it.
  template <class T, class Read>
  void Post(Statement statement, Read read, Callback<T> done, Operation operation = {}) {
    operation.statement = std::move(statement);
    operation.done = [read = std::move(read),
                      done = std::move(done)](const absl::StatusOr<Rows>& rows) {
      if (rows.ok()) {
        done(read(*rows));
      } else {
        done(rows.status());
      }
    };
    queries_.Post(std::move(operation));
  }

  const std::string address_;
  Mutex mutex_;
  // Null unless somebody listens.
  std::shared_ptr<postgres::Bulletin> bulletin_ ABSL_GUARDED_BY(mutex_);
  postgres::QueryThread queries_;  // Last: its callbacks use all of the above.
};

absl::StatusOr<std::unique_ptr<SharedStore>> Open(const std::string& address, const char* lock,
                                                  StoreOptions options) {
  if (absl::Status made = MigratePostgres(address); !made.ok()) return made;
  auto connection = OpenLocked(address, lock);
  if (!connection.ok()) return connection.status();
  return std::make_unique<PostgresStore>(address, lock, *std::move(connection), std::move(options));
}

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

absl::Status MigratePostgres(const std::string& address, const postgres::Grants& grants) {
  const auto connection = Connection::Open(address);
  if (!connection.ok()) return connection.status();
  return postgres::Migrate(**connection, grants);
}

absl::StatusOr<std::unique_ptr<SharedStore>> OpenPostgres(const std::string& address,
                                                          StoreOptions options) {
  return Open(address, postgres::kUseStore, std::move(options));
}

absl::StatusOr<std::unique_ptr<Store>> OpenPostgresAlone(const std::string& address) {
  return Open(address, postgres::kTakeStore, {});
}

}  // namespace contact
