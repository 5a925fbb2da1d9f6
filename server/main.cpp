// contactd: wires store, jobs and gRPC together and ends them in order.

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>
#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <systemd/sd-daemon.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "base/future.h"
#include "base/ids.h"
#include "base/memory_limit.h"
#include "base/replace_file.h"
#include "base/spelling.h"
#include "jobs/cluster/shared_jobs.h"
#include "jobs/job_manager.h"
#include "listeners.h"
#include "log.h"
#include "read_config.h"
#include "rpc/grpc_log.h"
#include "rpc/metrics/metrics_server.h"
#include "run_launcher.h"
#include "self_probe.h"
#include "storage/postgres/postgres_store.h"
#include "storage/sqlite/fsck.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/store_copy.h"
#include "stored_audit_head.h"
#include "version.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// Time that open calls get to end. The whole shutdown must take less than 5 s.
constexpr auto kGrace = 2s;

// Space on the disk for deleting jobs when there is none.
constexpr std::int64_t kReserve = 16 << 20;

// Blocks the signals that WaitFor waits for. Must be called before the first thread starts, because
// threads inherit the mask.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

// Lets glibc keep freed buffers of up to 8 MiB. By default it returns buffers of a megabyte, such
// as those of frames and messages, to the system at once and faults them in again page by page.
void KeepBuffers() {
  constexpr int kMostKept = 8 << 20;  // Free bytes, of an arena.
  mallopt(M_TRIM_THRESHOLD, kMostKept);
  mallopt(M_MMAP_THRESHOLD, kMostKept);
}

// Waits for one of the signals. Tells systemd in the meantime that the server answers, three times
// in each span after which systemd would take it for dead (WatchdogSec).
int WaitFor(const sigset_t& signals, const SelfProbe& probe) {
  std::uint64_t span = 0;
  const bool watched = sd_watchdog_enabled(0, &span) > 0;
  const std::chrono::microseconds interval(span / 3);
  const auto time = std::chrono::duration_cast<std::chrono::nanoseconds>(interval);
  const timespec timeout{.tv_sec = time / 1s, .tv_nsec = (time % 1s).count()};
  for (;;) {
    const int signal =
        watched ? sigtimedwait(&signals, nullptr, &timeout) : sigwaitinfo(&signals, nullptr);
    if (signal > 0) return signal;
    if (errno != EAGAIN) continue;
    if (probe.Answers(interval)) {
      sd_notify(0, "WATCHDOG=1");
    } else {
      spdlog::error("the server does not answer its own health check");
    }
  }
}

// Waits until a worker is to end. Returns why.
const char* AwaitEnd(const Config& config, const sigset_t& signals) {
  const auto time = std::chrono::duration_cast<std::chrono::nanoseconds>(config.stop_after);
  const timespec timeout{.tv_sec = time / 1s, .tv_nsec = (time % 1s).count()};
  for (;;) {
    const int signal =
        time > 0s ? sigtimedwait(&signals, nullptr, &timeout) : sigwaitinfo(&signals, nullptr);
    if (signal > 0) return strsignal(signal);
    if (errno == EAGAIN) return "the time of --stop-after is over";
  }
}

// Ends the process: after a failed write the store can no longer acknowledge anything.
void EndAfterDiskFailure(const absl::Status& status) {
  spdlog::critical("the store failed: {}", std::string(status.message()));
  std::_Exit(kExitInternal);
}

v1::ServerInfo Identity(const Config& config) {
  v1::ServerInfo identity;
  identity.set_version(kVersion);
  identity.set_revision(kRevision);
  identity.set_instance_id(RandomIds().NextId());
  *identity.mutable_start_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  identity.mutable_limits()->set_max_stored_bytes(config.store.max_bytes);
  return identity;
}

// Writes to the log what runs may take of the memory that there is for this process.
void TellMemory(const Config& config) {
  constexpr double kMiB = 1 << 20;
  const auto each = static_cast<double>(config.jobs.max_budget.memory_bytes);
  const auto limit = static_cast<double>(MemoryLimit());
  const std::string most = each == 0 ? "any memory" : fmt::format("{:.0f} MiB", each / kMiB);
  const std::string words =
      fmt::format("{} with {} each for a run, of {:.0f} MiB",
                  Count(config.jobs.workers, "worker", "workers"), most, limit / kMiB);
  if (each == 0 || each * config.jobs.workers > 0.75 * limit) {
    spdlog::warn("{}: more than there is; --max-memory and --workers bound it", words);
  } else {
    spdlog::info("{}", words);
  }
}

