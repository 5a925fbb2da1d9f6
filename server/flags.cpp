#include "flags.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include "base/duration.h"

namespace contact {
namespace {

const std::map<std::string, spdlog::level::level_enum> kLogLevels{
    {"debug", spdlog::level::debug}, {"info", spdlog::level::info}, {"warn", spdlog::level::warn},
    {"error", spdlog::level::err},   {"off", spdlog::level::off},
};

const std::map<std::string, ProcessRole> kRoles{{"all", ProcessRole::kAll},
                                                {"front", ProcessRole::kFront},
                                                {"worker", ProcessRole::kWorker},
                                                {"launcher", ProcessRole::kLauncher}};

const std::map<std::string, LogFormat> kLogFormats{{"text", LogFormat::kText},
                                                   {"json", LogFormat::kJson}};

const std::map<std::string, launcher::Engine> kEngines{{"exec", launcher::Engine::kExec},
                                                       {"slurm", launcher::Engine::kSlurm}};

// What the server is, apart from limits.
void AddBasics(CLI::App* app, Config* config, Switches* switches) {
  app->add_option(
         "--listen", switches->listen,
         "HOST:PORT, port 0 being any free one; or unix:PATH, a socket file. There are all "
         "calls by gRPC, gRPC-Web and Connect, and the dashboard. May be repeated")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->default_str(config->listen);
  app->add_option("--data-dir", config->data_dir, "Directory of jobs and results; made if missing")
      ->capture_default_str();
  app->add_option(
      "--store", config->store_address,
      "postgresql://… of the database that holds jobs and results; --data-dir holds them "
      "without it");
  app->add_option("--workers", config->jobs.workers, "Simulations that run at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app->add_option("--port-file", config->port_file, "File to write the port to");
  app->add_option("--metrics-listen", config->metrics_listen,
                  "HOST:PORT that tells metrics to Prometheus, such as 127.0.0.1:9464");
}

// A duration such as `10s`, `5m`, `12h`, `30d`; its default is the value that is there. Rounded up
// to the unit of `value`.
template <class Duration>
void AddTime(CLI::App* app, const std::string& name, Duration* value,
             const std::string& description) {
  const auto set = [name, value](const std::string& text) {
    const auto time = ParseDuration(text);
    if (!time) throw CLI::ValidationError(name, NotADuration(text));
    *value = std::chrono::ceil<Duration>(*time);
  };
  const std::chrono::duration<double> seconds = *value;
  app->add_option_function<std::string>(name, set, description)
      ->type_name("TIME")
      ->default_str(fmt::format("{:g}s", seconds.count()));
}

// What the process does for jobs that others share.
void AddSharing(CLI::App* app, Config* config) {
  app->add_option("--role", config->role,
                  "With --store: all; front, which answers calls; worker, which runs jobs; or "
                  "launcher, which starts workers when jobs wait")
      ->transform(CLI::CheckedTransformer(kRoles))
      ->default_str("all");
  AddTime(app, "--lease", &config->shared.process.lease,
          "With --store: a worker that was not heard of for this time has lost its jobs");
  AddTime(app, "--exit-when-idle", &config->shared.exit_when_idle,
          "A worker that has had no job for this time ends; 0 is never, and 5m for those that a "
          "launcher starts");
  AddTime(app, "--stop-after", &config->stop_after,
          "A worker ends after this time, and hands its jobs back; 0 is never");
}

// The gateway for browsers and curl.
void AddHttp(CLI::App* app, Config* config) {
  app->add_option(
      "--http-listen", config->http_listen,
      "The same as one more --listen, but without TLS: for browsers, curl or a proxy of "
      "this machine");
  app->add_option("--http-port-file", config->http_port_file,
                  "File to write the port of --http-listen to");
  app->add_option("--http-host", config->http_rules.hosts,
                  "Name that browsers may call the gateway by, beside localhost; may be repeated")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--http-allow-origin", config->http_rules.origins,
                  "Origin whose pages may read answers, such as https://lab.example; may be "
                  "repeated")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--web-dir", config->web_dir, "Files of the dashboard")
      ->default_str("those installed with contactd");
  app->add_option("--docs-dir", config->docs_dir, "Files of the documentation, shown at /docs")
      ->default_str("those of the package contact-doc");
}

void AddLog(CLI::App* app, Config* config) {
  app->add_option("--log-level", config->log_level, "debug, info, warn, error or off")
      ->transform(CLI::CheckedTransformer(kLogLevels))
      ->default_str("info");
  app->add_option("--log-format", config->log_format, "text, or json: an object a line")
      ->transform(CLI::CheckedTransformer(kLogFormats))
      ->default_str("text");
}

// What clients may see, and from where.
void AddExposure(CLI::App* app, Switches* switches) {
  app->add_flag("--no-reflection", switches->no_reflection,
                "Do not tell clients which services there are");
  app->add_flag("--channelz", switches->channelz,
                "Tell clients of this host which connections there are, for debugging");
  app->add_flag("--insecure-i-know", switches->insecure,
                "Listen without encryption and passwords on an address that others can reach");
}

// A size such as `2GB`; its default is the value that is there.
void AddSize(CLI::App* app, const char* name, std::int64_t* value, const char* description) {
  app->add_option(name, *value, description)
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES")
      ->capture_default_str();
}

// Who may come in, and what is written of it.
void AddIdentity(CLI::App* app, Config* config, Switches* switches) {
  IdentityPaths& identity = config->identity;
  app->add_option("--tls-cert", identity.tls.certificate,
                  "Certificate of the server and those up to its authority, PEM; read again when "
                  "it changes");
  app->add_option("--tls-key", identity.tls.key, "Private key of --tls-cert, PEM");
  app->add_option("--tls-client-ca", identity.tls.client_ca,
                  "Authorities whose client certificates are taken, PEM; clients need one then");
  app->add_option("--tls-crl", identity.tls.crl,
                  "Lists of the client certificates that each authority of --tls-client-ca has "
                  "revoked, PEM; read again when they change");
  app->add_option("--identity-rules", identity.rules,
                  "File that says which principal a client certificate is");
  app->add_option("--tokens", identity.tokens,
                  "File of tokens, made by contactctl server token; clients need one then");
  app->add_option("--jwt-keys", identity.jwt_keys,
                  "File of the public keys of an identity provider (JWKS), whose JSON Web Tokens "
                  "are taken; read again when it changes");
  app->add_option("--jwt-issuer", identity.jwt.issuer, "Issuer of the JSON Web Tokens");
  app->add_option("--jwt-audience", identity.jwt.audience, "Audience of the JSON Web Tokens");
  app->add_option("--jwt-user-claim", identity.jwt.user_claim, "Claim with the name of the holder")
      ->capture_default_str();
  app->add_option("--jwt-tenant-claim", identity.jwt.tenant_claim, "Claim with the tenant")
      ->capture_default_str();
  app->add_option("--jwt-roles-claim", identity.jwt.roles_claim, "Claim with the roles")
      ->capture_default_str();
  app->add_option("--listen-as", switches->listen_as,
                  "Also listen on a socket file whose users are all one principal: \"unix:PATH "
                  "user:NAME tenant:NAME roles:ROLE\"")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--trusted-proxy", config->trusted_proxy,
                  "Also listen on unix:PATH for a proxy, which says in x-contactd-principal who "
                  "calls: \"user:NAME tenant:NAME roles:ROLE\"");
  app->add_option("--listen-admin", config->listen_admin,
                  "unix:PATH of AdminService, reflection and channelz, which --listen then lacks");
  CLI::Option* audit_log =
      app->add_option("--audit-log", config->audit_log.file,
                      "File that gets a line for each change and each refused call");
  app->add_option("--audit-key", config->audit_log.key_file,
                  "File with a key, of 32 characters or more, without which nobody can make the "
                  "chain of --audit-log anew")
      ->needs(audit_log);
  AddSize(
      app, "--max-audit-bytes", &config->max_audit_bytes,
      "Size at which the file of --audit-log becomes FILE.1, FILE.2 and so on, and a new one is "
      "begun; 0 is any");
}

// A number in [low, high]; its default is the value that is there.
template <class Number>
void AddNumber(CLI::App* app, const char* name, Number* value, Number low, Number high,
               const char* description) {
  app->add_option(name, *value, description)->check(CLI::Range(low, high))->capture_default_str();
}

// Limits of what one request may hold.
void AddRequestLimits(CLI::App* app, Config* config) {
  ScenarioLimits& scenario = config->jobs.scenario_limits;
  AddNumber(app, "--max-message-bytes", &config->rpc.max_message_bytes, 64 << 10, 256 << 20,
            "Bytes in one request");
  AddNumber(app, "--max-metadata-bytes", &config->rpc.calls.max_metadata_bytes, 1024, 64 << 10,
            "Bytes of metadata in one call");
  AddNumber(app, "--max-bodies", &scenario.max_bodies, 1, 1'000'000, "Bodies in a scenario");
  AddNumber(app, "--max-contacts", &scenario.max_contacts, 1, 1'000'000, "Contacts in a scenario");
  AddNumber<std::int64_t>(app, "--max-samples", &scenario.max_samples, 1, 1'000'000'000,
                          "Samples in a recorded trajectory");
  AddNumber(app, "--max-cells", &scenario.max_cells, 1, 1'000'000, "Cells of a sweep");
}

// Limits of what one peer may do, and all of them together.
void AddPeerLimits(CLI::App* app, Config* config, Switches* switches) {
  CallLimits& calls = config->rpc.calls;
  AddNumber(app, "--max-queued-jobs", &config->jobs.max_queued_jobs, 1, 1'000'000,
            "Jobs that wait for a worker");
  AddNumber(app, "--max-creates-per-second", &calls.max_creates_per_second, 0.0, 1e6,
            "CreateJob calls of one address, on average; 0: any number");
  AddNumber(app, "--max-create-burst", &calls.max_create_burst, 1, 1'000'000,
            "CreateJob calls of one address at once");
  AddNumber(app, "--max-watchers", &config->jobs.max_watchers, 1, 100'000,
            "Watchers of all jobs together");
  AddNumber(app, "--max-watchers-per-peer", &calls.max_watchers_per_peer, 1, 100'000,
            "Streams of one address of the network");
  AddNumber(app, "--max-connections", &config->connections.in_all, 1, 100'000,
            "Connections in all");
  AddNumber(app, "--max-connections-per-peer", &config->connections.per_peer, 1, 100'000,
            "Connections of one address of the network");
  AddNumber(app, "--write-stall-seconds", &switches->write_stall_s, 0.01, 3600.0,
            "A reader of a stream that takes nothing for this time is dropped");
}

// A limit of what one owner may have; unset, it is what ReadConfig finds right.
template <class Number>
void AddOwnerLimit(CLI::App* app, const char* name, Number* value, const char* preset,
                   const char* description) {
  constexpr Number kMost = 1'000'000'000;
  app->add_option(name, *value, description)
      ->check(CLI::Range(Number{0}, kMost))
      ->default_str(fmt::format("{}; any number where nobody is asked who calls", preset));
}

// Limits of what one owner may have, and what is kept for admins.
void AddOwnerLimits(CLI::App* app, JobOptions* jobs) {
  OwnerLimits& owner = jobs->owner_limits;
  AddNumber(app, "--max-running-per-owner", &jobs->max_running_per_owner, 0, 1024,
            "Jobs of one owner that run at a time; 0: as many as there are workers");
  AddOwnerLimit(app, "--max-unfinished-per-owner", &owner.unfinished_jobs, "1000",
                "Jobs of one owner that wait or run; 0: any number");
  AddOwnerLimit(app, "--max-cells-per-owner", &owner.cells, "200000",
                "Cells of the sweeps of one owner that wait or run; 0: any number");
  app->add_option("--max-stored-bytes-per-owner", owner.stored_bytes,
                  "Bytes of the jobs of one owner at which it may create no more; 0: any number")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES")
      ->default_str("50 % of --max-stored-bytes; any number where nobody is asked who calls");
  AddOwnerLimit(app, "--max-creates-per-second-per-owner", &owner.creates_per_second, "100",
                "CreateJob calls of one owner, on average; 0: any number");
  AddNumber(app, "--max-create-burst-per-owner", &owner.create_burst, 1, 1'000'000,
            "CreateJob calls of one owner at once");
  AddOwnerLimit(app, "--max-watchers-per-owner", &owner.streams, "100",
                "Streams of one owner; 0: any number");
  AddOwnerLimit(app, "--max-calls-per-owner", &owner.calls, "500",
                "Calls of one owner that are open, beside streams; 0: any number");
  AddOwnerLimit(app, "--max-connections-per-owner", &owner.connections, "100",
                "Connections on which one owner has calls open; 0: any number");
  AddNumber(app, "--admin-slots", &jobs->admin_slots, 0, 1000,
            "Of --max-queued-jobs and --max-watchers, so many are kept for admins, but no more "
            "than half");
}

// Limits of memory and disk.
void AddSpaceLimits(CLI::App* app, Config* config) {
  AddNumber(app, "--max-rpc-memory-bytes", &config->max_connection_bytes, 16 << 20, 2047 << 20,
            "Bytes of requests and answers under way that connections may hold; past it the one "
            "that holds most is cut");
  app->add_option("--max-stored-bytes", config->store.max_bytes,
                  "Bytes of the database; 0: what the disk has")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 50))
      ->default_str("80 % of the disk");
  AddNumber(app, "--max-disk-percent", &config->jobs.max_disk_percent, 0, 100,
            "No jobs are accepted while the disk of --data-dir is fuller and has less than 10 GB "
            "left; 0: however full it is");
}

