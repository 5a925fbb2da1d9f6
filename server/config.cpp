#include "config.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "version.h"

namespace contact {
namespace {

struct Address {
  std::string host;
  int port;
};

std::optional<Address> ParseAddress(const std::string& text) {
  if (text.starts_with("unix:")) return std::nullopt;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const std::string host = text.substr(0, colon);
  const std::string port = text.substr(colon + 1);
  const bool bracketed = host.front() == '[' && host.back() == ']';
  if (!bracketed && host.find(':') != std::string::npos) return std::nullopt;
  if (port.empty() || port.size() > 5 || !std::ranges::all_of(port, ::isdigit)) return std::nullopt;
  if (std::stoi(port) > 65535) return std::nullopt;
  return Address{host, std::stoi(port)};
}

// Numbers only, but for `localhost`: a name such as 127.evil.example may lead anywhere.
bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "[::1]") return true;
  const auto numeric = [](char c) { return c == '.' || (c >= '0' && c <= '9'); };
  return host.starts_with("127.") && std::ranges::all_of(host, numeric);
}

std::filesystem::path DefaultDataDir() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::filesystem::path(state) / "contactd";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".local/state/contactd";
  }
  return {};
}

int DefaultWorkers() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

std::string VariableOf(const CLI::Option& option) {
  std::string name = "CONTACTD_" + option.get_lnames().front();
  std::ranges::replace(name, '-', '_');
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

// The variables as flags, to stand before those of the command line, which so win.
std::vector<std::string> FlagsFromEnvironment(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    const char* value = std::getenv(option->get_envname().c_str());
    if (option->get_envname().empty() || value == nullptr || *value == '\0') continue;
    flags.push_back(fmt::format("--{}={}", option->get_lnames().front(), value));
  }
  return flags;
}

const std::map<std::string, spdlog::level::level_enum> kLogLevels{
    {"debug", spdlog::level::debug}, {"info", spdlog::level::info}, {"warn", spdlog::level::warn},
    {"error", spdlog::level::err},   {"off", spdlog::level::off},
};

const std::map<std::string, LogFormat> kLogFormats{{"text", LogFormat::kText},
                                                   {"json", LogFormat::kJson}};

// Flags whose value needs a second look. Times in seconds.
struct Switches {
  bool no_reflection = false;
  bool channelz = false;
  bool insecure = false;
  double write_stall_s = 30;
  double max_wall_time_s = 0;
  double step_timeout_s = 60;
  double retain_for_s = 0;
  double compact_after_s = 0;
  double checkpoint_interval_s = 1;
};

constexpr double kDay = 24 * 3600;
const std::map<std::string, double> kTimeUnits{
    {"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}, {"d", kDay},
};

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(std::llround(seconds * 1000));
}

