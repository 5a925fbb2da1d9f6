#include "read_config.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "address.h"
#include "base/ids.h"
#include "base/memory_limit.h"
#include "base/spelling.h"
#include "flags.h"
#include "storage/postgres/postgres_store.h"
#include "version.h"

namespace contact {
namespace {

// Of StoreOptions::max_bytes and the limits of owners: no flag says it.
constexpr std::int64_t kUnset = -1;

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

// What a worker may take for its run: as much of half of the memory that there is as each other
// one, for the other half is for all else; no more than a run usually needs, and no less than a
// small one.
std::int64_t ShareOfMemory(int workers) {
  constexpr std::int64_t kLeast = 64 << 20, kMost = 1 << 30;
  return std::clamp(MemoryLimit() / 2 / workers, kLeast, kMost);
}

std::string VariableOf(const CLI::Option& option) {
  std::string name = "CONTACTD_" + option.get_lnames().front();
  std::ranges::replace(name, '-', '_');
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

// The environment variables as flags, without those that the command line has.
std::vector<std::string> FlagsFromEnvironment(const CLI::App& app,
                                              const std::vector<std::string>& given) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    const char* value = std::getenv(option->get_envname().c_str());
    if (option->get_envname().empty() || value == nullptr || *value == '\0') continue;
    const std::string flag = "--" + option->get_lnames().front();
    const bool wins = std::ranges::any_of(given, [&flag](const std::string& argument) {
      return argument == flag || argument.starts_with(flag + "=");
    });
    if (!wins) flags.push_back(fmt::format("{}={}", flag, value));
  }
  return flags;
}

// Whether the address is of this machine only. Throws CLI::ValidationError if it is none, and for
// one that others can reach, unless they may. `need` says what that would take.
bool CheckAddress(const char* flag, const std::string& listen, const char* forms, bool allowed,
                  const char* need) {
  const auto host = HostOf(listen);
  if (!host) throw CLI::ValidationError(flag, fmt::format("{} is not {}", listen, forms));
  const bool loopback = IsLoopback(*host);
  if (loopback || allowed) return loopback;
  throw CLI::ValidationError(
      flag, fmt::format("{} is not a loopback address, and {}; use 127.0.0.1, or say "
                        "--insecure-i-know",
                        listen, need));
}

// All addresses of --listen.
std::vector<std::string> ListenAddresses(const Config& config) {
  std::vector<std::string> all(1, config.listen);
  all.insert(all.end(), config.more_listen.begin(), config.more_listen.end());
  return all;
}

bool IsFile(const std::string& listen) { return listen.starts_with("unix:") && listen.size() > 5; }

// Throws CLI::ValidationError for settings of identity that do not belong together.
void CheckIdentity(const Config& config) {
  const IdentityPaths& identity = config.identity;
  const bool tls = !identity.tls.certificate.empty();
  const auto refuse = [](const char* flag, const char* why) {
    throw CLI::ValidationError(flag, why);
  };
  if (tls == identity.tls.key.empty()) refuse("--tls-cert", "goes with --tls-key");
  if (!identity.tls.client_ca.empty() && !tls) refuse("--tls-client-ca", "needs --tls-cert");
  if (!identity.tls.crl.empty() && identity.tls.client_ca.empty()) {
    refuse("--tls-crl", "needs --tls-client-ca");
  }
  if (!identity.rules.empty() && identity.tls.client_ca.empty()) {
    refuse("--identity-rules", "needs --tls-client-ca");
  }
  if (!identity.tls.client_ca.empty() && identity.rules.empty() && identity.tokens.empty() &&
      identity.jwt_keys.empty()) {
    refuse("--tls-client-ca",
           "needs --identity-rules, --tokens or --jwt-keys to know who a client is");
  }
  if (!identity.jwt_keys.empty() &&
      (identity.jwt.issuer.empty() || identity.jwt.audience.empty())) {
    refuse("--jwt-keys", "needs --jwt-issuer and --jwt-audience");
  }
  const bool tokens = !identity.tokens.empty() || !identity.jwt_keys.empty();
  if (tokens && !tls && !std::ranges::all_of(ListenAddresses(config), IsFile)) {
    refuse(identity.tokens.empty() ? "--jwt-keys" : "--tokens",
           "would go over the network unencrypted; give --tls-cert, or --listen "
           "unix:PATH");
  }
  for (const auto& [flag, address] : {std::pair("--listen-admin", config.listen_admin),
                                      std::pair("--trusted-proxy", config.trusted_proxy)}) {
    if (!address.empty() && !IsFile(address)) refuse(flag, "must be unix:PATH");
  }
}

// Throws CLI::ValidationError for a gateway that would let in whom the other listeners keep out.
void CheckHttp(const Config& config, bool asks, bool insecure) {
  const std::string& http = config.http_listen;
  if (http.empty() || IsFile(http)) return;
  CheckAddress("--http-listen", http, "HOST:PORT or unix:PATH", insecure,
               "it has no encryption; put nginx before it, with deploy/nginx/contactd-web.conf");
  const auto refuse = [](const char* why) { throw CLI::ValidationError("--http-listen", why); };
  if (asks && !insecure) {
    refuse(
        "would take tokens unencrypted; give unix:PATH, and put nginx before it, with "
        "deploy/nginx/contactd-web.conf");
  }
  if (!asks && IsFile(config.listen) && !insecure) {
    refuse(
        "would let in everybody of this machine, and --listen unix:PATH does not; give "
        "unix:PATH");
  }
}

// The dashboard that stands with this program: installed, or built.
// The first of these places, relative to the program, that is a directory; empty: none.
std::filesystem::path FirstDirectory(std::initializer_list<const char*> places) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : places) {
    if (std::filesystem::is_directory(program / place, error)) return program / place;
  }
  return {};
}