// Words that are passed on to another program.
void AddWords(CLI::App* app, const char* name, std::vector<std::string>* words,
              const char* description) {
  app->add_option(name, *words, description)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// What the role `launcher` starts, and how many.
void AddLauncher(CLI::App* app, launcher::LauncherOptions* options) {
  app->add_option("--launcher", options->engine,
                  "What runs the workers that --role launcher starts: exec, this machine; or slurm")
      ->transform(CLI::CheckedTransformer(kEngines))
      ->default_str("exec");
  AddNumber(app, "--min-workers", &options->limits.min_workers, 0, 1000,
            "Worker processes that there are even if nothing waits");
  AddNumber(app, "--max-workers", &options->limits.max_workers, 1, 1000,
            "Worker processes at most");
  AddNumber(app, "--worker-threads", &options->limits.threads, 1, 1024,
            "Simulations that a worker process runs at once");
  AddTime(app, "--launch-interval", &options->interval, "Time between two looks at what waits");
  app->add_option("--worker-command", options->worker.command, "Program of a worker process")
      ->default_str("this contactd");
  AddWords(app, "--worker-option", &options->worker.options,
           "Flag for worker processes, such as --max-memory=4GB; may be repeated");
}

// Why a text cannot be the job name of workers; empty if it can. To squeue a comma begins another.
std::string CheckJobName(const std::string& name) {
  const bool good = !name.empty() && name.find_first_of(", \t\n") == std::string::npos;
  return good ? "" : "must be a word without commas";
}

// How the role `launcher` asks Slurm.
void AddSlurm(CLI::App* app, launcher::SlurmOptions* slurm) {
  app->add_option("--slurm-partition", slurm->partition, "Partition of the workers");
  app->add_option("--slurm-account", slurm->account, "Account that pays for the workers");
  AddTime(app, "--slurm-time", &slurm->time,
          "Time limit of a worker, such as 4h, in whole minutes; 0 is that of the partition");
  app->add_option("--slurm-job-name", slurm->job_name,
                  "Job name of the workers; no other jobs of this user may have it")
      ->check(CheckJobName)
      ->capture_default_str();
  app->add_option("--slurm-output", slurm->output,
                  "File of a worker's log, where the compute nodes see it")
      ->capture_default_str();
  AddWords(app, "--slurm-option", &slurm->options,
           "Word for sbatch, such as --mem=4G; may be repeated");
}

// What one job may use.
void AddBudgets(CLI::App* app, JobOptions* jobs) {
  AddTime(app, "--max-wall-time", &jobs->max_budget.wall_time,
          "Wall time of one attempt of a job, such as 10m; 0 is any");
  AddNumber(app, "--max-steps", &jobs->max_budget.steps, std::int64_t{0},
            std::numeric_limits<std::int64_t>::max(),
            "Integration steps of a job, all its cells together; 0 is any");
  AddSize(app, "--max-output-bytes", &jobs->max_budget.output_bytes,
          "Bytes that a job may record, such as 2GB; 0 is any");
  app->add_option("--max-memory", jobs->max_budget.memory_bytes,
                  "Memory of a worker for its run: a job that is estimated to need more is "
                  "refused, and one whose ledger needs more is ended; 0 is any")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES")
      ->default_str("half of the memory over all workers, 1 GiB at most");
  AddTime(app, "--step-timeout", &jobs->step_timeout,
          "A run that makes no step for this time is ended; 0 is never");
  AddNumber(app, "--max-attempts", &jobs->max_attempts, 1, 1000,
            "A job that was running at this many crashes of the server is set aside");
  AddTime(app, "--checkpoint-interval", &jobs->checkpoint_interval,
          "How often a long run stores where it can continue after a crash; 0 is never");
}

// How long ended jobs are kept.
void AddRetention(CLI::App* app, RetentionLimits* retention) {
  AddSize(app, "--retain-bytes", &retention->bytes,
          "Ended jobs are deleted, in the order of their ends, while they take more than this, "
          "such as 20GB; 0 is any");
  AddTime(app, "--retain-for", &retention->age,
          "Ended jobs are deleted after this time, such as 30d, unless they have one of their own; "
          "0 is never");
  AddTime(app, "--compact-after", &retention->compact_after,
          "The trajectories of ended jobs are dropped after this time, such as 7d, and their "
          "results kept; 0 is never");
}

}  // namespace

void AddFlags(CLI::App* app, Config* config, Switches* switches) {
  AddBasics(app, config, switches);
  AddSharing(app, config);
  AddHttp(app, config);
  AddLog(app, config);
  AddExposure(app, switches);
  AddIdentity(app, config, switches);
  AddRequestLimits(app, config);
  AddPeerLimits(app, config, switches);
  AddOwnerLimits(app, &config->jobs);
  AddSpaceLimits(app, config);
  AddBudgets(app, &config->jobs);
  AddRetention(app, &config->jobs.retention);
  AddLauncher(app, &config->launcher);
  AddSlurm(app, &config->launcher.slurm);
}

}  // namespace contact
