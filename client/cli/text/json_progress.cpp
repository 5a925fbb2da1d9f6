#include "cli/text/json_progress.h"

#include <google/protobuf/util/message_differencer.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "cli/text/render_json.h"
#include "cli/text/render_progress.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kInterval = 100ms;

}  // namespace

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
    json["busy_with"] = progress.busy_with();
  }
  const std::optional<double> left = TimeToGo(done, elapsed_s);
  json["eta_s"] = left ? nlohmann::ordered_json(*left) : nlohmann::ordered_json();
  return EscapedJson(json.dump()) + "\n";
}

JsonProgress::JsonProgress(std::FILE* stream, std::string job)
    : stream_(stream), job_(std::move(job)) {}

JsonProgress::~JsonProgress() {
  if (pending_) Write(Clock::now());
}

void JsonProgress::Update(const v1::Progress& progress, Clock::time_point now) {
  if (progress.cells() == 0 && progress.end_time_s() <= 0)
    return;  // The length of the job is not known yet.
  if (last_ && google::protobuf::util::MessageDifferencer::Equals(*last_, progress)) return;
  last_ = pending_ = progress;
  if (!written_ || now - *written_ >= kInterval) Write(now);
}

void JsonProgress::Write(Clock::time_point now) {
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::fputs(ProgressJson(*pending_, job_, elapsed).c_str(), stream_);
  std::fflush(stream_);
  written_ = now;
  pending_.reset();
}

}  // namespace contact::cli
