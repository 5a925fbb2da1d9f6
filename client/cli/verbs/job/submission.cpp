#include "cli/verbs/job/submission.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/base/scalar.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"

namespace contact::cli {
namespace {

google::protobuf::Duration Span(const std::string& text) {
  return google::protobuf::util::TimeUtil::MillisecondsToDuration(RequireDuration(text).count());
}

std::int64_t Steps(const std::string& text) {
  if (const auto steps = ParseInteger<std::int64_t>(text)) return *steps;
  throw Failure(ExitCode::kUsage, fmt::format("--budget-steps: '{}' is no whole number", text));
}

}  // namespace

void Submission::AddTo(CLI::App& command, std::string_view what) {
  Repeatable(
      command.add_option("--label", labels_, "Label of the job, to find it again; repeatable"))
      ->type_name("KEY=VALUE");
  command
      .add_option("--request-id", request_id_,
                  fmt::format("Submitting the same ID and {} again returns the same job", what))
      ->type_name("ID");
  command.add_option("--priority", priority_, "From -100 to 100; larger runs first. Default: 0")
      ->type_name("N");
  command.add_option("--budget-wall-time", wall_time_, "Stop it after such a time, as 10s or 2h")
      ->type_name("TIME");
  command.add_option("--budget-steps", steps_, "Stop it after so many integration steps")
      ->type_name("N");
  command
      .add_option("--budget-output", output_bytes_, "Stop it when it has recorded that, as 10MB")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("BYTES");
  command.add_option("--ttl", time_to_live_, "Delete it so long after its end, as 12h or 30d")
      ->type_name("TIME");
}

v1::CreateJobRequest Submission::Request() const {
  v1::CreateJobRequest request;
  request.set_request_id(request_id_.empty() ? RandomRequestId() : request_id_);
  v1::Job& job = *request.mutable_job();
  const auto labels = ParseLabels(labels_);
  job.mutable_labels()->insert(labels.begin(), labels.end());
  job.set_priority(priority_);
  if (!wall_time_.empty()) *job.mutable_budget()->mutable_wall_time() = Span(wall_time_);
  if (!steps_.empty()) job.mutable_budget()->set_steps(Steps(steps_));
  if (output_bytes_ > 0) {
    job.mutable_budget()->set_output_bytes(static_cast<std::int64_t>(output_bytes_));
  }
  if (!time_to_live_.empty()) *job.mutable_time_to_live() = Span(time_to_live_);
  return request;
}

}  // namespace contact::cli
