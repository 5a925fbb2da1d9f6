#include "storage/store.h"

#include <optional>
#include <utility>

#include "storage/data_directory.h"
#include "storage/database.h"
#include "storage/job_changes.h"
#include "storage/job_queries.h"
#include "storage/purge.h"

namespace contact {
namespace {

absl::StatusOr<bool> Done(const absl::Status& status) {
  if (!status.ok()) return status;
  return true;
}

}  // namespace

absl::StatusOr<std::unique_ptr<Store>> Store::Open(const std::filesystem::path& directory,
                                                   StoreOptions options) {
  absl::StatusOr<DataDirectory> locked = DataDirectory::Open(directory);
  if (!locked.ok()) return locked.status();
  auto database = Database::Open(*std::move(locked), options.max_bytes, options.reserve_bytes);
  if (!database.ok()) return database.status();
  return std::unique_ptr<Store>(new Store(*std::move(database), std::move(options)));
}

Store::Store(std::unique_ptr<Database> database, StoreOptions options)
    : thread_(std::move(database), Purge, std::move(options.on_failure), std::move(options.metrics),
              *options.clock) {}

Store::~Store() = default;

template <class T, class Run>
void Store::Post(Run run, Callback<T> done, bool frees) {
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

void Store::Create(const NewJob& job, Callback<StoredJob> done) {
  JobInsert insert{.name = job.job.name(),
                   .request_id = job.request_id,
                   .whose = {OwnerOf(job.job), TenantOf(job.job)},
                   .state = job.job.state(),
                   .labels = {},
                   .parts = Split(job.job),
                   .events = ToRows(job.events),
                   .may_create = job.may_create,
                   .max_owner_bytes = job.max_owner_bytes};
  insert.labels.assign(job.job.labels().begin(), job.job.labels().end());
  Post([insert = std::move(insert)](Database& database) { return Insert(database, insert); },
       std::move(done));
}

Store::Encoded Store::Encode(const JobUpdate& update) {
  JobChange change{update.name, update.take, 0, {}, ToRows(update.events), {}};
  if (update.checkpoint != nullptr) change.checkpoint = *update.checkpoint;
  if (update.job != nullptr) {
    change.state = update.job->state();
    change.parts = Split(*update.job);
  }
  return std::make_shared<const JobChange>(std::move(change));
}

void Store::Update(const JobUpdate& update, Callback<std::uint64_t> done) {
  Update(Encode(update), update.epoch, std::move(done));
}

void Store::Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) {
  Post([change = std::move(change),
        epoch](Database& database) { return Change(database, *change, epoch); },
       std::move(done));
}

void Store::RequestCancel(std::string name, Callback<bool> done) {
  Post([name = std::move(name)](
           Database& database) { return Done(MarkCancelRequested(database, name)); },
       std::move(done));
}

void Store::Read(std::string name, JobPart part, Callback<StoredJob> done) {
  Post([name = std::move(name),
        part](Database& database) { return contact::Read(database, name, part); },
       std::move(done));
}

void Store::ReadOf(std::string tenant, std::string name, JobPart part, Callback<StoredJob> done) {
  Post([tenant = std::move(tenant), name = std::move(name),
        part](Database& database) { return contact::ReadOf(database, tenant, name, part); },
       std::move(done));
}

void Store::Owner(std::string tenant, std::string name, Callback<JobOwner> done) {
  Post([tenant = std::move(tenant),
        name = std::move(name)](Database& database) { return FindOwner(database, tenant, name); },
       std::move(done));
}

void Store::OwnerBytes(JobOwner whose, Callback<std::int64_t> done) {
  Post(
      [whose = std::move(whose)](Database& database) -> absl::StatusOr<std::int64_t> {
        return contact::OwnerBytes(database, whose);
      },
      std::move(done));
}

void Store::List(JobQuery query, Callback<JobPage> done) {
  Post([query = std::move(query)](Database& database) { return contact::List(database, query); },
       std::move(done));
}

void Store::ListUnfinished(Callback<std::vector<StoredJob>> done) {
  Post([](Database& database) { return contact::ListUnfinished(database); }, std::move(done));
}

void Store::Sizes(Callback<std::vector<JobSize>> done) {
  Post([](Database& database) { return contact::Sizes(database); }, std::move(done));
}

void Store::ReadEvents(EventQuery query, Callback<EventPage> done) {
  Post([query =
            std::move(query)](Database& database) { return contact::ReadEvents(database, query); },
       std::move(done));
}

void Store::Delete(std::string name, std::string expected_uid, Callback<JobOwner> done) {
  Post([name = std::move(name),
        uid = std::move(expected_uid)](Database& database) { return Remove(database, name, uid); },
       std::move(done), true);
}

void Store::Compact(std::string name, Callback<JobOwner> done) {
  Post([name = std::move(name)](Database& database) { return contact::Compact(database, name); },
       std::move(done), true);
}

void Store::Backup(std::stop_token stop, Callback<std::unique_ptr<BackupFile>> done) {
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

void Store::Flush(std::function<void()> done) {
  thread_.Post(CommitThread::Operation{[](Database&) {},
                                       [done = std::move(done)](const absl::Status&) { done(); }});
}

}  // namespace contact
