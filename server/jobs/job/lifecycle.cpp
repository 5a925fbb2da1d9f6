#include "jobs/job/lifecycle.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <boost/core/demangle.hpp>
#include <cassert>
#include <exception>
#include <typeinfo>

namespace contact {
namespace {

void StampTime(v1::Job::State from, const google::protobuf::Timestamp& now, v1::Job* job) {
  if (from == v1::Job::STATE_UNSPECIFIED) *job->mutable_create_time() = now;
  if (job->state() == v1::Job::RUNNING) *job->mutable_start_time() = now;
  if (IsFinal(job->state())) *job->mutable_end_time() = now;
}

}  // namespace

Transition TransitionAfter(const Outcome& outcome) {
  switch (outcome.end) {
    case Outcome::End::kFinished:
      return {v1::Job::SUCCEEDED};
    case Outcome::End::kStopped:
      return {v1::Job::CANCELLED, reason::kUserRequest};
    case Outcome::End::kNumeric:
      return {v1::Job::FAILED, reason::kNumeric, outcome.message, absl::StatusCode::kOutOfRange};
    case Outcome::End::kBudgetSteps:
      return {v1::Job::FAILED, reason::kBudgetSteps, outcome.message,
              absl::StatusCode::kResourceExhausted};
    case Outcome::End::kNotConverged:
      return {v1::Job::FAILED, reason::kNotConverged, outcome.message, absl::StatusCode::kAborted};
  }
  return TransitionAfterFault("unknown outcome");
}

Transition TransitionAfterFault(const std::string& what) {
  return {v1::Job::FAILED, reason::kInternal, what, absl::StatusCode::kInternal};
}

Transition TransitionAfterException() {
  try {
    throw;
  } catch (const std::exception& error) {
    return TransitionAfterFault(
        fmt::format("{}: {}", boost::core::demangle(typeid(error).name()), error.what()));
  } catch (...) {
    return TransitionAfterFault("unknown exception");
  }
}

v1::Event Apply(const Transition& transition, std::chrono::system_clock::time_point now,
                v1::Job* job) {
  const v1::Job::State from = job->state();
  assert(IsTransition(from, transition.to));
  job->set_state(transition.to);
  job->set_state_reason(transition.state_reason);
  v1::Event event = EventAt(now);
  StampTime(from, event.event_time(), job);
  if (transition.to == v1::Job::FAILED) {
    job->mutable_error()->set_code(static_cast<int>(transition.code));
    job->mutable_error()->set_message(transition.message);
  }
  v1::StateChanged& changed = *event.mutable_state_changed();
  changed.set_state(transition.to);
  changed.set_state_reason(transition.state_reason);
  changed.set_message(transition.message);
  changed.set_convergence(job->convergence());
  spdlog::info("job={} state={} attempt={}{}{}{}{}", job->name(),
               v1::Job::State_Name(transition.to), job->attempt(),
               transition.state_reason.empty() ? "" : " reason=", transition.state_reason,
               transition.message.empty() ? "" : " message=", transition.message);
  return event;
}

google::protobuf::Timestamp ToTimestamp(std::chrono::system_clock::time_point time) {
  const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch());
  return google::protobuf::util::TimeUtil::NanosecondsToTimestamp(since.count());
}

v1::Event EventAt(std::chrono::system_clock::time_point now) {
  v1::Event event;
  *event.mutable_event_time() = ToTimestamp(now);
  return event;
}

}  // namespace contact