// Serves those who connect. Tells where --http-listen is, if it is given. False: its port cannot be
// written down.
bool ServeCallers(const Config& config, MetricsSources sources, Listeners& listeners) {
  const auto page = std::make_shared<MetricsPage>(std::move(sources));
  listeners.Serve([page] { return page->Text(); });
  if (config.http_listen.empty()) return true;
  const std::string port = std::to_string(listeners.http_port());
  if (!config.http_port_file.empty() && ReplaceFile(config.http_port_file, port + "\n")) {
    fmt::print(stderr, "contactd: cannot write --http-port-file {}\n",
               config.http_port_file.string());
    return false;
  }
  const bool file = config.http_listen.starts_with("unix:");
  spdlog::info("HTTP on {}", file ? config.http_listen : "port " + port);
  return true;
}

// What holds jobs and results, for people.
std::string StoreName(const Config& config) {
  return config.store_address.empty() ? config.data_dir.string()
                                      : PostgresName(config.store_address);
}

bool Announce(const Config& config, int port) {
  if (!config.port_file.empty() && ReplaceFile(config.port_file, fmt::format("{}\n", port))) {
    fmt::print(stderr, "contactd: cannot write --port-file {}\n", config.port_file.string());
    return false;
  }
  const std::string host = config.listen.substr(0, config.listen.rfind(':'));
  const std::string address = port == 0 ? config.listen : fmt::format("{}:{}", host, port);
  Greet(config.log_format, fmt::format("contactd {} listening on {}, data in {}", kVersion, address,
                                       StoreName(config)));
  sd_notify(0, "READY=1");
  return true;
}

// Prints why the data directory cannot be used. Returns the exit code.
int Refuse(const absl::Status& status) {
  fmt::print(stderr, "contactd: {}\n", std::string(status.message()));
  return absl::IsUnavailable(status) ? kExitHeld : kExitUsage;
}

// The disk of the directory as df tells it; nothing known if it cannot be asked.
DiskSpace SpaceOf(const std::filesystem::path& directory) {
  std::error_code error;
  const auto space = std::filesystem::space(directory, error);
  if (error) return {};
  const std::uintmax_t used = space.capacity - space.free;
  return {static_cast<std::int64_t>(used + space.available),
          static_cast<std::int64_t>(space.available)};
}

// What the file holds, which is made if it is not there. Without it the tokens of pages are good
// for as long as this process lives.
std::string KeepSecret(const std::filesystem::path& file, const std::string& made) {
  std::string kept;
  if (std::ifstream(file) >> kept) return kept;
  if (const std::error_code error = ReplaceFile(file, made + "\n", 0600)) {
    spdlog::warn("cannot write {}: {}", file.string(), error.message());
  }
  return made;
}

// As above, for all processes of a database.
std::string KeepSecret(SharedStore& store, const std::string& made) {
  const auto kept = Await<absl::StatusOr<std::string>>(
      [&](auto done) { store.Keep("page-secret", made, false, std::move(done)); });
  if (!kept.ok()) spdlog::warn("page tokens are of this process: {}", kept.status().ToString());
  return kept.value_or(made);
}

// A store with what runs its jobs.
struct Served {
  std::unique_ptr<Store> store;
  std::unique_ptr<JobManager> jobs;
  /// See AuditPlace.
  std::function<std::unique_ptr<AuditHead>()> open_head;
};

