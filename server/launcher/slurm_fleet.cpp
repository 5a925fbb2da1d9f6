#include "launcher/slurm_fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace contact::launcher {
namespace {

// A word as a shell reads it back, whatever is in it.
std::string ShellWord(std::string_view word) {
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

// How long before the time limit Slurm sends SIGTERM; it may do so a minute earlier.
std::chrono::seconds NoticeOf(const SlurmOptions& options) {
  constexpr std::chrono::seconds kNotice{60};
  return options.time.count() == 0
             ? kNotice
             : std::min<std::chrono::seconds>(kNotice, std::chrono::seconds(options.time) / 4);
}

}  // namespace

std::vector<std::string> SbatchWords(const SlurmOptions& options, int threads) {
  // B: without it Slurm sends the signal to job steps only. Requeued jobs would come back beside
  // those that replace them.
  std::vector<std::string> words = {"sbatch",
                                    "--parsable",
                                    "--job-name=" + options.job_name,
                                    "--nodes=1",
                                    "--ntasks=1",
                                    fmt::format("--cpus-per-task={}", threads),
                                    fmt::format("--signal=B:TERM@{}", NoticeOf(options).count()),
                                    "--export=ALL",
                                    "--no-requeue"};
  const auto add = [&words](const char* flag, const std::string& value) {
    if (!value.empty()) words.push_back(fmt::format("--{}={}", flag, value));
  };
  add("output", options.output);
  add("partition", options.partition);
  add("account", options.account);
  if (options.time.count() > 0) add("time", std::to_string(options.time.count()));
  words.insert(words.end(), options.options.begin(), options.options.end());
  return words;
}

std::vector<std::string> SqueueWords(const SlurmOptions& options) {
  return {"squeue",
          "--me",
          "--noheader",
          "--name=" + options.job_name,
          "--states=PENDING,RUNNING,CONFIGURING",
          "--format=%i"};
}

std::string BatchScript(const std::vector<std::string>& words) {
  std::string script = "#!/bin/sh\nexec";
  for (const std::string& word : words) script += " " + ShellWord(word);
  return script + "\n";
}

absl::StatusOr<int> CountJobs(std::string_view answer) {
  int jobs = 0;
  while (!answer.empty()) {
    std::string_view line = answer.substr(0, answer.find('\n'));
    answer.remove_prefix(std::min(line.size() + 1, answer.size()));
    line = line.substr(0, line.find_last_not_of(' ') + 1);
    if (line.empty()) continue;
    if (line.find_first_not_of("0123456789") != std::string_view::npos) {
      return absl::InternalError(fmt::format("squeue answers '{}'", line));
    }
    ++jobs;
  }
  return jobs;
}

SlurmFleet::SlurmFleet(Program worker, SlurmOptions options, int threads)
    : worker_(std::move(worker)), options_(std::move(options)), threads_(threads) {}

absl::Status SlurmFleet::Start(int count) {
  const Program sbatch{SbatchWords(options_, threads_), worker_.environment};
  // No array: scancel takes the number of one of its jobs for all of them, or for none.
  for (int i = 0; i < count; ++i) {
    const auto output = OutputOf(sbatch, BatchScript(worker_.words));
    if (!output.ok()) return output.status();
  }
  return absl::OkStatus();
}

absl::StatusOr<int> SlurmFleet::Count() {
  const auto answer = OutputOf({SqueueWords(options_), worker_.environment});
  if (!answer.ok()) return answer.status();
  return CountJobs(*answer);
}

}  // namespace contact::launcher
