#include <fmt/format.h>

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

ExitCode Info(const Settings& settings) {
  settings.RequireOutput({"table", "json"});
  Client client = settings.Connect();
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  if (settings.output == "json") {
    fmt::print("{}", ToJson(info));
    return ExitCode::kOk;
  }
  const v1::ServerLimits& limits = info.limits();
  fmt::print(
      "contactd {}{} at {}\n"
      "started   {} UTC, instance {}\n"
      "workers   {}\n"
      "jobs      {} running, {} queued\n"
      "limits    {} bodies, {} contacts, {} samples, {} bytes a request, {} queued jobs, {} "
      "watchers\n",
      info.version(), info.revision().empty() ? "" : fmt::format(" ({})", info.revision()),
      client.server(), Instant(info.start_time()), info.instance_id(), info.workers(),
      info.running_jobs(), info.queued_jobs(), limits.max_bodies(), limits.max_contacts(),
      limits.max_samples(), limits.max_message_bytes(), limits.max_queued_jobs(),
      limits.max_watchers());
  return ExitCode::kOk;
}

}  // namespace

void AddServerCommands(CLI::App& app, const Settings& settings, Action* action) {
  app.add_subcommand("version", "Show the version of contactctl")->callback([action] {
    *action = Version;
  });
  CLI::App* server = app.add_subcommand("server", "Ask about the server");
  server->require_subcommand(1);
  server->add_subcommand("info", "Show version, load and limits of the server")
      ->callback([&settings, action] { *action = [&settings] { return Info(settings); }; });
}

}  // namespace contact::cli
