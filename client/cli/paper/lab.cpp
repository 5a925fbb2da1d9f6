#include "cli/paper/lab.h"

#include <fmt/format.h>

namespace contact::cli {
namespace {

// Jobs in the queue of the server at once, well below the default limit of the queue.
constexpr std::size_t kBatch = 32;

}  // namespace

const std::vector<double>& Solved::operator[](const std::string& column) const {
  const SampleColumn* found = Find(column);
  if (found == nullptr) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("{} has no column {}", job.scenario().title(), column));
  }
  return found->values;
}

std::vector<v1::Cycle> Solved::Cycles(const std::string& contact) const {
  std::vector<v1::Cycle> cycles;
  for (const v1::Cycle& cycle : job.cycles()) {
    if (cycle.contact() == contact) cycles.push_back(cycle);
  }
  return cycles;
}

Data SampleData(const std::string& name, const std::vector<std::string>& columns,
                const std::vector<std::string>& headers, std::span<const Solved> runs) {
  Data data{name, {"time [s]"}, {}};
  if (runs.size() > 1) data.columns.insert(data.columns.begin(), "run");
  data.columns.insert(data.columns.end(), headers.begin(), headers.end());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (std::size_t i = 0; i < runs[run]["time"].size(); ++i) {
      std::vector<double>& row = data.rows.emplace_back();
      if (runs.size() > 1) row.push_back(static_cast<double>(run));
      row.push_back(runs[run]["time"][i]);
      for (const std::string& column : columns) row.push_back(runs[run][column][i]);
    }
  }
  return data;
}

std::vector<Solved> ServerLab::Solve(const std::vector<v1::Scenario>& scenarios) {
  std::vector<Solved> all;
  std::vector<std::string> waiting;
  const auto collect = [&] {
    for (const std::string& name : waiting) all.push_back(Collect(name));
    waiting.clear();
  };
  for (const v1::Scenario& scenario : scenarios) {
    waiting.push_back(Submit(scenario));
    if (waiting.size() == kBatch) collect();
  }
  collect();
  return all;
}

std::string ServerLab::Submit(const v1::Scenario& scenario) {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_scenario() = scenario;
  (*request.mutable_job()->mutable_labels())["made-by"] = "contactctl-paper";
  return client_.Call(&Client::Stub::CreateJob, request).name();
}

Solved ServerLab::Collect(const std::string& name) {
  Solved solved{ReadRecording(client_, name, settings_)};
  if (solved.job.state() != v1::Job::SUCCEEDED) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("{} ({}): {}", name, solved.job.scenario().title(),
                              solved.job.error().message()));
  }
  v1::DeleteJobRequest request;
  request.set_name(name);
  client_.Call(&Client::Stub::DeleteJob, request);
  solved.job.clear_name();  // The job is deleted: nobody could find it by its name.
  return solved;
}

}  // namespace contact::cli
