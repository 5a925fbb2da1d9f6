#include "cli/text/render_progress.h"

#include <fmt/format.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/style.h"
#include "cli/text/render_json.h"

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

double PartDone(const v1::Progress& progress) {
  if (progress.cells() > 0) return static_cast<double>(progress.cells_done()) / progress.cells();
  if (progress.end_time_s() <= 0) return 0;
  return std::clamp(progress.time_s() / progress.end_time_s(), 0.0, 1.0);
}

std::optional<double> TimeToGo(double part_done, double elapsed_s) {
  if (part_done <= 0.01) return std::nullopt;
  return elapsed_s * (1 - part_done) / part_done;
}

std::string TimeLeft(double part_done, double elapsed_s) {
  const std::optional<double> left = TimeToGo(part_done, elapsed_s);
  return left ? fmt::format(", {} left", Seconds(*left)) : "";
}

std::string ProgressWords(const v1::Progress& progress, double elapsed_s) {
  const double done = PartDone(progress);
  const std::string& busy = progress.busy_with();
  return fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s, {}, {}{}{}", 100 * done, progress.time_s(),
                     progress.end_time_s(), Count(progress.cycles(), "cycle", "cycles"),
                     Count(progress.iterations(), "iteration", "iterations"),
                     TimeLeft(done, elapsed_s), busy.empty() ? "" : "; busy: " + OneLine(busy));
}

std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width, bool utf8) {
  constexpr int kBar = 24;
  const int filled = static_cast<int>(std::lround(PartDone(progress) * kBar));
  std::string bar;
  for (int i = 0; i < kBar; ++i) bar += i < filled ? (utf8 ? "━" : "#") : (utf8 ? "─" : "-");
  const std::string words = ProgressWords(progress, elapsed_s);
  if (width <= 0 || Width(words) + kBar + 1 <= width) return bar + " " + words;
  return Cut(words, width);
}

}  // namespace contact::cli
