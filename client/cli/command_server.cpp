#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/backup_file.h"
#include "cli/commands.h"
#include "cli/number.h"
#include "cli/render_json.h"
#include "version.h"

namespace contact::cli {
namespace {

ExitCode Version() {
  fmt::print("contactctl {}{}\n", kVersion,
             *kRevision == '\0' ? "" : fmt::format(" ({})", kRevision));
  return ExitCode::kOk;
}

ExitCode Status(const Settings& settings) {
  settings.RequireOutput({"table", "json"});
  Client client = settings.Connect();
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  if (settings.output == "json") {
    PrintJson(ToJson(info), settings);
    return ExitCode::kOk;
  }
  const v1::ServerLimits& limits = info.limits();
  fmt::print(
      "contactd {}{} at {}\n"
      "started   {} UTC, instance {}\n"
      "workers   {}\n"
      "jobs      {} running, {} queued\n"
      "limits    {} bodies, {} contacts, {} samples, {} cells, {} bytes a request, {} queued "
      "jobs, {} watchers\n",
      info.version(), info.revision().empty() ? "" : fmt::format(" ({})", info.revision()),
      client.server(), Instant(info.start_time()), info.instance_id(), info.workers(),
      info.running_jobs(), info.queued_jobs(), limits.max_bodies(), limits.max_contacts(),
      limits.max_samples(), limits.max_cells(), limits.max_message_bytes(),
      limits.max_queued_jobs(), limits.max_watchers());
  return ExitCode::kOk;
}

ExitCode Backup(const std::string& path, const Settings& settings) {
  settings.RequireOutput({"table"});
  Client client = settings.Connect();
  const std::int64_t bytes = ReceiveBackup(client, path, settings.Deadline());
  fmt::print("{}  {} bytes, checked\n", path, bytes);
  return ExitCode::kOk;
}

}  // namespace

void AddServerCommands(CLI::App& app, const Settings& settings, Action* action) {
  app.add_subcommand("version", "Show the version of contactctl")->callback([action] {
    *action = Version;
  });
  CLI::App* server = app.add_subcommand("server", "Ask about the server, back it up");
  server->require_subcommand(1);
  for (const char* name : {"status", "info"}) {
    server->add_subcommand(name, "Show version, load and limits of the server")
        ->callback([&settings, action] { *action = [&settings] { return Status(settings); }; });
  }
  CLI::App* backup =
      server->add_subcommand("backup", "Copy all jobs and events into a file while it goes on");
  auto path = std::make_shared<std::string>();
  backup
      ->add_option("-o,--file", *path,
                   "Where to write; put as contactd.db into an empty data directory it is the "
                   "server's start")
      ->required()
      ->type_name("FILE");
  backup->callback([path, &settings, action] {
    *action = [path, &settings] { return Backup(*path, settings); };
  });
}

}  // namespace contact::cli
