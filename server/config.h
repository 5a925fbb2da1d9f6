#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gateway/protocol/origin.h"
#include "identity/audit_log.h"
#include "identity/identity_files.h"
#include "jobs/cluster/shared_options.h"
#include "jobs/job_manager.h"
#include "launcher/launcher_options.h"
#include "log.h"
#include "rpc/grpc_server.h"
#include "rpc/net/connection_limits.h"
#include "storage/postgres/grants.h"
#include "storage/store.h"

namespace contact {

/// Exit codes of contactd.
enum ExitCode : int {
  kExitOk = 0,
  kExitInternal = 1,
  kExitDamaged = 1,  ///< Of `fsck`: it found damage.
  kExitUsage = 2,    ///< Bad flag, or a store that cannot be used.
  kExitHeld = 3,     ///< Another process holds the store or the address, or no database answers.
};

/// A socket file whose users are all one principal.
struct SocketListener {
  std::string path;
  Principal principal;
};

/// True if those who come in by `--listen` are asked who they are.
inline bool AsksWhoCalls(const IdentityPaths& paths) {
  return !paths.tokens.empty() || !paths.jwt_keys.empty() || !paths.tls.client_ca.empty();
}

/// What a process does for the jobs of a database that others share.
enum class ProcessRole {
  kAll,       ///< It answers calls and runs jobs.
  kFront,     ///< It answers calls.
  kWorker,    ///< It runs jobs.
  kLauncher,  ///< It starts workers.
};

/// The settings of contactd, checked.
struct Config {
  std::string listen = "127.0.0.1:7070";  ///< HOST:PORT, port 0 being any free one; or unix:PATH.
  std::vector<std::string> more_listen;   ///< Further addresses of the same.
  std::string metrics_listen;             ///< HOST:PORT of the metrics; empty: none.
  std::string http_listen;                ///< HOST:PORT or unix:PATH of the gateway; empty: none.
  gateway::OriginRules http_rules;        ///< Whom the gateway answers.
  std::filesystem::path http_port_file;   ///< File to write the gateway's port to; empty: none.
  std::filesystem::path web_dir;          ///< Files of the dashboard; empty: none.
  std::filesystem::path docs_dir;         ///< Files of the documentation; empty: none.
  std::vector<SocketListener> listen_as;  ///< Socket files, each with one identity.
  std::string trusted_proxy;    ///< unix:PATH of a proxy that says who calls; empty: none.
  std::string listen_admin;     ///< unix:PATH of AdminService; empty: it is at `listen`.
  bool admin_channelz = false;  ///< Channelz is served at `listen_admin`.
  IdentityPaths identity;       ///< Who may come in by `listen`.
  AuditPlace audit_log;         ///< Where changes and refused calls are written.
  std::int64_t max_audit_bytes = 100'000'000;  ///< See AuditLog::Open.
  std::filesystem::path data_dir;              ///< Directory of jobs and results; made if missing.
  std::string store_address;  ///< PostgreSQL database of jobs and results; empty: `data_dir`.
  ProcessRole role = ProcessRole::kAll;     ///< With `store_address`.
  SharedOptions shared;                     ///< With `store_address`.
  std::chrono::milliseconds stop_after{0};  ///< A worker ends after this time; 0: never.
  std::filesystem::path port_file;          ///< File to write the port to; empty: none.
  spdlog::level::level_enum log_level = spdlog::level::info;
  bool fsck = false;        ///< Check the data directory and end.
  bool copy_store = false;  ///< Copy the jobs from one store to the other and end.
  std::string copy_from;    ///< With `copy_store`: a directory, or the address of a database.
  std::string copy_to;      ///< As `copy_from`; a store without jobs.
  postgres::Grants grants;  ///< With `migrate`: roles that get what they need.
  bool migrate = false;     ///< Bring the tables of `store_address` up to date and end.
  LogFormat log_format = LogFormat::kText;
  StoreOptions store;
  JobOptions jobs;
  GrpcServerOptions rpc;
  ConnectionLimits connections;          ///< Of each listener.
  int max_connection_bytes = 192 << 20;  ///< See GatewayThreads.
  launcher::LauncherOptions launcher;    ///< Of the role `launcher`.
};

}  // namespace contact