// A directory that this process has alone, or a database that it shares with others.
absl::StatusOr<Served> OpenServed(const Config& config, StoreOptions options) {
  Served served;
  JobOptions jobs = config.jobs;
  if (!config.store_address.empty()) {
    auto shared = OpenPostgres(config.store_address, std::move(options));
    if (!shared.ok()) return shared.status();
    jobs.page_secret = KeepSecret(**shared, jobs.page_secret);
    served.jobs = std::make_unique<JobManager>(**shared, SystemClock(), RandomIds(),
                                               std::move(jobs), config.shared);
    served.open_head = [&store = **shared, file = config.audit_log.file] {
      return OpenStoredHead(store, file);
    };
    served.store = *std::move(shared);
    return served;
  }
  auto store = OpenSqlite(config.data_dir, std::move(options));
  if (!store.ok()) return store.status();
  served.store = *std::move(store);
  jobs.disk = [directory = config.data_dir] { return SpaceOf(directory); };
  jobs.retention.clock_file = config.data_dir / "clock";
  jobs.page_secret = KeepSecret(config.data_dir / "page-secret", jobs.page_secret);
  served.jobs =
      std::make_unique<JobManager>(*served.store, SystemClock(), RandomIds(), std::move(jobs));
  return served;
}

absl::StatusOr<std::unique_ptr<Store>> OpenAlone(const std::string& place) {
  if (IsPostgresAddress(place)) return OpenPostgresAlone(place);
  return OpenSqlite(place, {.reserve_bytes = kReserve});
}

int CopyStores(const Config& config) {
  const auto from = OpenAlone(config.copy_from);
  if (!from.ok()) return Refuse(from.status());
  const auto to = OpenAlone(config.copy_to);
  if (!to.ok()) return Refuse(to.status());
  const auto report = CopyStore(**from, **to);
  if (!report.ok()) return Refuse(report.status());
  fmt::print("copied {}, {}\n", Count(report->jobs, "job", "jobs"),
             Count(report->events, "event", "events"));
  return kExitOk;
}

int MigrateStore(const Config& config) {
  const absl::Status status = MigratePostgres(config.store_address, config.grants);
  if (!status.ok()) return Refuse(status);
  fmt::print("{} is up to date\n", StoreName(config));
  return kExitOk;
}

int CheckData(const std::filesystem::path& directory) {
  const auto report =
      Fsck(directory, [](const std::string& finding) { fmt::print("{}\n", finding); });
  if (!report.ok()) return Refuse(report.status());
  fmt::print("{}: {}, {}, {}\n", directory.string(), Count(report->jobs, "job", "jobs"),
             Count(report->events, "event", "events"),
             Count(report->findings, "finding", "findings"));
  return report->findings == 0 ? kExitOk : kExitDamaged;
}

// Size of the database with its write-ahead log; a file that cannot be read counts 0.
std::int64_t StoredBytes(const std::filesystem::path& data_dir) {
  std::int64_t bytes = 0;
  for (const char* file : {"contactd.db", "contactd.db-wal"}) {
    std::error_code error;
    const auto size = std::filesystem::file_size(data_dir / file, error);
    if (!error) bytes += static_cast<std::int64_t>(size);
  }
  return bytes;
}

MetricsSources Sources(const Config& config, const StoreOptions& store, const JobManager& jobs,
                       const Listeners& listeners) {
  const auto take = [&config, &jobs, &listeners] {
    const v1::ServerInfo info = jobs.Info();
    MetricsSources::Now now{.workers = info.workers(),
                            .queued_jobs = info.queued_jobs(),
                            .running_jobs = info.running_jobs(),
                            .stored_bytes = {}};
    if (config.store_address.empty()) now.stored_bytes = StoredBytes(config.data_dir);
    listeners.AddTo(&now);
    return now;
  };
  return {take, config.jobs.metrics, store.metrics, listeners.metrics(),
          listeners.stream_metrics()};
}

// Serves the metrics if --metrics-listen is given. False: the address cannot be had.
bool ServeMetrics(const Config& config, MetricsSources sources,
                  std::unique_ptr<MetricsServer>* metrics) {
  if (config.metrics_listen.empty()) return true;
  *metrics = MetricsServer::Open(config.metrics_listen, std::move(sources));
  if (!*metrics) {
    fmt::print(stderr, "contactd: cannot listen on {} for metrics; does another process?\n",
               config.metrics_listen);
    return false;
  }
  spdlog::info("metrics on port {}", (*metrics)->port());
  return true;
}

