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

/// The moves that the life of a job consists of: [from][to], in the order of Job.State.
inline constexpr std::array<std::array<bool, 6>, 6> kMayMove = {{
    // UNSPECIFIED, QUEUED, RUNNING, SUCCEEDED, FAILED, CANCELLED
    {false, true, false, false, false, false},  // Not stored yet: it is accepted.
    {false, false, true, false, false, true},   // QUEUED: a worker takes it, or it is cancelled.
    {false, true, false, true, true, true},     // RUNNING: it loses its worker, or it ends.
    {},                                         // SUCCEEDED
    {},                                         // FAILED
    {},                                         // CANCELLED
}};

constexpr bool MayMove(v1::Job::State from, v1::Job::State to) {
  return kMayMove[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)];
}

constexpr bool IsFinal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

/// Why a job is in its state; see Job.state_reason.
namespace reason {
inline constexpr char kWaitingForWorker[] = "WAITING_FOR_WORKER";
inline constexpr char kServerRestarted[] = "SERVER_RESTARTED";
inline constexpr char kUserRequest[] = "USER_REQUEST";
inline constexpr char kNumeric[] = "NUMERIC";
inline constexpr char kNotConverged[] = "NOT_CONVERGED";
inline constexpr char kBudgetSteps[] = "BUDGET_STEPS";
inline constexpr char kBudgetWallTime[] = "BUDGET_WALL_TIME";
inline constexpr char kBudgetOutput[] = "BUDGET_OUTPUT";
inline constexpr char kStalled[] = "STALLED";
inline constexpr char kCrashed[] = "CRASHED";
inline constexpr char kInternal[] = "INTERNAL";
}  // namespace reason

/// A state to go to, and why.
struct Move {
  v1::Job::State to;
  std::string state_reason = {};
  std::string message = {};                       ///< For people; may be empty.
  absl::StatusCode code = absl::StatusCode::kOk;  ///< Of Job.error, for FAILED.
};

/// What becomes of a job whose run ended so. A stopped one was stopped by its user.
Move MoveAfter(const Outcome& outcome);
/// What becomes of a job whose run could not be made at all.
Move MoveAfterFault(const std::string& what);
/// What becomes of a job whose run threw what is being caught: a fault, with class and message.
Move MoveAfterException();

/// Moves a job, stamps its times, writes one line to the log and returns the event that tells it.
v1::Event Apply(const Move& move, std::chrono::system_clock::time_point now, v1::Job* job);

google::protobuf::Timestamp ToTimestamp(std::chrono::system_clock::time_point time);

/// An event of this time, still without payload.
v1::Event EventAt(std::chrono::system_clock::time_point now);

}  // namespace contact