void AddFlags(CLI::App* app, Config* config, Switches* switches) {
  app->add_option("--listen", config->listen,
                  "HOST:PORT, port 0 being any free one; or unix:PATH, a socket file")
      ->capture_default_str();
  app->add_option("--data-dir", config->data_dir, "Directory of jobs and results; made if missing")
      ->capture_default_str();
  app->add_option("--workers", config->jobs.workers, "Simulations that run at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app->add_option("--port-file", config->port_file, "File to write the port to");
  app->add_option("--log-level", config->log_level, "debug, info, warn, error or off")
      ->transform(CLI::CheckedTransformer(kLogLevels))
      ->default_str("info");
  app->add_option("--log-format", config->log_format, "text, or json: an object a line")
      ->transform(CLI::CheckedTransformer(kLogFormats))
      ->default_str("text");
  app->add_option("--metrics-listen", config->metrics_listen,
                  "HOST:PORT that tells metrics to Prometheus, such as 127.0.0.1:9464");
  app->add_flag("--no-reflection", switches->no_reflection,
                "Do not tell clients which services there are");
  app->add_flag("--channelz", switches->channelz,
                "Tell clients of this host which connections there are, for debugging");
  app->add_flag("--insecure-i-know", switches->insecure,
                "Listen without encryption and passwords on an address that others can reach");
}

void AddLimits(CLI::App* app, Config* config, Switches* switches) {
  app->add_option("--max-rpc-memory-bytes", config->rpc.max_memory_bytes,
                  "Bytes that connections and messages under way may take")
      ->check(CLI::Range(16 << 20, 2047 << 20))
      ->capture_default_str();
  ScenarioLimits& scenario = config->jobs.scenario_limits;
  app->add_option("--max-message-bytes", config->rpc.max_message_bytes, "Bytes in one request")
      ->check(CLI::Range(64 << 10, 256 << 20))
      ->capture_default_str();
  app->add_option("--max-bodies", scenario.max_bodies, "Bodies in a scenario")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--max-contacts", scenario.max_contacts, "Contacts in a scenario")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--max-samples", scenario.max_samples, "Samples in a recorded trajectory")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
      ->capture_default_str();
  app->add_option("--max-cells", scenario.max_cells, "Cells of a sweep")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--max-queued-jobs", config->jobs.max_queued_jobs, "Jobs that wait for a worker")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--max-watchers", config->jobs.max_watchers, "Watchers of all jobs together")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app->add_option("--max-connections", config->rpc.connections.in_all, "Connections in all")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app->add_option("--max-connections-per-peer", config->rpc.connections.per_peer,
                  "Connections of one address of the network")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app->add_option("--max-watchers-per-peer", config->rpc.calls.max_watchers_per_peer,
                  "Watchers of one address of the network")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app->add_option("--max-creates-per-second", config->rpc.calls.max_creates_per_second,
                  "CreateJob calls of one address, on average; 0: any number")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app->add_option("--max-create-burst", config->rpc.calls.max_create_burst,
                  "CreateJob calls of one address at once")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--max-metadata-bytes", config->rpc.calls.max_metadata_bytes,
                  "Bytes of metadata in one call")
      ->check(CLI::Range(1024, 64 << 10))
      ->capture_default_str();
  app->add_option("--max-stored-bytes", config->store.max_bytes,
                  "Bytes of the database; 0: what the disk has")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 50))
      ->capture_default_str();
  app->add_option("--write-stall-seconds", switches->write_stall_s,
                  "A watcher that takes nothing for so long is dropped")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str();
}

