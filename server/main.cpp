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
#include <memory>
#include <string>
#include <system_error>

#include "base/clock.h"
#include "base/ids.h"
#include "base/replace_file.h"
#include "base/spelling.h"
#include "jobs/job_manager.h"
#include "listeners.h"
#include "log.h"
#include "read_config.h"
#include "rpc/grpc_log.h"
#include "rpc/metrics/metrics_server.h"
#include "self_probe.h"
#include "storage/postgres/postgres_store.h"
#include "storage/sqlite/fsck.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/store_copy.h"
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

// Serves --http-listen if it is given, and tells where. False: its port cannot be written down.
bool ServeHttp(const Config& config, MetricsSources sources, Listeners& listeners) {
  if (config.http_listen.empty()) return true;
  const auto page = std::make_shared<MetricsPage>(std::move(sources));
  listeners.ServeHttp([page] { return page->Text(); });
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

absl::StatusOr<std::unique_ptr<Store>> OpenStore(const Config& config, StoreOptions options) {
  if (config.store_address.empty()) return OpenSqlite(config.data_dir, std::move(options));
  std::error_code error;
  std::filesystem::create_directories(config.data_dir, error);
  if (error) {
    return absl::FailedPreconditionError(
        fmt::format("cannot make {}: {}", config.data_dir.string(), error.message()));
  }
  return OpenPostgres(config.store_address, std::move(options));
}

absl::StatusOr<std::unique_ptr<Store>> OpenEither(const std::string& place) {
  if (IsPostgresAddress(place)) return OpenPostgres(place);
  return OpenSqlite(place, {.reserve_bytes = kReserve});
}

int CopyStores(const Config& config) {
  const auto from = OpenEither(config.copy_from);
  if (!from.ok()) return Refuse(from.status());
  const auto to = OpenEither(config.copy_to);
  if (!to.ok()) return Refuse(to.status());
  const auto report = CopyStore(**from, **to);
  if (!report.ok()) return Refuse(report.status());
  fmt::print("copied {}, {}\n", Count(report->jobs, "job", "jobs"),
             Count(report->events, "event", "events"));
  return kExitOk;
}

int MigrateStore(const Config& config) {
  const absl::Status status = MigratePostgres(config.store_address);
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

// The disk of the directory as df tells it; nothing known if it cannot be asked.
DiskSpace SpaceOf(const std::filesystem::path& directory) {
  std::error_code error;
  const auto space = std::filesystem::space(directory, error);
  if (error) return {};
  const std::uintmax_t used = space.capacity - space.free;
  return {static_cast<std::int64_t>(used + space.available),
          static_cast<std::int64_t>(space.available)};
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

// Serves until a signal comes, then shuts down. Returns the exit code.
int Serve(const Config& config, const sigset_t& signals) {
  StoreOptions options = config.store;
  options.on_failure = EndAfterDiskFailure;
  options.reserve_bytes = kReserve;
  const auto store = OpenStore(config, options);
  if (!store.ok()) return Refuse(store.status());
  JobOptions job_options = config.jobs;
  if (config.store_address.empty()) {
    job_options.disk = [directory = config.data_dir] { return SpaceOf(directory); };
  }
  job_options.retention.clock_file = config.data_dir / "clock";
  JobManager jobs(**store, SystemClock(), RandomIds(), job_options);
  Listeners listeners(jobs, **store, config, Identity(config));
  std::unique_ptr<MetricsServer> metrics;
  int code = kExitHeld;
  if (const std::string wrong = listeners.Prepare(); !wrong.empty()) {
    fmt::print(stderr, "contactd: {}\n", wrong);
    code = kExitUsage;
  } else if (const std::string taken = listeners.Start(); !taken.empty()) {
    fmt::print(stderr, "contactd: cannot listen on {}; does another process?\n", taken);
  } else if (!ServeMetrics(config, Sources(config, options, jobs, listeners), &metrics)) {
    code = kExitHeld;
  } else if (!ServeHttp(config, Sources(config, options, jobs, listeners), listeners) ||
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
  contact::RouteGrpcLog();
  return contact::Serve(config, signals);
}
