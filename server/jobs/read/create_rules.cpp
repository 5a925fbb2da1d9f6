#include "jobs/read/create_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>

#include "jobs/read/label_rules.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

// `span`, the field of Message with this number, must be 0, which leaves it to the server, or in
// the range that the contract states. Returns whether it is.
template <class Message>
bool CheckSpan(const char* name, int number, const google::protobuf::Duration& span,
               std::vector<Violation>* violations) {
  const auto& field = *Message::descriptor()->FindFieldByNumber(number);
  if (IsInRange(field, span) || (span.seconds() == 0 && span.nanos() == 0)) return true;
  violations->push_back({name,
                         fmt::format("is {} s and {} ns; must be {}, or 0 for the server's",
                                     span.seconds(), span.nanos(), RangeOf(field).text),
                         ""});
  return false;
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
  if (CheckSpan<v1::Budget>("budget.wall_time", v1::Budget::kWallTimeFieldNumber,
                            budget.wall_time(), violations)) {
    CheckAmount("budget.wall_time", Seconds(budget.wall_time()),
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
  const auto longest =
      RuleOf<v1::CreateJobRequest>(v1::CreateJobRequest::kRequestIdFieldNumber).max_characters();
  if (id.size() > static_cast<std::size_t>(longest) || !std::ranges::all_of(id, IsPrintable)) {
    violations.push_back(
        {"request_id", fmt::format("must be at most {} printable ASCII characters", longest), ""});
  }
  CheckLabels(request.job().labels(), &violations);
  Rules(&violations).Check<v1::Job>(v1::Job::kPriorityFieldNumber, request.job().priority());
  CheckBudget(request.job().budget(), max_budget, &violations);
  CheckSpan<v1::Job>("time_to_live", v1::Job::kTimeToLiveFieldNumber, request.job().time_to_live(),
                     &violations);
  if (request.job().spec_case() == v1::Job::SPEC_NOT_SET) {
    violations.push_back({"scenario", "is missing", "say what to compute"});
  }
  return violations;
}

}  // namespace contact
