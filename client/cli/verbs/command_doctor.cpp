#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>
#include <langinfo.h>

#include <algorithm>
#include <clocale>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/base/process.h"
#include "cli/base/table.h"
#include "cli/link/client.h"
#include "cli/link/connect.h"
#include "cli/settings/resolve.h"
#include "cli/text/print_job.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/verbs.h"
#include "version.h"

namespace contact::cli {
namespace {

// The outcome of one check.
struct Finding {
  std::string what;               // What was checked, such as `clock`.
  std::string found;              // What was found, for people.
  std::string fix = {};           // What repairs it; empty: nothing is wrong.
  ExitCode code = ExitCode::kOk;  // With a fix: the exit code of the command.
};
using Findings = std::vector<Finding>;

// MAJOR.MINOR of a version.
std::string Minor(const std::string& version) { return version.substr(0, version.rfind('.')); }

Finding ClockSkew(const v1::ServerInfo& info) {
  using google::protobuf::util::TimeUtil;
  const auto ahead = TimeUtil::DurationToSeconds(info.start_time() - TimeUtil::GetCurrentTime());
  if (ahead <= 2) return {"clock", "the server's is not ahead"};
  return {"clock", fmt::format("the server started {} s in the future", ahead),
          "set the clocks of both machines, such as with NTP", ExitCode::kLocal};
}

// Adds what keeps runs of many steps busy, of the newest that run. Nothing is wrong with them.
void LookAtBusyRuns(Client& client, Findings* findings) {
  constexpr int kMostRuns = 50;  // More would hide what else was found.
  v1::ListJobsRequest request;
  request.set_page_size(kMostRuns);
  request.add_states(v1::Job::RUNNING);
  const v1::ListJobsResponse running = client.Call(&Client::Stub::ListJobs, request);
  for (const v1::Job& job : running.jobs()) {
    const std::string& busy = job.progress().busy_with();
    if (!busy.empty()) findings->push_back({"busy", job.name() + ": " + OneLine(busy)});
  }
}

// Adds findings about the server, its version, its clock and its runs; without a server only the
// first.
void LookAtServer(const Settings& settings, Findings* findings) {
  try {
    Client client(settings.server, std::chrono::seconds(3), CredentialsOf(settings));
    const v1::ServerInfo info =
        client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
    findings->push_back({"server", settings.server + " answers"});
    const bool same = Minor(info.version()) == Minor(kVersion);
    findings->push_back({"version",
                         fmt::format("contactctl {}, contactd {}", kVersion, info.version()),
                         same ? "" : "install the same version on both sides", ExitCode::kLocal});
    findings->push_back(ClockSkew(info));
    LookAtBusyRuns(client, findings);
  } catch (const Failure& failure) {
    const std::string text = failure.what();
    const bool refused = failure.code() == ExitCode::kUnreachable;
    const std::string advice = refused ? ServerAdvice(settings.server, text) : "";
    findings->push_back({"server", text.substr(0, text.find('\n')),
                         !advice.empty()
                             ? advice
                             : "contactctl dev starts one; --server, CONTACT_SERVER or contactctl "
                               "config set server names another",
                         failure.code()});
  }
}

Finding LookAtFigures() {
  const std::string version = ContactsimVersion();
  const bool good = !version.empty();
  return {"figures", good ? version : "no contactsim with matplotlib, so plot draws nothing",
          good ? "" : InstallDrawing(), ExitCode::kLocal};
}

Finding LookAtTerminal(const Settings& settings) {
  std::setlocale(LC_CTYPE, "");
  const bool utf8 = std::string_view(nl_langinfo(CODESET)) == "UTF-8";
  const Style style = settings.OutputStyle();
  std::string found = style.terminal ? fmt::format("{} columns", style.width) : "not a terminal";
  found += style.color ? ", colour" : ", no colour";
  found += utf8 ? ", UTF-8" : ", not UTF-8";
  const bool narrow = style.terminal && style.width > 0 && style.width < 60;
  return {"terminal", found,
          !utf8    ? "export LC_CTYPE=C.UTF-8"
          : narrow ? "make it wider: below 60 columns, tables leave some out"
                   : "",
          ExitCode::kLocal};
}

void LookAtConfig(const CLI::App& app, const Settings& settings, Findings* findings) {
  std::string read;
  for (const ConfigFile& file : ConfigFilesOf(app)) {
    if (file.mistake.empty()) read += (read.empty() ? "" : ", ") + file.path;
  }
  for (const Problem& problem : settings.problems) {
    findings->push_back({"config", problem.text,
                         "edit the file, or contactctl config set KEY VALUE", problem.code});
  }
  if (settings.problems.empty()) {
    findings->push_back({"config", read.empty() ? "no files" : read});
  }
}

std::string Json(const Findings& findings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    json.push_back({{"check", finding.what},
                    {"ok", finding.fix.empty()},
                    {"found", finding.found},
                    {"fix", finding.fix}});
  }
  return json.dump(2) + "\n";
}

std::string Text(const Findings& findings, const Style& style) {
  std::string text;
  for (const Finding& finding : findings) {
    const bool ok = finding.fix.empty();
    text +=
        fmt::format("{}  {}  {}\n", Paint(ok ? "ok " : "BAD", ok ? Tone::kGood : Tone::kBad, style),
                    Pad(finding.what, 8), finding.found);
    if (!ok) text += fmt::format("     {}  fix: {}\n", Pad("", 8), finding.fix);
  }
  return text;
}

ExitCode Doctor(const CLI::App& app, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  Findings findings;
  LookAtConfig(app, settings, &findings);
  LookAtServer(settings, &findings);
  findings.push_back(LookAtFigures());
  findings.push_back(LookAtTerminal(settings));
  if (settings.output == OutputFormat::kJson) {
    PrintJson(Json(findings), settings);
  } else {
    fmt::print("{}", Text(findings, settings.OutputStyle()));
  }
  const auto bad = std::ranges::find_if(findings, [](const Finding& f) { return !f.fix.empty(); });
  return bad == findings.end() ? ExitCode::kOk : bad->code;
}

}  // namespace

void AddDoctor(CommandLine& line, CLI::App& command) {
  line.SetAction(command, [&line] { return Doctor(line.app(), line.settings()); });
}

}  // namespace contact::cli
