#include "jobs/read/list_rules.h"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "jobs/read/label_rules.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

void CheckPrefix(const std::string& prefix, std::vector<Violation>* violations) {
  const int most =
      RuleOf<v1::ListJobsRequest>(v1::ListJobsRequest::kNamePrefixFieldNumber).max_characters();
  if (prefix.size() <= static_cast<std::size_t>(most)) return;
  violations->push_back({"name_prefix", fmt::format("has more than {} characters", most), ""});
}

}  // namespace

Result<JobQuery> ToQuery(const v1::ListJobsRequest& request, std::int64_t before) {
  std::vector<Violation> violations;
  JobQuery query;
  const int page_size = v1::ListJobsRequest::kPageSizeFieldNumber;
  Rules(&violations).Check<v1::ListJobsRequest>(page_size, request.page_size());
  query.limit = request.page_size();
  if (query.limit == 0) {
    query.limit = static_cast<int>(RuleOf<v1::ListJobsRequest>(page_size).default_number());
  }
  query.before = before;
  if (query.before < 0) {
    violations.push_back({"page_token", "is none that this server gave", "start without a token"});
  }
  const std::set<int> states(request.states().begin(), request.states().end());
  query.states.assign(states.begin(), states.end());
  for (const int state : states) {
    if (v1::Job::State_IsValid(state) && state != v1::Job::STATE_UNSPECIFIED) continue;
    violations.push_back({"states", fmt::format("{} is no state", state), ""});
    break;  // There may be millions.
  }
  CheckPrefix(request.name_prefix(), &violations);
  query.name_prefix = request.name_prefix();
  CheckLabels(request.labels(), &violations);
  query.labels = {request.labels().begin(), request.labels().end()};
  if (!violations.empty()) return Invalid(std::move(violations));
  return query;
}

}  // namespace contact