// `10s`, `5m`, `12h`, `30d`; seconds without a unit.
CLI::Option* AddTime(CLI::App* app, const std::string& name, double* seconds,
                     const std::string& description) {
  return app->add_option(name, *seconds, description)
      ->transform(CLI::AsNumberWithUnit(kTimeUnits))
      ->check(CLI::Range(0.0, 36'500 * kDay))
      ->type_name("TIME")
      ->capture_default_str();
}

void AddLifecycle(CLI::App* app, Config* config, Switches* switches) {
  JobOptions& jobs = config->jobs;
  AddTime(app, "--max-wall-time", &switches->max_wall_time_s,
          "Wall time of one attempt of a job, such as 10m; 0 is any");
  app->add_option("--max-steps", jobs.max_budget.steps,
                  "Integration steps of a job, all its cells together; 0 is any")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  app->add_option("--max-output-bytes", jobs.max_budget.output_bytes,
                  "Bytes that a job may record, such as 2GB; 0 is any")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES")
      ->capture_default_str();
  AddTime(app, "--step-timeout", &switches->step_timeout_s,
          "A run that makes no step for so long is ended; 0 is never");
  app->add_option("--max-attempts", jobs.max_attempts,
                  "A job that was running at so many crashes of the server is set aside")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app->add_option("--retain-bytes", jobs.retention.bytes,
                  "Ended jobs are deleted, the first to end first, while they take more than this, "
                  "such as 20GB; 0 is any")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES")
      ->capture_default_str();
  AddTime(app, "--retain-for", &switches->retain_for_s,
          "Ended jobs are deleted after so long, such as 30d, unless they say so themselves; "
          "0 is never");
  AddTime(app, "--compact-after", &switches->compact_after_s,
          "The trajectories of ended jobs are dropped after so long, such as 7d, and their results "
          "kept; 0 is never");
  AddTime(app, "--checkpoint-interval", &switches->checkpoint_interval_s,
          "How often a long run stores where it may go on after a crash; 0 is never");
}

// What may be reached from elsewhere needs the consent of whoever starts us.
void CheckReach(const char* flag, const std::string& listen, bool loopback, bool insecure) {
  if (loopback || insecure) return;
  throw CLI::ValidationError(
      flag, listen +
                " is not a loopback address, and there is neither encryption nor password; "
                "use 127.0.0.1, or say --insecure-i-know");
}

// Throws CLI::ValidationError for what one flag alone cannot tell.
void Check(const Switches& switches, Config* config) {
  const auto address = ParseAddress(config->listen);
  const bool file = config->listen.starts_with("unix:") && config->listen.size() > 5;
  if (!address && !file) {
    throw CLI::ValidationError("--listen", config->listen + " is not HOST:PORT or unix:PATH");
  }
  const bool loopback = file || IsLoopback(address->host);
  CheckReach("--listen", config->listen, loopback, switches.insecure);
  if (!config->metrics_listen.empty()) {
    const auto metrics = ParseAddress(config->metrics_listen);
    if (!metrics) {
      throw CLI::ValidationError("--metrics-listen", config->metrics_listen + " is not HOST:PORT");
    }
    CheckReach("--metrics-listen", config->metrics_listen, IsLoopback(metrics->host),
               switches.insecure);
  }
  if (config->data_dir.empty()) throw CLI::RequiredError("--data-dir");
  config->rpc.reflection = loopback && !switches.no_reflection;
  config->rpc.channelz = loopback && switches.channelz;
  config->rpc.write_stall = Milliseconds(switches.write_stall_s);
  config->jobs.max_budget.wall_time = Milliseconds(switches.max_wall_time_s);
  config->jobs.step_timeout = Milliseconds(switches.step_timeout_s);
  config->jobs.retention.age =
      std::chrono::ceil<std::chrono::seconds>(Milliseconds(switches.retain_for_s));
  config->jobs.retention.compact_after =
      std::chrono::ceil<std::chrono::seconds>(Milliseconds(switches.compact_after_s));
  config->jobs.checkpoint_interval = Milliseconds(switches.checkpoint_interval_s);
}

}  // namespace

std::variant<Config, Exit> ReadConfig(int argc, const char* const* argv) {
  Config config;
  Switches switches;
  config.data_dir = DefaultDataDir();
  config.jobs.workers = DefaultWorkers();

  CLI::App app("Runs contact simulations as jobs and streams what happens to them.", "contactd");
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  AddFlags(&app, &config, &switches);
  AddLimits(&app, &config, &switches);
  const CLI::App* fsck =
      app.add_subcommand("fsck", "Check what is in --data-dir, without a change to it, and end")
          ->fallthrough();
  AddLifecycle(&app, &config, &switches);
  for (CLI::Option* option : app.get_options()) {
    if (option != app.get_help_ptr()) option->envname(VariableOf(*option));
  }
  app.set_config("--config", "", "File of the same settings, one `name = value` a line")
      ->envname("CONTACTD_CONFIG");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.set_version_flag("--version", fmt::format("contactd {} ({})", kVersion, kRevision));

  std::vector<std::string> arguments = FlagsFromEnvironment(app);
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  std::ranges::reverse(arguments);  // As CLI11 wants them.
  try {
    app.parse(arguments);
    Check(switches, &config);
  } catch (const CLI::CallForHelp&) {
    return Exit{kExitOk, app.help()};
  } catch (const CLI::CallForVersion& version) {
    return Exit{kExitOk, fmt::format("{}\n", version.what())};
  } catch (const CLI::ParseError& error) {
    return Exit{kExitUsage,
                fmt::format("contactd: {}\nRun contactd --help for the settings.\n", error.what())};
  }
  config.fsck = fsck->parsed();
  return config;
}

}  // namespace contact
