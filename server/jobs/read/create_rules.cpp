#include "jobs/read/create_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "jobs/read/label_rules.h"

namespace contact {
namespace {

constexpr std::size_t kMaxRequestIdLength = 64;
constexpr int kMaxPriority = 100;

// Well-formed, and at least 0 or `least`, whichever the field says is nothing.
bool IsSpan(const google::protobuf::Duration& span, std::int64_t least_ms) {
  constexpr std::int64_t kCenturySeconds = 100LL * 366 * 24 * 3600;
  if (span.seconds() < 0 || span.seconds() > kCenturySeconds) return false;
  if (span.nanos() < 0 || span.nanos() >= 1'000'000'000) return false;
  const std::int64_t milliseconds = span.seconds() * 1000 + span.nanos() / 1'000'000;
  return milliseconds >= least_ms || (span.seconds() == 0 && span.nanos() == 0);
}

void CheckSpan(const char* field, const google::protobuf::Duration& span, std::int64_t least_ms,
               const char* range, std::vector<Violation>* violations) {
  if (IsSpan(span, least_ms)) return;
  violations->push_back({field,
                         fmt::format("is {} s and {} ns; must be in {}, or 0 for the server's",
                                     span.seconds(), span.nanos(), range),
                         ""});
}

// `limit`: of the server; 0: none.
void CheckAmount(const char* field, double amount, double limit, const char* unit,
                 std::vector<Violation>* violations) {
  if (amount < 0) {
    violations->push_back({field, fmt::format("is {}; must not be negative", amount), ""});
  } else if (limit > 0 && amount > limit) {
    violations->push_back({field,
                           fmt::format("is {}{}; must be at most {}{}, the server's limit", amount,
                                       unit, limit, unit),
                           "ask for less, or leave it out to get the limit"});
  }
}

void CheckBudget(const v1::Budget& budget, const RunBudget& most,
                 std::vector<Violation>* violations) {
  const google::protobuf::Duration& wall_time = budget.wall_time();
  CheckSpan("budget.wall_time", wall_time, 1, "[1 ms, 100 years]", violations);
  if (IsSpan(wall_time, 1)) {
    CheckAmount("budget.wall_time",
                static_cast<double>(wall_time.seconds()) + wall_time.nanos() / 1e9,
                std::chrono::duration<double>(most.wall_time).count(), " s", violations);
  }
  CheckAmount("budget.steps", static_cast<double>(budget.steps()), static_cast<double>(most.steps),
              "", violations);
  CheckAmount("budget.output_bytes", static_cast<double>(budget.output_bytes()),
              static_cast<double>(most.output_bytes), " bytes", violations);
}

bool IsPrintable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace

std::vector<Violation> CheckCreate(const v1::CreateJobRequest& request,
                                   const RunBudget& max_budget) {
  std::vector<Violation> violations;
  const std::string& id = request.request_id();
  if (id.size() > kMaxRequestIdLength || !std::all_of(id.begin(), id.end(), IsPrintable)) {
    violations.push_back({"request_id", "must be at most 64 printable ASCII characters", ""});
  }
  CheckLabels(request.job().labels(), &violations);
  const std::int32_t priority = request.job().priority();
  if (priority < -kMaxPriority || priority > kMaxPriority) {
    violations.push_back(
        {"priority",
         fmt::format("is {}; must be in [-{}, {}]", priority, kMaxPriority, kMaxPriority), ""});
  }
  CheckBudget(request.job().budget(), max_budget, &violations);
  CheckSpan("time_to_live", request.job().time_to_live(), 1000, "[1 s, 100 years]", &violations);
  if (request.job().spec_case() == v1::Job::SPEC_NOT_SET) {
    violations.push_back({"scenario", "is missing", "say what to compute"});
  }
  return violations;
}

}  // namespace contact
