// contactd: wires store, jobs and gRPC together and ends them in order.

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>

#include "config.h"
#include "jobs/job_manager.h"
#include "jobs/sources.h"
#include "rpc/grpc_log.h"
#include "rpc/grpc_server.h"
#include "storage/store.h"
#include "version.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// Time for open calls to end. The whole shutdown must stay below 5 s.
constexpr auto kGrace = 2s;

// Blocked in all threads, for WaitFor to take. Must come before the first thread.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

int WaitFor(const sigset_t& signals) {
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {
  }
  return signal;
}

void SetUpLog(spdlog::level::level_enum level) {
  auto log = spdlog::stderr_logger_mt("contactd");
  log->set_level(level);
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  spdlog::set_default_logger(std::move(log));
}

// Once the disk has failed nothing can be promised any more, so nothing goes on.
void EndAfterDiskFailure(const absl::Status& status) {
  spdlog::critical("the store failed: {}", std::string(status.message()));
  std::_Exit(kExitInternal);
}

v1::ServerInfo Identity() {
  v1::ServerInfo identity;
  identity.set_version(kVersion);
  identity.set_revision(kRevision);
  identity.set_instance_id(RandomIds().NextJobId());
  *identity.mutable_start_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  return identity;
}

// Written beside it and renamed, so that nobody reads half a number.
bool WritePort(const std::filesystem::path& file, int port) {
  const std::filesystem::path draft = file.string() + ".new";
  std::ofstream(draft) << port << '\n';
  std::error_code error;
  std::filesystem::rename(draft, file, error);
  return !error;
}

bool Announce(const Config& config, int port) {
  if (!config.port_file.empty() && !WritePort(config.port_file, port)) {
    fmt::print(stderr, "contactd: cannot write --port-file {}\n", config.port_file.string());
    return false;
  }
  const std::string host = config.listen.substr(0, config.listen.rfind(':'));
  const std::string address = port == 0 ? config.listen : fmt::format("{}:{}", host, port);
  fmt::print("contactd {} listening on {}, data in {}\n", kVersion, address,
             config.data_dir.string());
  std::fflush(stdout);
  return true;
}

// Serves until a signal comes, and cleans up.
int Serve(const Config& config, const sigset_t& signals) {
  const auto store = Store::Open(config.data_dir, {.on_failure = EndAfterDiskFailure});
  if (!store.ok()) {
    fmt::print(stderr, "contactd: {}\n", std::string(store.status().message()));
    return absl::IsUnavailable(store.status()) ? kExitHeld : kExitUsage;
  }
  JobManager jobs(**store, SystemClock(), RandomIds(), config.jobs);
  GrpcServer server(jobs, config.rpc, Identity());
  const auto port = server.Start(config.listen);
  int code = kExitHeld;
  if (!port) {
    fmt::print(stderr, "contactd: cannot listen on {}; does another process?\n", config.listen);
  } else if (!Announce(config, *port)) {
    code = kExitUsage;
  } else {
    spdlog::info("{}: shutting down", strsignal(WaitFor(signals)));
    code = kExitOk;
  }
  jobs.Drain();
  server.Shutdown(kGrace);  // From here on no call asks anything of the manager.
  jobs.Stop();
  return code;
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  const sigset_t signals = contact::BlockSignals();
  const auto read = contact::ReadConfig(argc, argv);
  if (const auto* exit = std::get_if<contact::Exit>(&read)) {
    std::fputs(exit->text.c_str(), exit->code == contact::kExitOk ? stdout : stderr);
    return exit->code;
  }
  const auto& config = std::get<contact::Config>(read);
  contact::SetUpLog(config.log_level);
  contact::RouteGrpcLog();
  return contact::Serve(config, signals);
}
