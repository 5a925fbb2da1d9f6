#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <system_error>
#include <vector>

#include "cli/base/message.h"
#include "cli/help/completion.h"
#include "cli/help/manual.h"
#include "cli/help/usage.h"
#include "cli/settings/resolve.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

constexpr char kTour[] =
    R"(Simulates contacts whose restitution is what you asked for, on a contactd server.
A scenario is a YAML file: bodies on a line, their contacts, what holds and drives them.
A job is a scenario that the server solves, and it goes on when you leave.
Its result is a ledger of every contact cycle, the recorded motion, and figures.
No server yet?  contactctl dev starts one. Something wrong?  contactctl doctor looks.
All commands:   contactctl --help; the way through them: contactctl help tutorial.

  contactctl init three-ball-chain        write an example scenario
  contactctl run three-ball-chain.yaml    submit it, watch it, see its ledger
  contactctl plot JOB hysteresis          draw the force over the deformation)";

constexpr char kCodes[] =
    R"(Exit codes: 0 ok, 1 run failed, 2 usage, 3 invalid scenario, 4 unreachable, 5 timeout,
6 not found, 7 not converged, 8 differs, 9 not allowed, 10 overload, 11 local file, 130 interrupted.)";

int TellFailure(const Failure& failure) {
  const bool list = failure.code() == ExitCode::kInvalidScenario;
  Tell("{}{}\n", list ? "" : "contactctl: ", failure.what());
  return static_cast<int>(failure.code());
}

// Answers `__complete WORD…` of completion scripts and `__man FOLDER CONTACTD` of the build.
// Returns false if the words are neither.
bool Serve(CommandLine& line, const std::vector<std::string>& words) {
  const std::string first = words.empty() ? "" : words.front();
  if (first == "__complete") {
    fmt::print("{}", Complete(line, {words.begin() + 1, words.end()}));
    return true;
  }
  if (first != "__man" || words.size() != 3) return false;
  WriteManual(line, words[1], words[2]);
  return true;
}

ExitCode Act(CommandLine& line) {
  if (!line.action()) {
    PrintHelp(kTour);
    return ExitCode::kOk;
  }
  Settings& settings = line.settings();
  ResolveSettings(line.app(), &settings);
  if (!settings.problems.empty() && NeedsSettings(line.app())) {
    throw Failure(settings.problems.front().code, settings.problems.front().text);
  }
  const ExitCode code = line.action()();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw Failure(ExitCode::kLocal, "cannot write to the standard output");
  }
  return code;
}

int Main(int argc, char** argv) {
  CommandLine line(kTour);
  line.app().footer(kCodes);
  AddGlobalFlags(line);
  AddVerbs(line);
  if (Serve(line, {argv + 1, argv + argc})) return 0;
  try {
    line.app().parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    PrintHelp(line.app().help());
    return 0;
  } catch (const CLI::Success& success) {
    return line.app().exit(success);
  } catch (const CLI::ParseError& error) {
    throw Failure(ExitCode::kUsage, UsageMessage(line.app(), error));
  }
  return static_cast<int>(Act(line));
}

}  // namespace
}  // namespace contact::cli

int main(int argc, char** argv) {
  try {
    return contact::cli::Main(argc, argv);
  } catch (const contact::cli::Failure& failure) {
    return contact::cli::TellFailure(failure);
  } catch (const std::system_error& error) {  // fmt could not write to a stream.
    contact::cli::Tell("contactctl: {}\n", error.what());
    return static_cast<int>(contact::cli::ExitCode::kLocal);
  } catch (const std::exception& error) {
    contact::cli::Tell("contactctl: {}\n", error.what());
    return static_cast<int>(contact::cli::ExitCode::kRunFailed);
  }
}
