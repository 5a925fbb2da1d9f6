#include "storage/sqlite/sqlite_store.h"

#include <optional>
#include <utility>

#include "storage/sqlite/backup.h"
#include "storage/sqlite/commit_thread.h"
#include "storage/sqlite/data_directory.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite/job_changes.h"
#include "storage/sqlite/job_queries.h"
#include "storage/sqlite/purge.h"

namespace contact {
namespace {

absl::StatusOr<bool> Done(const absl::Status& status) {
  if (!status.ok()) return status;
  return true;
}

// Reads unless nobody waits for the page any more.
template <class Page, class Query, class Read>
absl::StatusOr<Page> ReadIfWanted(Database& database, const Query& query, Read read) {
  if (query.abandoned && query.abandoned()) return absl::CancelledError("nobody waits for it");
  return read(database, query);
}

// The calls of Store, each an operation of the one thread.
class SqliteStore : public Store {
 public:
  SqliteStore(std::unique_ptr<Database> database, StoreOptions options)
      : thread_(std::move(database), Purge, std::move(options.on_failure),
                std::move(options.metrics), *options.clock) {}

  using Store::Update;
  void Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) override;
  void RequestCancel(std::string name, Callback<bool> done) override;
  void Remark(JobRemark remark, Callback<JobOwner> done) override;
  void Read(std::string name, JobPart part, Callback<StoredJob> done) override;
  void ReadOf(std::string tenant, std::string name, JobPart part,
              Callback<StoredJob> done) override;
  void Owner(std::string tenant, std::string name, Callback<JobOwner> done) override;
  void OwnerBytes(JobOwner whose, Callback<std::int64_t> done) override;
  void List(JobQuery query, Callback<JobPage> done) override;
  void ListUnfinished(Callback<std::vector<StoredJob>> done) override;
  void Sizes(Callback<std::vector<JobSize>> done) override;
  void ReadEvents(EventQuery query, Callback<EventPage> done) override;
  void Delete(std::string name, std::string expected_uid, Callback<JobOwner> done) override;
  void Compact(std::string name, Callback<JobOwner> done) override;
  void Backup(std::stop_token stop, Callback<std::unique_ptr<BackupFile>> done) override;
  void Flush(std::function<void()> done) override;

 private:
  void Insert(JobInsert job, Callback<StoredJob> done) override;

  // Runs `run` in a transaction, and gives `done` what it returned once that is committed.
  template <class T, class Run>
  void Post(Run run, Callback<T> done, bool frees = false);

  CommitThread thread_;
};

template <class T, class Run>
void SqliteStore::Post(Run run, Callback<T> done, bool frees) {
  const auto result = std::make_shared<std::optional<absl::StatusOr<T>>>();
  thread_.Post(CommitThread::Operation{
      [run = std::move(run), result](Database& database) { *result = run(database); },
      [done = std::move(done), result](const absl::Status& committed) {
        if (committed.ok()) {
          done(*std::move(*result));
        } else {
          done(committed);
        }
      },
      frees});
}

void SqliteStore::Insert(JobInsert job, Callback<StoredJob> done) {
  Post([job = std::move(job)](Database& database) { return contact::Insert(database, job); },
       std::move(done));
}

void SqliteStore::Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) {
  Post([change = std::move(change),
        epoch](Database& database) { return Change(database, *change, epoch); },
       std::move(done));
}

void SqliteStore::RequestCancel(std::string name, Callback<bool> done) {
  Post([name = std::move(name)](
           Database& database) { return Done(MarkCancelRequested(database, name)); },
       std::move(done));
}

void SqliteStore::Remark(JobRemark remark, Callback<JobOwner> done) {
  Post([remark =
            std::move(remark)](Database& database) { return contact::Remark(database, remark); },
       std::move(done));
}

void SqliteStore::Read(std::string name, JobPart part, Callback<StoredJob> done) {
  Post([name = std::move(name),
        part](Database& database) { return contact::Read(database, name, part); },
       std::move(done));
}

void SqliteStore::ReadOf(std::string tenant, std::string name, JobPart part,
                         Callback<StoredJob> done) {
  Post([tenant = std::move(tenant), name = std::move(name),
        part](Database& database) { return contact::ReadOf(database, tenant, name, part); },
       std::move(done));
}

void SqliteStore::Owner(std::string tenant, std::string name, Callback<JobOwner> done) {
  Post([tenant = std::move(tenant),
        name = std::move(name)](Database& database) { return FindOwner(database, tenant, name); },
       std::move(done));
}

void SqliteStore::OwnerBytes(JobOwner whose, Callback<std::int64_t> done) {
  Post(
      [whose = std::move(whose)](Database& database) -> absl::StatusOr<std::int64_t> {
        return contact::OwnerBytes(database, whose);
      },
      std::move(done));
}

void SqliteStore::List(JobQuery query, Callback<JobPage> done) {
  Post([query = std::move(query)](
           Database& database) { return ReadIfWanted<JobPage>(database, query, contact::List); },
       std::move(done));
}

void SqliteStore::ListUnfinished(Callback<std::vector<StoredJob>> done) {
  Post([](Database& database) { return contact::ListUnfinished(database); }, std::move(done));
}

void SqliteStore::Sizes(Callback<std::vector<JobSize>> done) {
  Post([](Database& database) { return contact::Sizes(database); }, std::move(done));
}

void SqliteStore::ReadEvents(EventQuery query, Callback<EventPage> done) {
  Post(
      [query = std::move(query)](Database& database) {
        return ReadIfWanted<EventPage>(database, query, contact::ReadEvents);
      },
      std::move(done));
}

void SqliteStore::Delete(std::string name, std::string expected_uid, Callback<JobOwner> done) {
  Post([name = std::move(name),
        uid = std::move(expected_uid)](Database& database) { return Remove(database, name, uid); },
       std::move(done), true);
}

void SqliteStore::Compact(std::string name, Callback<JobOwner> done) {
  Post([name = std::move(name)](Database& database) { return contact::Compact(database, name); },
       std::move(done), true);
}

void SqliteStore::Backup(std::stop_token stop, Callback<std::unique_ptr<BackupFile>> done) {
  const auto backup = std::make_shared<contact::Backup>(std::move(stop));
  // Behind the operations that were posted before.
  Flush([this, backup, done = std::move(done)] {
    thread_.Post(CommitThread::Task{[backup](Database& database) { return backup->Step(database); },
                                    [backup, done](const absl::Status& status) {
                                      if (status.ok()) {
                                        done(backup->Take());
                                      } else {
                                        done(status);
                                      }
                                    }});
  });
}

void SqliteStore::Flush(std::function<void()> done) {
  thread_.Post(CommitThread::Operation{[](Database&) {},
                                       [done = std::move(done)](const absl::Status&) { done(); }});
}

}  // namespace

absl::StatusOr<std::unique_ptr<Store>> OpenSqlite(const std::filesystem::path& directory,
                                                  StoreOptions options) {
  absl::StatusOr<DataDirectory> locked = DataDirectory::Open(directory);
  if (!locked.ok()) return locked.status();
  auto database = Database::Open(*std::move(locked), options.max_bytes, options.reserve_bytes);
  if (!database.ok()) return database.status();
  return std::make_unique<SqliteStore>(*std::move(database), std::move(options));
}

}  // namespace contact
