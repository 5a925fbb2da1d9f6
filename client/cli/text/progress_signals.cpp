#include "cli/text/progress_signals.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kInterval = 100ms;

}  // namespace

double PartDone(const v1::Progress& progress) {
  if (progress.cells() > 0) return static_cast<double>(progress.cells_done()) / progress.cells();
  if (progress.end_time_s() <= 0) return 0;
  return std::clamp(progress.time_s() / progress.end_time_s(), 0.0, 1.0);
}

std::optional<double> TimeToGo(double part_done, double elapsed_s) {
  if (part_done <= 0.01) return std::nullopt;
  return elapsed_s * (1 - part_done) / part_done;
}

std::string ProgressJson(const v1::Progress& progress, const std::string& job, double elapsed_s) {
  const double done = PartDone(progress);
  nlohmann::ordered_json json;
  json["kind"] = progress.cells() > 0 ? "sweep" : "run";
  json["job"] = job;
  json["done"] = done;
  if (progress.cells() > 0) {
    json["cells"] = progress.cells();
    json["cells_done"] = progress.cells_done();
    json["cells_failed"] = progress.cells_failed();
    json["cells_not_converged"] = progress.cells_not_converged();
  } else {
    json["time_s"] = progress.time_s();
    json["end_time_s"] = progress.end_time_s();
    json["steps"] = progress.steps();
    json["cycles"] = progress.cycles();
    json["iterations"] = progress.iterations();
  }
  const std::optional<double> left = TimeToGo(done, elapsed_s);
  json["eta_s"] = left ? nlohmann::ordered_json(*left) : nlohmann::ordered_json();
  return json.dump() + "\n";
}

ProgressSignals::ProgressSignals(std::FILE* stream, std::string job)
    : stream_(stream), job_(std::move(job)) {}

ProgressSignals::~ProgressSignals() {
  if (untold_) Tell(Clock::now());
}

void ProgressSignals::Hear(const v1::Progress& progress, Clock::time_point now) {
  if (progress.cells() == 0 && progress.end_time_s() <= 0) return;  // Nothing is known yet.
  if (last_ && google::protobuf::util::MessageDifferencer::Equals(*last_, progress)) return;
  last_ = untold_ = progress;
  if (!told_ || now - *told_ >= kInterval) Tell(now);
}

void ProgressSignals::Tell(Clock::time_point now) {
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::fputs(ProgressJson(*untold_, job_, elapsed).c_str(), stream_);
  std::fflush(stream_);
  told_ = now;
  untold_.reset();
}

}  // namespace contact::cli