// Runs jobs of a shared store until a signal comes or it is time to leave, then hands back what it
// has. Returns the exit code.
int Work(const Config& config, const sigset_t& signals) {
  StoreOptions options = config.store;
  options.on_failure = EndAfterDiskFailure;
  const auto store = OpenPostgres(config.store_address, options);
  if (!store.ok()) return Refuse(store.status());
  TellMemory(config);
  JobFeed feed;
  SharedJobs jobs(**store, SystemClock(), config.jobs, config.shared, feed);
  const auto take = [&jobs] {
    const Demand demand = jobs.demand();
    return MetricsSources::Now{.workers = static_cast<int>(demand.threads),
                               .queued_jobs = static_cast<int>(demand.queued),
                               .running_jobs = static_cast<int>(demand.running),
                               .stored_bytes = {}};
  };
  std::unique_ptr<MetricsServer> metrics;
  if (!ServeMetrics(config,
                    {take, config.jobs.metrics, options.metrics, std::make_shared<RpcMetrics>(),
                     std::make_shared<StreamMetrics>()},
                    &metrics)) {
    return kExitHeld;
  }
  Greet(config.log_format,
        fmt::format("contactd {} works with {} for {}", kVersion,
                    Count(config.jobs.workers, "thread", "threads"), StoreName(config)));
  sd_notify(0, "READY=1");
  spdlog::info("{}: handing the jobs back", AwaitEnd(config, signals));
  sd_notify(0, "STOPPING=1");
  metrics.reset();
  jobs.Stop();
  return kExitOk;
}

// Serves until a signal comes, then shuts down. Returns the exit code.
int Serve(Config config, const sigset_t& signals) {
  StoreOptions options = config.store;
  options.on_failure = EndAfterDiskFailure;
  options.reserve_bytes = kReserve;
  const auto served = OpenServed(config, options);
  if (!served.ok()) return Refuse(served.status());
  config.audit_log.open_head = served->open_head;
  if (config.role != ProcessRole::kFront) TellMemory(config);
  JobManager& jobs = *served->jobs;
  Listeners listeners(jobs, *served->store, config, Identity(config));
  std::unique_ptr<MetricsServer> metrics;
  int code = kExitHeld;
  if (const std::string wrong = listeners.Prepare(); !wrong.empty()) {
    fmt::print(stderr, "contactd: {}\n", wrong);
    code = kExitUsage;
  } else if (const std::string taken = listeners.Start(); !taken.empty()) {
    fmt::print(stderr, "contactd: cannot listen on {}; does another process?\n", taken);
  } else if (!ServeMetrics(config, Sources(config, options, jobs, listeners), &metrics)) {
    code = kExitHeld;
  } else if (!ServeCallers(config, Sources(config, options, jobs, listeners), listeners) ||
             !Announce(config, listeners.port())) {
    code = kExitUsage;
  } else {
    spdlog::info("{}: shutting down", strsignal(WaitFor(signals, listeners.Probe())));
    sd_notify(0, "STOPPING=1");
    code = kExitOk;
  }
  metrics.reset();
  jobs.creator().Drain();
  listeners.Shutdown(kGrace);  // From here on no call asks anything of the manager.
  jobs.Stop();
  return code;
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  const sigset_t signals = contact::BlockSignals();
  contact::KeepBuffers();
  umask(077);  // What the server writes is its user's alone.
  const auto read = contact::ReadConfig(argc, argv);
  if (const auto* exit = std::get_if<contact::Exit>(&read)) {
    std::fputs(exit->text.c_str(), exit->code == contact::kExitOk ? stdout : stderr);
    return exit->code;
  }
  const auto& config = std::get<contact::Config>(read);
  if (config.fsck) return contact::CheckData(config.data_dir);
  if (config.copy_store) return contact::CopyStores(config);
  if (config.migrate) return contact::MigrateStore(config);
  contact::SetUpLog(config.log_level, config.log_format);
  if (config.role == contact::ProcessRole::kLauncher) return contact::RunLauncher(config, signals);
  contact::RouteGrpcLog();
  if (config.role == contact::ProcessRole::kWorker) return contact::Work(config, signals);
  return contact::Serve(config, signals);
}
