#include "run_launcher.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "base/clock.h"
#include "launcher/demand.h"
#include "launcher/exec_fleet.h"
#include "launcher/launcher.h"
#include "launcher/slurm_fleet.h"
#include "launcher/worker_program.h"
#include "log.h"
#include "storage/postgres/postgres_store.h"
#include "version.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

std::unique_ptr<launcher::WorkerFleet> MakeFleet(const Config& config) {
  const launcher::LauncherOptions& options = config.launcher;
  launcher::Program worker =
      WorkerProgram(options, config.store_address, launcher::OwnEnvironment());
  if (options.engine == launcher::Engine::kExec) {
    return std::make_unique<launcher::ExecFleet>(std::move(worker));
  }
  return std::make_unique<launcher::SlurmFleet>(std::move(worker), options.slurm,
                                                options.limits.threads);
}

// Waits for one of the signals. 0: none came in the time.
int WaitFor(const sigset_t& signals, std::chrono::nanoseconds time) {
  const timespec timeout{.tv_sec = time / 1s, .tv_nsec = (time % 1s).count()};
  return std::max(0, sigtimedwait(&signals, nullptr, &timeout));
}

void Announce(const Config& config) {
  const bool slurm = config.launcher.engine == launcher::Engine::kSlurm;
  Greet(config.log_format,
        fmt::format("contactd {} starts up to {} workers {} for {}", kVersion,
                    config.launcher.limits.max_workers, slurm ? "by Slurm" : "on this machine",
                    PostgresName(config.store_address)));
  sd_notify(0, "READY=1");
}

}  // namespace

int RunLauncher(const Config& config, const sigset_t& signals) {
  launcher::DemandReader reader(config.store_address);
  if (const auto first = reader.Read(); !first.ok()) {
    fmt::print(stderr, "contactd: {}\n", std::string(first.status().message()));
    return absl::IsUnavailable(first.status()) ? kExitHeld : kExitUsage;
  }
  const auto fleet = MakeFleet(config);
  launcher::Launcher launcher([&reader] { return reader.Read(); }, *fleet, config.launcher.limits,
                              config.launcher.interval, SystemClock());
  Announce(config);
  int signal = 0;
  while (signal == 0) {
    launcher.Look();
    sd_notify(0, "WATCHDOG=1");
    signal = WaitFor(signals, config.launcher.interval);
  }
  spdlog::info("{}: ending", strsignal(signal));
  sd_notify(0, "STOPPING=1");
  return kExitOk;
}

}  // namespace contact