// Reads `unix:PATH user:NAME tenant:NAME roles:ROLE`. Throws CLI::ValidationError for another text.
SocketListener ToSocket(const std::string& text) {
  const std::size_t space = std::min(text.find(' '), text.size());
  const std::string address = text.substr(0, space);
  std::string mistake = "must be unix:PATH user:NAME tenant:NAME roles:ROLE";
  std::optional<Principal> principal;
  if (IsFile(address)) principal = ParsePrincipal(text.substr(space), &mistake);
  if (!principal) throw CLI::ValidationError("--listen-as", fmt::format("{}: {}", text, mistake));
  principal->how = "socket";
  return {address.substr(5), *principal};
}

// Most of the disk of a directory, which may be missing; 0: nobody knows.
std::int64_t MostOfDisk(std::filesystem::path directory) {
  while (!std::filesystem::exists(directory) && directory.has_relative_path()) {
    directory = directory.parent_path();
  }
  std::error_code error;
  const auto space = std::filesystem::space(directory.empty() ? "." : directory, error);
  return error ? 0 : static_cast<std::int64_t>(space.capacity / 5 * 4);
}

// What no flag says of the limits of each owner. Where nobody is asked who calls there is one
// owner, and they would only be those of the server, once more.
void SettleOwnerLimits(const Config& config, OwnerLimits* limits) {
  const bool told_apart = AsksWhoCalls(config.identity) || !config.listen_as.empty();
  const auto settle = [told_apart](auto* limit, std::int64_t protective) {
    using Number = std::remove_pointer_t<decltype(limit)>;
    if (*limit == kUnset) *limit = static_cast<Number>(told_apart ? protective : 0);
  };
  settle(&limits->unfinished_jobs, 1000);
  settle(&limits->cells, 200'000);
  settle(&limits->stored_bytes, config.store.max_bytes / 2);
  settle(&limits->creates_per_second, 100);
  settle(&limits->streams, 100);
  settle(&limits->calls, 500);
  settle(&limits->connections, 100);
}

// Who this process is among those that share a store.
void SettleShared(Config* config) {
  char host[HOST_NAME_MAX + 1] = {};
  gethostname(host, HOST_NAME_MAX);
  WorkerProcess& process = config->shared.process;
  process.host = host;
  process.name = fmt::format("{}/{}", process.host, RandomIds().NextId());
  if (const char* job = std::getenv("SLURM_JOB_ID")) process.batch_id = job;
  config->shared.works = config->role != ProcessRole::kFront;
  config->shared.leave = [] { kill(getpid(), SIGTERM); };
}

// Throws CLI::ValidationError for settings of a database that do not belong together.
void CheckStore(const Config& config) {
  const auto refuse = [](const char* flag, const char* why) {
    throw CLI::ValidationError(flag, why);
  };
  if (config.store_address.empty()) {
    if (config.role != ProcessRole::kAll) refuse("--role", "needs --store");
    if (config.migrate) refuse("migrate", "needs --store; contactd brings a directory up to date");
    return;
  }
  if (!IsPostgresAddress(config.store_address)) {
    refuse("--store", "must be postgresql://USER@HOST/DATABASE, as libpq takes it");
  }
  if (config.shared.process.lease < std::chrono::seconds(1)) {
    refuse("--lease", "must be at least 1s");
  }
  const bool worker = config.role == ProcessRole::kWorker;
  if (config.stop_after.count() > 0 && !worker) refuse("--stop-after", "is for --role worker");
  if (config.shared.exit_when_idle.count() > 0 && !worker &&
      config.role != ProcessRole::kLauncher) {
    refuse("--exit-when-idle", "is for --role worker and --role launcher");
  }
  if (config.fsck) refuse("fsck", "looks at directories; use pg_amcheck for a database");
  if (config.store.max_bytes > 0) {
    refuse("--max-stored-bytes", "is of --data-dir; the database of --store has its own limits");
  }
}

// What the workers of a launcher are told. Throws CLI::ValidationError for settings that do not
// belong together.
void SettleLauncher(Config* config) {
  launcher::LauncherOptions& options = config->launcher;
  if (config->shared.exit_when_idle.count() > 0) {
    options.worker.exit_when_idle =
        std::chrono::ceil<std::chrono::seconds>(config->shared.exit_when_idle);
  }
  if (options.interval < std::chrono::milliseconds(100)) {
    throw CLI::ValidationError("--launch-interval", "must be at least 100ms");
  }
  if (options.limits.min_workers > options.limits.max_workers) {
    throw CLI::ValidationError("--min-workers", "is more than --max-workers");
  }
}

void SettleListen(const std::vector<std::string>& addresses, Config* config) {
  if (addresses.empty()) return;
  config->listen = addresses.front();
  config->more_listen.assign(addresses.begin() + 1, addresses.end());
}

// True if only this machine reaches the addresses of --listen. Throws CLI::ValidationError for one
// that others reach and must not, or that is none.
bool CheckListen(const Config& config, bool asks, bool insecure) {
  const bool safe = asks && !config.identity.tls.certificate.empty();
  bool loopback = true;
  for (const std::string& listen : ListenAddresses(config)) {
    loopback &= IsFile(listen) ||
                CheckAddress("--listen", listen, "HOST:PORT or unix:PATH", insecure || safe,
                             "that needs --tls-cert, and --tokens or --tls-client-ca");
  }
  return loopback;
}

// Sets what follows from several flags. Throws CLI::ValidationError for values that one flag's own
// check cannot refuse.
void Finish(const Switches& switches, Config* config) {
  const bool asks = AsksWhoCalls(config->identity);
  SettleListen(switches.listen, config);
  const bool loopback = CheckListen(*config, asks, switches.insecure);
  if (!config->metrics_listen.empty()) {
    CheckAddress("--metrics-listen", config->metrics_listen, "HOST:PORT", switches.insecure,
                 "metrics have neither encryption nor password");
  }
  CheckIdentity(*config);
  CheckHttp(*config, asks, switches.insecure);
  if (config->web_dir.empty()) {
    config->web_dir = FirstDirectory({"../share/contactd/web", "../../../client/web/dist"});
  }
  if (config->docs_dir.empty()) {
    config->docs_dir = FirstDirectory({"../share/contactd/docs", "../../docs"});
  }
  for (const std::string& text : switches.listen_as) config->listen_as.push_back(ToSocket(text));
  if (config->data_dir.empty() && config->store_address.empty()) {
    throw CLI::RequiredError("--data-dir");
  }
  CheckStore(*config);
  SettleShared(config);
  SettleLauncher(config);
  std::int64_t& memory = config->jobs.max_budget.memory_bytes;
  if (memory == kUnset) memory = ShareOfMemory(config->jobs.workers);
  if (!config->store_address.empty()) config->store.max_bytes = 0;
  if (config->store.max_bytes == kUnset) config->store.max_bytes = MostOfDisk(config->data_dir);
  SettleOwnerLimits(*config, &config->jobs.owner_limits);
  // Where callers are asked who they are, only --listen-admin tells of services and calls: gRPC's
  // own services ask nobody.
  config->rpc.reflection =
      loopback && !asks && config->listen_admin.empty() && !switches.no_reflection;
  config->rpc.channelz = loopback && !asks && config->listen_admin.empty() && switches.channelz;
  config->admin_channelz = switches.channelz;
  config->rpc.write_stall = std::chrono::milliseconds(std::llround(switches.write_stall_s * 1000));
}

// Gives each flag its environment variable, and adds what is no setting.
void AddSources(CLI::App* app) {
  for (CLI::Option* option : app->get_options()) {
    if (option != app->get_help_ptr()) option->envname(VariableOf(*option));
  }
  app->set_config("--config", "", "File of the same settings, one `name = value` a line")
      ->envname("CONTACTD_CONFIG");
  app->allow_config_extras(CLI::config_extras_mode::error);
  app->set_version_flag("--version", fmt::format("contactd {} ({})", kVersion, kRevision));
}

// The arguments in the order that CLI11 wants: the last one first.
std::vector<std::string> Arguments(const CLI::App& app, int argc, const char* const* argv) {
  const std::vector<std::string> given(argv + 1, argv + argc);
  std::vector<std::string> arguments = FlagsFromEnvironment(app, given);
  arguments.insert(arguments.end(), given.begin(), given.end());
  std::ranges::reverse(arguments);
  return arguments;
}

// The settings before any flag is read. No job takes the server for itself, or its memory or disk,
// unless a setting says so.
Config Defaults() {
  Config config;
  config.jobs.max_budget = {.wall_time = std::chrono::hours(1),
                            .steps = 1'000'000'000,
                            .output_bytes = 4'000'000'000,
                            .memory_bytes = kUnset};
  config.data_dir = DefaultDataDir();
  config.jobs.workers = DefaultWorkers();
  config.jobs.checkpoint_interval = std::chrono::seconds(1);
  config.store.max_bytes = kUnset;
  config.jobs.max_watchers = 1000;
  config.rpc.calls.max_watchers_per_peer = 100;
  config.jobs.owner_limits = {.unfinished_jobs = kUnset,
                              .cells = kUnset,
                              .stored_bytes = kUnset,
                              .creates_per_second = kUnset,
                              .streams = kUnset,
                              .calls = kUnset,
                              .connections = kUnset};
  config.jobs.admin_slots = 10;
  config.jobs.max_disk_percent = 80;
  config.rpc.max_message_bytes = 2 << 20;
  return config;
}

// What the parser says, or of a word that it does not know the nearest one that it does.
std::string WhatIsWrong(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  if (extras.empty()) return error.what();
  const bool flag = extras.front().starts_with("-");
  std::vector<std::string> known;
  if (flag) {
    for (const CLI::Option* option : app.get_options()) {
      known.push_back("--" + option->get_lnames().front());
    }
  } else {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  }
  return WithHint(
      fmt::format("unknown {} {}", flag ? "flag" : "command", Quoted(extras.front())),
      DidYouMean(extras.front().substr(0, extras.front().find('=')), {known.begin(), known.end()}));
}

}  // namespace

