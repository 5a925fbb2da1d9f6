#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/process.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

// The page of a job, or of all jobs without one.
std::string PageOf(Client& client, const std::string& job) {
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  const std::string& address = info.http_address();
  if (!address.starts_with("http")) {
    const std::string file = address.substr(std::min(address.find(':') + 1, address.size()));
    throw Failure(ExitCode::kLocal,
                  fmt::format("the server's page is at a socket file, which browsers cannot open; "
                              "`ssh -N -L 8080:{} HOST` has it at http://localhost:8080",
                              file.empty() ? "FILE" : file));
  }
  if (job.empty()) return address + "/";
  if (std::filesystem::is_regular_file(job)) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{0} is a file, not a job: `contactctl submit {0}` makes a job of a "
                              "scenario or sweep, `contactctl open last` shows its page",
                              job));
  }
  return fmt::format("{}/runs/{}", address, ShortName(FindJob(client, job)));
}

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Starts $BROWSER, else the desktop's browser. Nothing happens where there is none.
void Show(const std::string& page) {
  std::string browser = Variable("BROWSER");
  if (browser.empty() && !Variable("DISPLAY").empty()) browser = "xdg-open";
  if (browser.empty() && !Variable("WAYLAND_DISPLAY").empty()) browser = "xdg-open";
  if (browser.empty()) return;
  try {
    WaitForProcess(StartProcess({browser, page}, {.silent_errors = true, .output = STDERR_FILENO}));
  } catch (const std::system_error&) {
    return;  // The address is printed.
  }
}

ExitCode Open(const std::string& job, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  Client client = Connect(settings);
  const std::string page = PageOf(client, job);
  fmt::print("{}\n", page);
  std::fflush(stdout);
  if (settings.output == OutputFormat::kTable) Show(page);
  return ExitCode::kOk;
}

}  // namespace

void AddOpen(CommandLine& line, CLI::App& command) {
  auto job = std::make_shared<std::string>();
  AddOption(line, command, "JOB", job.get(), ValueKind::kJob,
            "Its page. Default: the list of all jobs");
  line.SetAction(command, job, Open);
}

}  // namespace contact::cli
