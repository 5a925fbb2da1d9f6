#include "jobs/request_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <utility>

namespace contact {
namespace {

constexpr int kMaxLabels = 16;
constexpr std::size_t kMaxLabelLength = 63;
constexpr std::size_t kMaxRequestIdLength = 64;
constexpr int kDefaultPageSize = 50;
constexpr int kMaxPageSize = 1000;

bool IsLabelCharacter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '.' || c == '-';
}

bool IsLabelText(const std::string& text) {
  return text.size() <= kMaxLabelLength && std::all_of(text.begin(), text.end(), IsLabelCharacter);
}

template <class Labels>
void CheckLabels(const Labels& labels, std::vector<Violation>* violations) {
  if (labels.size() > kMaxLabels) {
    violations->push_back(
        {"labels", fmt::format("has {} entries; must have at most {}", labels.size(), kMaxLabels),
         ""});
  }
  for (const auto& [key, value] : labels) {
    if (!key.empty() && IsLabelText(key) && IsLabelText(value)) continue;
    violations->push_back({fmt::format("labels[{}]", key.substr(0, kMaxLabelLength)),
                           "key and value must be at most 63 letters, digits, '_', '.' and '-', "
                           "and the key not empty",
                           ""});
    if (violations->size() > kMaxLabels) return;
  }
}

bool IsPrintable(char c) { return c >= ' ' && c <= '~'; }

Error FieldInvalid(std::vector<Violation> violations) {
  Error error{absl::StatusCode::kInvalidArgument, "FIELD_INVALID"};
  const Violation& first = violations.front();
  error.message = first.field + ": " + first.description;
  error.violations = std::move(violations);
  return error;
}

// The number that PageToken has written; negative if it did not write this.
std::int64_t NumberOf(const std::string& token) {
  std::int64_t number = 0;
  const char* const end = token.data() + token.size();
  const auto [rest, error] = std::from_chars(token.data(), end, number);
  return error == std::errc() && rest == end && PageToken(number) == token ? number : -1;
}

}  // namespace

std::vector<Violation> CheckCreate(const v1::CreateJobRequest& request) {
  std::vector<Violation> violations;
  const std::string& id = request.request_id();
  if (id.size() > kMaxRequestIdLength || !std::all_of(id.begin(), id.end(), IsPrintable)) {
    violations.push_back({"request_id", "must be at most 64 printable ASCII characters", ""});
  }
  CheckLabels(request.job().labels(), &violations);
  if (!request.job().has_scenario()) {
    violations.push_back({"scenario", "is missing", "say what to compute"});
  }
  return violations;
}

Result<JobQuery> ToQuery(const v1::ListJobsRequest& request) {
  std::vector<Violation> violations;
  JobQuery query;
  query.limit = request.page_size() == 0 ? kDefaultPageSize : request.page_size();
  if (query.limit < 0 || query.limit > kMaxPageSize) {
    violations.push_back(
        {"page_size", fmt::format("is {}; must be in [0, {}]", request.page_size(), kMaxPageSize),
         ""});
  }
  if (!request.page_token().empty()) query.before = NumberOf(request.page_token());
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
  CheckLabels(request.labels(), &violations);
  query.labels.assign(request.labels().begin(), request.labels().end());
  if (!violations.empty()) return FieldInvalid(std::move(violations));
  return query;
}

std::string PageToken(std::int64_t number) { return number > 0 ? fmt::format("{}", number) : ""; }

Result<std::uint32_t> KindSet(const std::vector<std::string>& kinds) {
  if (kinds.empty()) return ~0U;
  std::uint32_t set = KindBit(v1::Event::kStateChanged);
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (const std::string& kind : kinds) {
    const auto* field = v1::Event::descriptor()->FindFieldByName(kind);
    if (field == nullptr || field->containing_oneof() != &payload) {
      return FieldInvalid({{"kinds", fmt::format("'{}' is no kind of event", kind.substr(0, 64)),
                            "name a field of Event.payload, such as cycle"}});
    }
    set |= 1U << field->number();
  }
  return set;
}

}  // namespace contact
