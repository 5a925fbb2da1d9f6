#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/base/message.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/link/recording.h"
#include "cli/settings/options.h"
#include "cli/text/comparison/render_verification.h"
#include "cli/text/print_job.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct VerifyArguments {
  std::string job;
  double tolerance = 0;  // --rel; 0: that of the job.
  bool keep = false;
};

// The jobs that a verification makes. Unless they are kept they go with it: those that have not
// ended are stopped, and deleted by the server later.
class Runs {
 public:
  Runs(Client& client, bool keep) : client_(client), keep_(keep) {}
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;
  ~Runs() {
    if (keep_) return;
    for (const std::string& name : names_) {
      Attempt([&] { DeleteJob(client_, name); }) || Attempt([&] { CancelJob(client_, name); });
    }
  }

  // Submits a run of `job` and returns its name.
  std::string Submit(v1::Scenario scenario, const v1::Job& job) {
    constexpr int kLeftOver = 3600;  // How long a run that could not be deleted stays [s].
    v1::CreateJobRequest request;
    request.set_request_id(RandomRequestId());
    (*request.mutable_job()->mutable_labels())["verifies"] = ShortName(job.name());
    if (!keep_) {
      scenario.mutable_output()->set_ledger_only(true);
      request.mutable_job()->mutable_time_to_live()->set_seconds(kLeftOver);
    }
    *request.mutable_job()->mutable_scenario() = std::move(scenario);
    names_.push_back(client_.CallTellingAll(&Client::Stub::CreateJob, request).name());
    return names_.back();
  }

 private:
  template <class Act>
  static bool Attempt(Act act) {
    try {
      act();
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  Client& client_;
  const bool keep_;
  std::vector<std::string> names_;
};

// The settings with what is left of the time limit.
Settings Remaining(Settings settings, Deadline deadline) {
  using std::chrono::milliseconds;
  if (!deadline) return settings;
  const auto left = *deadline - std::chrono::steady_clock::now();
  const auto whole = std::max(milliseconds(1), std::chrono::ceil<milliseconds>(left));
  settings.timeout = fmt::format("{}ms", whole.count());
  return settings;
}

// The job with its whole ledger, once it has succeeded.
v1::Job Succeeded(Client& client, const std::string& name, const Settings& settings) {
  v1::Job job = ReadRecording(client, name, settings, false).job;
  if (job.has_sweep()) {
    throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep, not a run", job.name()));
  }
  if (job.state() == v1::Job::SUCCEEDED) return job;
  throw Failure(ExitCode::kRunFailed,
                fmt::format("{} did not succeed: {}{}{}", job.name(), job.state_reason(),
                            job.error().message().empty() ? "" : ": ", job.error().message()));
}

// Runs the job at the resolutions of the plan, all at once, and waits for their ends.
std::vector<v1::Job> RunAll(Client& client, const v1::Job& job, const RefinementPlan& plan,
                            Deadline deadline, const Settings& settings, Runs* runs) {
  std::vector<std::string> names;
  for (const double resolution : plan.resolutions) {
    names.push_back(runs->Submit(plan.At(resolution, job.scenario()), job));
  }
  Tell("{} has {} {:g}, and runs again with {:g}\n", job.name(), plan.Field(), plan.own,
       fmt::join(plan.resolutions, ", "));
  std::vector<v1::Job> ended;
  for (const std::string& name : names) {
    ended.push_back(Succeeded(client, name, Remaining(settings, deadline)));
  }
  return ended;
}

ExitCode VerifyJob(const VerifyArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  const Deadline deadline = settings.Deadline();
  Client client = Connect(settings);
  const v1::Job job = Succeeded(client, FindJob(client, arguments.job), settings);
  const RefinementPlan plan = PlanOf(job.scenario());
  Runs runs(client, arguments.keep);
  const Verification verification =
      Verify(plan, job, RunAll(client, job, plan, deadline, settings, &runs),
             arguments.tolerance > 0 ? arguments.tolerance : plan.claim);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(VerificationJson(verification, arguments.keep), settings);
  } else {
    fmt::print("{}", RenderVerification(verification, arguments.keep, settings.OutputStyle()));
  }
  return verification.Holds() ? ExitCode::kOk : ExitCode::kDiffers;
}

}  // namespace

void AddVerify(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<VerifyArguments>();
  AddJob(line, command, &arguments->job);
  command
      .add_option("--rel", arguments->tolerance,
                  "How far a final velocity may be from where finer runs lead, relative to the "
                  "largest speed; a peak force ten times as far, and μ by what that makes of it. "
                  "Default: the job's restitution_tolerance")
      ->check(AtLeast(0));
  command.add_flag("--keep", arguments->keep,
                   "Keep the three runs, with their trajectories; else they are deleted");
  line.SetAction(command, arguments, VerifyJob);
}

}  // namespace contact::cli
