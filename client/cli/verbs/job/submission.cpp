#include "cli/verbs/job/submission.h"

#include <fmt/format.h>

#include "cli/link/jobs.h"
#include "cli/verbs/job/options.h"

namespace contact::cli {

void Submission::AddTo(CLI::App& command, std::string_view what) {
  Repeatable(
      command.add_option("--label", labels_, "Label of the job, to find it again; repeatable"))
      ->type_name("KEY=VALUE");
  command
      .add_option("--request-id", request_id_,
                  fmt::format("Submitting the same ID and {} again returns the same job", what))
      ->type_name("ID");
  options_.AddTo(command);
}

v1::CreateJobRequest Submission::Request() const {
  v1::CreateJobRequest request;
  request.set_request_id(request_id_.empty() ? RandomRequestId() : request_id_);
  const auto labels = ParseLabels(labels_);
  request.mutable_job()->mutable_labels()->insert(labels.begin(), labels.end());
  options_.Apply(request.mutable_job());
  return request;
}

}  // namespace contact::cli
