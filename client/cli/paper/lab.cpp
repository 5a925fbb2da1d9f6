#include "cli/paper/lab.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "cli/interrupt.h"
#include "cli/watch.h"

namespace contact::cli {
namespace {

// So many wait for a worker at once, below what any server's queue takes.
constexpr std::size_t kBatch = 32;

static_assert(std::endian::native == std::endian::little, "columns are little-endian");

class Frames : public WatchObserver {
 public:
  explicit Frames(Solved* solved) : solved_(solved) {}

  void OnEvent(const v1::Event& event) override {
    for (const v1::FrameChunk::Column& column : event.frame_chunk().columns()) {
      std::vector<double>& values = solved_->series[column.name()];
      const std::size_t old = values.size();
      values.resize(old + column.values().size() / sizeof(double));
      std::memcpy(values.data() + old, column.values().data(),
                  (values.size() - old) * sizeof(double));
    }
  }

 private:
  Solved* solved_;
};

}  // namespace

std::vector<v1::Cycle> Solved::Cycles(const std::string& contact) const {
  std::vector<v1::Cycle> cycles;
  for (const v1::Cycle& cycle : job.cycles()) {
    if (cycle.contact() == contact) cycles.push_back(cycle);
  }
  return cycles;
}

std::vector<Solved> Lab::Solve(const std::vector<v1::Scenario>& scenarios) {
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

std::string Lab::Submit(const v1::Scenario& scenario) {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_scenario() = scenario;
  (*request.mutable_job()->mutable_labels())["made-by"] = "contactctl-paper";
  return client_.Call(&Client::Stub::CreateJob, request).name();
}

Solved Lab::Collect(const std::string& name) {
  Solved solved;
  Frames frames(&solved);
  WatchOptions options;
  options.name = name;
  options.kinds = {"frame_chunk"};
  options.stopped = Interrupt::raised;
  if (Watch(client_, options, frames) != WatchEnd::kFinished) {
    throw Failure(ExitCode::kInterrupted, "interrupted; its jobs carry made-by=contactctl-paper");
  }
  v1::GetJobRequest get;
  get.set_name(name);
  solved.job = client_.Call(&Client::Stub::GetJob, get);
  if (solved.job.state() != v1::Job::SUCCEEDED) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("{} ({}): {}", name, solved.job.scenario().title(),
                              solved.job.error().message()));
  }
  v1::DeleteJobRequest request;
  request.set_name(name);
  client_.Call(&Client::Stub::DeleteJob, request);
  return solved;
}

}  // namespace contact::cli
