#pragma once

#include <absl/status/status.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "simulation/model/ledger.h"

namespace contact {

/// The transitions that a job may make: [from][to], in the order of Job.State.
inline constexpr std::array<std::array<bool, 6>, 6> kTransitions = {{
    // UNSPECIFIED, QUEUED, RUNNING, SUCCEEDED, FAILED, CANCELLED
    {false, true, false, false, false, false},  // Not stored yet: it is accepted.
    {false, false, true, false, false, true},   // QUEUED: a worker takes it, or it is cancelled.
    {false, true, false, true, true, true},     // RUNNING: it loses its worker, or it ends.
    {},                                         // SUCCEEDED
    {},                                         // FAILED
    {},                                         // CANCELLED
}};

/// True if a job may go from one state to the other.
constexpr bool IsTransition(v1::Job::State from, v1::Job::State to) {
  return kTransitions[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)];
}

/// True if a job in this state has ended: no transition leaves the state.
constexpr bool IsFinal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

/// The values of Job.state_reason: why a job is in its state. Reasons of failed calls are in
/// errors.h.
namespace reason {
inline constexpr char kWaitingForWorker[] = "WAITING_FOR_WORKER";
inline constexpr char kServerRestarted[] = "SERVER_RESTARTED";
inline constexpr char kUserRequest[] = "USER_REQUEST";
inline constexpr char kNumeric[] = "NUMERIC";
inline constexpr char kNotConverged[] = "NOT_CONVERGED";
inline constexpr char kBudgetSteps[] = "BUDGET_STEPS";
inline constexpr char kBudgetWallTime[] = "BUDGET_WALL_TIME";
inline constexpr char kBudgetOutput[] = "BUDGET_OUTPUT";
inline constexpr char kBudgetMemory[] = "BUDGET_MEMORY";
inline constexpr char kStalled[] = "STALLED";
inline constexpr char kCrashed[] = "CRASHED";
inline constexpr char kInternal[] = "INTERNAL";
}  // namespace reason

/// The state that a job enters next, and why.
struct Transition {
  /// The next state.
  v1::Job::State to;
  /// A value of `reason`; empty for SUCCEEDED and RUNNING.
  std::string state_reason = {};
  /// The words for people; may be empty.
  std::string message = {};
  /// Code of Job.error. Only for FAILED.
  absl::StatusCode code = absl::StatusCode::kOk;
};

/// The transition of a job whose run has ended. A run that was stopped counts as cancelled by the
/// user.
Transition TransitionAfter(const Outcome& outcome);
/// The transition of a job that could not be run at all; `what` says why, for people.
Transition TransitionAfterFault(const std::string& what);
/// The transition of a job whose run threw an exception. To be called from within the handler that
/// caught it; class and text of the exception become the message.
Transition TransitionAfterException();

/// Puts the job into its next state at the time `now`: sets its times, writes one line to the log,
/// and returns the state_changed event. The transition must be one of kTransitions.
v1::Event Apply(const Transition& transition, std::chrono::system_clock::time_point now,
                v1::Job* job);

/// The time as the contract has it, to the nanosecond.
google::protobuf::Timestamp ToTimestamp(std::chrono::system_clock::time_point time);

/// An event with this time and without payload.
v1::Event EventAt(std::chrono::system_clock::time_point now);

}  // namespace contact
