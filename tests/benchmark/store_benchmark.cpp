// What the engines of the store do a second, beside libpq that sends the same statements without a
// store. With fsync, as in use:
//   python3 tests/testing/postgres.py start build/release/postgres.txt fsync=on
//   build/release/tests/benchmark/store_benchmark --benchmark_repetitions=5
//       --benchmark_enable_random_interleaving=true
//   python3 tests/testing/postgres.py stop build/release/postgres.txt
#include <benchmark/benchmark.h>
#include <libpq-fe.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/future.h"
#include "base/ids.h"
#include "storage/postgres/postgres_store.h"
#include "storage/postgres/statements.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/postgres_database.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

constexpr int kAtOnce = 64;
constexpr int kEvents = 16;  // Of an update.

v1::Job NextJob() {
  v1::Job job;
  job.set_name("jobs/" + RandomIds().NextId());
  job.set_uid(RandomIds().NextUuid());
  job.set_state(v1::Job::QUEUED);
  job.mutable_scenario()->set_title(std::string(500, 'x'));
  return job;
}

std::vector<v1::Event> Log(std::size_t bytes) {
  std::vector<v1::Event> events(kEvents);
  for (v1::Event& event : events) event.mutable_log_entry()->set_message(std::string(bytes, 'x'));
  return events;
}

// A store of its own for one benchmark.
struct Fixture {
  explicit Fixture(bool use_postgres) {
    if (use_postgres) database.emplace();
    auto opened = database ? OpenPostgres(database->address()) : OpenSqlite(folder.path() / "data");
    if (!opened.ok()) std::abort();
    store = *std::move(opened);
  }
  void Flush() const {
    Await<bool>([this](const auto& done) { store->Flush([done] { done(true); }); });
  }
  ~Fixture() { store.reset(); }

  TempDirectory folder;
  std::optional<PostgresDatabase> database;
  std::unique_ptr<Store> store;
};

void Create(benchmark::State& state, bool use_postgres) {
  const Fixture fixture(use_postgres);
  const std::vector<v1::Event> events(1);
  while (state.KeepRunning()) {
    for (int i = 0; i < kAtOnce; ++i) {
      fixture.store->Create({NextJob(), "", events}, [](const auto& stored) {
        if (!stored.ok()) std::abort();
      });
    }
    fixture.Flush();
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce);
}

void Append(benchmark::State& state, bool use_postgres) {
  const Fixture fixture(use_postgres);
  const v1::Job job = NextJob();
  fixture.store->Create({job, "", {}}, [](const auto&) {});
  const std::vector<v1::Event> events = Log(200);
  while (state.KeepRunning()) {
    for (int i = 0; i < kAtOnce; ++i) {
      fixture.store->Update({.name = job.name(), .events = events}, [](const auto& first) {
        if (!first.ok()) std::abort();
      });
    }
    fixture.Flush();
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce * kEvents);
}

// libpq alone, sending what the store would.
class Raw {
 public:
  explicit Raw(const std::string& address) : connection_(PQconnectdb(address.c_str())) {
    PQclear(PQexec(connection_, "SET synchronous_commit = on"));
    PQclear(PQexec(connection_, "SET plan_cache_mode = force_generic_plan"));
  }
  ~Raw() { PQfinish(connection_); }
  Raw(const Raw&) = delete;
  Raw& operator=(const Raw&) = delete;

  void Prepare(const std::string& sql) {
    PQclear(PQprepare(connection_, "raw", sql.c_str(), 0, nullptr));
  }
  void Run(const std::vector<postgres::Statement>& statements) {
    PQenterPipelineMode(connection_);
    for (const postgres::Statement& statement : statements) {
      const postgres::Parameters& parameters = statement.parameters;
      const std::vector<int> formats(static_cast<std::size_t>(parameters.size()), 1);
      PQsendQueryPrepared(connection_, "raw", parameters.size(), parameters.values().data(),
                          parameters.lengths().data(), formats.data(), 1);
    }
    PQpipelineSync(connection_);
    for (std::size_t i = 0; i < statements.size(); ++i) {
      PGresult* result = PQgetResult(connection_);
      if (PQresultStatus(result) != PGRES_TUPLES_OK) std::abort();
      PQclear(result);
      PQgetResult(connection_);
    }
    PQclear(PQgetResult(connection_));
    PQexitPipelineMode(connection_);
  }

 private:
  PGconn* connection_;
};

void CreateRaw(benchmark::State& state) {
  const Fixture fixture(true);
  Raw raw(fixture.database->address());
  const std::vector<v1::Event> events(1);
  raw.Prepare(postgres::CreateJob(ToInsert({NextJob(), "", events})).sql);
  while (state.KeepRunning()) {
    std::vector<postgres::Statement> statements;
    for (int i = 0; i < kAtOnce; ++i) {
      statements.push_back(postgres::CreateJob(ToInsert({NextJob(), "", events})));
    }
    raw.Run(statements);
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce);
}

void AppendRaw(benchmark::State& state) {
  const Fixture fixture(true);
  const v1::Job job = NextJob();
  fixture.store->Create({job, "", {}}, [](const auto&) {});
  fixture.Flush();
  Raw raw(fixture.database->address());
  const std::vector<v1::Event> events = Log(200);
  raw.Prepare(postgres::ChangeJob({}, 0).sql);
  while (state.KeepRunning()) {
    std::vector<postgres::Statement> statements;
    for (int i = 0; i < kAtOnce; ++i) {
      statements.push_back(
          postgres::ChangeJob(ToChange({.name = job.name(), .events = events}), 0));
    }
    raw.Run(statements);
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce * kEvents);
}

BENCHMARK_CAPTURE(Create, sqlite, false)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Create, postgres, true)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(CreateRaw)->Name("Create/libpq")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Append, sqlite, false)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Append, postgres, true)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(AppendRaw)->Name("Append/libpq")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact

BENCHMARK_MAIN();
