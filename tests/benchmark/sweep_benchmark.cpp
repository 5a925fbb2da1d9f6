// Cells of a sweep a second, beside the solver called in a bare loop on as many threads.
#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <future>
#include <memory>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/ids.h"
#include "jobs/job_manager.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/await.h"
#include "testing/cases.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

constexpr int kCells = 10'000;

double RestitutionOf(int cell) { return 0.5 + 0.4 * cell / (kCells - 1); }

void BareLoop(benchmark::State& state) {
  while (state.KeepRunning()) {
    std::atomic<int> next = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < state.range(0); ++i) {
      threads.emplace_back([&next] {
        Scenario scenario = testing::TripleChain();
        for (int cell = next++; cell < kCells; cell = next++) {
          for (Contact& contact : scenario.contacts) contact.restitution = RestitutionOf(cell);
          Observer nobody;
          benchmark::DoNotOptimize(Run(scenario, nobody));
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  state.SetItemsProcessed(state.iterations() * kCells);
}

v1::CreateJobRequest Study() {
  v1::CreateJobRequest request;
  v1::Sweep& sweep = *request.mutable_job()->mutable_sweep();
  v1::Scenario& base = *sweep.mutable_base();
  for (int i = 0; i < 3; ++i) {
    v1::Body& body = *base.add_bodies();
    body.set_name(std::string("B").append(std::to_string(i + 1)));
    body.set_mass_kg(0.5);
    body.set_radius_m(0.05);
    body.set_position_m(0.1 * i);
  }
  base.mutable_bodies(0)->set_velocity_m_per_s(0.2);
  v1::Contact& contact = *base.add_contacts();
  for (const v1::Body& body : base.bodies()) contact.add_between(body.name());
  contact.set_stiffness(1e8);
  base.set_end_time_s(4e-3);
  v1::Sweep::Axis& axis = *sweep.add_axes();
  axis.set_field("contacts[0].restitution");
  axis.mutable_linear()->set_low(RestitutionOf(0));
  axis.mutable_linear()->set_high(RestitutionOf(kCells - 1));
  axis.mutable_linear()->set_count(kCells);
  sweep.add_metrics("iterations");
  sweep.add_metrics("final_bodies[B3].velocity_m_per_s");
  return request;
}

// Waits for the end of a job as a client does, that is without asking again and again.
void AwaitEnd(JobManager& jobs, const std::string& name) {
  const auto woken = std::make_shared<std::counting_semaphore<>>(0);
  v1::WatchJobRequest request;
  request.set_name(name);
  request.add_kinds("state_changed");
  Await<Result<WatchedJob>> opened;
  jobs.watches().WatchJob(
      LocalPrincipal(), request, [woken] { woken->release(); }, opened.callback());
  const Result<WatchedJob> watched = opened.Get();
  for (;;) {
    std::vector<LogRecord> records;
    const LogCursor::Next next = watched.value().cursor->Read(1 << 16, &records);
    if (next == LogCursor::Next::kEnd) return;
    if (next == LogCursor::Next::kWait) woken->acquire();
  }
}

// Until every cell is on disk.
void SweepJob(benchmark::State& state) {
  spdlog::set_level(spdlog::level::warn);
  const TempDirectory folder;
  const auto store = *OpenSqlite(folder.path());
  JobManager jobs(*store, SystemClock(), RandomIds(),
                  {.workers = static_cast<int>(state.range(0))});
  while (state.KeepRunning()) {
    Await<Result<v1::Job>> created;
    jobs.creator().Create(LocalPrincipal(), Study(), created.callback());
    AwaitEnd(jobs, created.Get().value().name());
  }
  jobs.Stop();
  state.SetItemsProcessed(state.iterations() * kCells);
}

BENCHMARK(BareLoop)->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(SweepJob)->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace contact

BENCHMARK_MAIN();