std::variant<Config, Exit> ReadConfig(int argc, const char* const* argv) {
  Config config = Defaults();
  Switches switches;
  CLI::App app("Runs contact simulations as jobs and streams what happens to them.", "contactd");
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  AddFlags(&app, &config, &switches);
  const CLI::App* fsck =
      app.add_subcommand("fsck", "Check what is in --data-dir, without a change to it, and end")
          ->fallthrough();
  CLI::App* migrate =
      app.add_subcommand("migrate", "Make the tables of --store, or bring them up to date, and end")
          ->fallthrough();
  migrate->add_option(
      "--grant-front", config.grants.front,
      "Role of PostgreSQL that fronts connect as: it gets the rights that they need");
  migrate->add_option("--grant-worker", config.grants.worker, "The same for workers");
  migrate->add_option("--grant-launcher", config.grants.launcher,
                      "The same for launchers and scalers, which ask how much there is to do");
  CLI::App* copy = app.add_subcommand(
      "copy-store", "Copy all jobs into an empty store while no contactd uses the two, and end");
  copy->add_option("--from", config.copy_from, "Directory, or postgresql://… of a database")
      ->required();
  copy->add_option("--to", config.copy_to, "Directory, or postgresql://… of a database")
      ->required();
  AddSources(&app);
  try {
    app.parse(Arguments(app, argc, argv));
    config.fsck = fsck->parsed();
    config.migrate = migrate->parsed();
    config.copy_store = copy->parsed();
    Finish(switches, &config);
  } catch (const CLI::CallForHelp&) {
    return Exit{kExitOk, app.help()};
  } catch (const CLI::CallForVersion& version) {
    return Exit{kExitOk, fmt::format("{}\n", version.what())};
  } catch (const CLI::ParseError& error) {
    return Exit{kExitUsage, fmt::format("contactd: {}\nRun contactd --help for the settings.\n",
                                        WhatIsWrong(app, error))};
  }
  return config;
}

}  // namespace contact
