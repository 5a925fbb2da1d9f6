#include "jobs/read/watch_rules.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "jobs/read/list_rules.h"
#include "wire/rules/field_rule.h"

namespace contact {
namespace {

// The set of kinds, state_changed among them; all if there are none.
std::uint32_t KindSet(const v1::WatchJobRequest& request, std::vector<Violation>* violations) {
  if (request.kinds().empty()) return ~0U;
  std::uint32_t set = KindBit(v1::Event::kStateChanged);
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (const std::string& kind : request.kinds()) {
    const auto* field = v1::Event::descriptor()->FindFieldByName(kind);
    if (field != nullptr && field->containing_oneof() == &payload) {
      set |= 1U << field->number();
      continue;
    }
    violations->push_back({"kinds", fmt::format("'{}' is no kind of event", kind.substr(0, 64)),
                           "name a field of Event.payload, such as cycle"});
    break;  // There may be millions.
  }
  return set;
}

// `interval`, the field of Message with this number, which must be in the range that the contract
// states.
template <class Message>
std::chrono::milliseconds Interval(const std::string& name, int number,
                                   const google::protobuf::Duration& interval,
                                   std::vector<Violation>* violations) {
  const auto& field = *Message::descriptor()->FindFieldByNumber(number);
  if (!IsInRange(field, interval)) {
    violations->push_back({name, "must be " + RangeOf(field).text, ""});
    return {};
  }
  return std::chrono::milliseconds{interval.seconds() * 1000 + interval.nanos() / 1'000'000};
}

template <class Request>
std::chrono::milliseconds BookmarkInterval(const Request& request,
                                           std::vector<Violation>* violations) {
  const int number = Request::kBookmarkIntervalFieldNumber;
  if (!request.has_bookmark_interval()) {
    return std::chrono::seconds(
        static_cast<std::int64_t>(RuleOf<Request>(number).default_number()));
  }
  return Interval<Request>("bookmark_interval", number, request.bookmark_interval(), violations);
}

}  // namespace

Result<WatchRules> ToRules(const v1::WatchJobRequest& request) {
  std::vector<Violation> violations;
  WatchRules rules;
  rules.kinds = KindSet(request, &violations);
  rules.bookmark_interval = BookmarkInterval(request, &violations);
  const v1::DeliveryOptions& delivery = request.delivery();
  if (delivery.has_min_frame_interval()) {
    rules.delivery.min_frame_interval = Interval<v1::DeliveryOptions>(
        "delivery.min_frame_interval", v1::DeliveryOptions::kMinFrameIntervalFieldNumber,
        delivery.min_frame_interval(), &violations);
  }
  if (!v1::DeliveryOptions::OverflowPolicy_IsValid(delivery.overflow())) {
    violations.push_back({"delivery.overflow", "is neither CONFLATE nor DISCONNECT nor LAG", ""});
  } else if (delivery.overflow() != v1::DeliveryOptions::OVERFLOW_POLICY_UNSPECIFIED) {
    rules.delivery.overflow = delivery.overflow();
  }
  if (request.live_only() && request.after_sequence() > 0) {
    violations.push_back(
        {"live_only", "goes only with after_sequence 0", "to resume, leave it out"});
  }
  if (!violations.empty()) return Invalid(std::move(violations));
  return rules;
}

Result<JobsCursor::Rules> ToRules(const v1::WatchJobsRequest& request) {
  v1::ListJobsRequest list;
  *list.mutable_states() = request.states();
  *list.mutable_labels() = request.labels();
  Result<JobQuery> filter = ToQuery(list);
  if (!filter.ok()) return filter.error();
  std::vector<Violation> violations;
  JobsCursor::Rules rules{std::move(filter.value()), BookmarkInterval(request, &violations)};
  if (!violations.empty()) return Invalid(std::move(violations));
  return rules;
}

}  // namespace contact
