#include <fmt/format.h>

#include <cctype>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/link/backup_file.h"
#include "cli/link/connect.h"
#include "cli/link/http_get.h"
#include "cli/text/print_job.h"
#include "cli/text/render_json.h"
#include "cli/verbs/identity/identity_commands.h"
#include "cli/verbs/verbs.h"
#include "version.h"

namespace contact::cli {
namespace {

ExitCode Version(const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  if (settings.output == OutputFormat::kJson) {
    const nlohmann::ordered_json json = {{"version", kVersion}, {"revision", kRevision}};
    PrintJson(json.dump(2) + "\n", settings);
    return ExitCode::kOk;
  }
  fmt::print("contactctl {}{}\n", kVersion,
             *kRevision == '\0' ? "" : fmt::format(" ({})", kRevision));
  return ExitCode::kOk;
}

// What the caller has of its own limits, such as `streams 1 of 100`.
std::string TextOf(const v1::ServerInfo& info) {
  std::string text;
  for (const v1::Quota& quota : info.quotas()) {
    std::string name = v1::Quota::Resource_Name(quota.resource());
    for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(c));
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, quota.used());
    if (quota.limit() > 0) text += fmt::format(" of {}", quota.limit());
  }
  return text;
}

ExitCode Status(const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  Client client = Connect(settings);
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  if (settings.output == OutputFormat::kJson) {
    PrintJson(ToJson(info), settings);
    return ExitCode::kOk;
  }
  const v1::ServerLimits& limits = info.limits();
  fmt::print(
      "contactd {}{} at {}\n"
      "started   {} UTC, instance {}\n"
      "you       {} of {}, {}\n"
      "workers   {}\n"
      "jobs      {} running, {} queued\n"
      "limits    {}, {}, {}, {}, {} a request, {}, {}\n",
      info.version(), info.revision().empty() ? "" : fmt::format(" ({})", info.revision()),
      client.server(), Instant(info.start_time()), info.instance_id(), info.principal().name(),
      info.principal().tenant(), fmt::join(info.principal().roles(), ","), info.workers(),
      info.running_jobs(), info.queued_jobs(), Count(limits.max_bodies(), "body", "bodies"),
      Count(limits.max_contacts(), "contact", "contacts"),
      Count(limits.max_samples(), "sample", "samples"), Count(limits.max_cells(), "cell", "cells"),
      Count(limits.max_message_bytes(), "byte", "bytes"),
      Count(limits.max_queued_jobs(), "queued job", "queued jobs"),
      Count(limits.max_watchers(), "watcher", "watchers"));
  if (info.quotas_size() > 0) fmt::print("yours     {}\n", TextOf(info));
  return ExitCode::kOk;
}

ExitCode Backup(const std::string& path, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  Client client = Connect(settings);
  const std::int64_t bytes = ReceiveBackup(client, path, settings.Deadline());
  fmt::print("{}  {}, checked\n", path, Count(bytes, "byte", "bytes"));
  return ExitCode::kOk;
}

// Prints the metrics in the text format of Prometheus.
ExitCode Metrics(const std::string& address, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  constexpr std::chrono::seconds kTimeout{10};
  try {
    const std::string page =
        HttpGet(address, "/metrics",
                settings.timeout.empty() ? kTimeout : RequireDuration(settings.timeout));
    fmt::print("{}", PrintableLines(page));
  } catch (const Failure& failure) {
    if (failure.code() != ExitCode::kUnreachable) throw;
    throw Failure(failure.code(), fmt::format("no metrics at {}: a server tells them with contactd "
                                              "--metrics-listen HOST:PORT, --metrics names that",
                                              failure.what()));
  }
  return ExitCode::kOk;
}

}  // namespace

void AddVersion(CommandLine& line, CLI::App& command) { line.SetAction(command, Version); }

void AddServer(CommandLine& line, CLI::App& server) {
  server.require_subcommand(1);
  for (const char* name : {"status", "info"}) {
    line.SetAction(*server.add_subcommand(name, "Show version, load and limits of the server"),
                   Status);
  }
  CLI::App* backup =
      server.add_subcommand("backup", "Copy all jobs and events into a file while it goes on");
  auto path = std::make_shared<std::string>();
  AddDestination(line, *backup, "-f,--file", path.get(),
                 "Where to write; put as contactd.db into an empty data directory it is the "
                 "server's start")
      ->required();
  line.SetAction(*backup, path, Backup);

  CLI::App* metrics = server.add_subcommand(
      "metrics", "Print the metrics of a server that was started with --metrics-listen");
  auto address = std::make_shared<std::string>("127.0.0.1:9464");
  metrics
      ->add_option("--metrics", *address, "The address that --metrics-listen of the server names")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  line.SetAction(*metrics, address, Metrics);
  AddToken(line, server);
  AddAudit(line, server);
}

}  // namespace contact::cli
