#include "jobs/read/request_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "jobs/job/job_errors.h"

namespace contact {
namespace {

constexpr int kMaxLabels = 16;
constexpr std::size_t kMaxLabelLength = 63;
constexpr std::size_t kMaxRequestIdLength = 64;
constexpr int kMaxPriority = 100;
constexpr std::size_t kMaxViolations = 100;
constexpr int kDefaultPageSize = 50;
constexpr int kMaxPageSize = 1000;
constexpr std::chrono::milliseconds kDefaultBookmarkInterval{10'000};

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

Error FieldInvalid(std::vector<Violation> violations) {
  Error error{absl::StatusCode::kInvalidArgument, "FIELD_INVALID"};
  const Violation& first = violations.front();
  error.message = first.field + ": " + first.description;
  error.violations = std::move(violations);
  return error;
}

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

// Whether an interval has a length that is allowed: from so many seconds to an hour.
struct IntervalRange {
  std::int64_t least_s;
  const char* text;
};
std::chrono::milliseconds Interval(const std::string& field,
                                   const google::protobuf::Duration& interval,
                                   const IntervalRange& range, std::vector<Violation>* violations) {
  constexpr std::int64_t kMostNanos = 999'999'999;
  if (interval.seconds() < range.least_s || interval.nanos() < 0 || interval.nanos() > kMostNanos ||
      interval.seconds() > 3600 || (interval.seconds() == 3600 && interval.nanos() > 0)) {
    violations->push_back({field, fmt::format("must be in {}", range.text), ""});
    return {};
  }
  return std::chrono::milliseconds{interval.seconds() * 1000 + interval.nanos() / 1'000'000};
}

template <class Request>
std::chrono::milliseconds BookmarkInterval(const Request& request,
                                           std::vector<Violation>* violations) {
  if (!request.has_bookmark_interval()) return kDefaultBookmarkInterval;
  return Interval("bookmark_interval", request.bookmark_interval(), {1, "[1 s, 1 h]"}, violations);
}

// The number that PageToken has written; negative if it did not write this.
std::int64_t NumberOf(const std::string& token) {
  std::int64_t number = 0;
  const char* const end = token.data() + token.size();
  const auto [rest, error] = std::from_chars(token.data(), end, number);
  return error == std::errc() && rest == end && PageToken(number) == token ? number : -1;
}

// Bytes of values in an answer: a client takes 4 MiB unless it says otherwise.
constexpr std::size_t kMaxSeriesBytes = 4'000'000;
constexpr std::size_t kDefaultPoints = 1000;

using Columns = std::vector<v1::FrameChunk::Column>;

std::string ChannelHint(const std::string& name, const Columns& channels) {
  std::vector<std::string_view> names;
  for (const auto& channel : channels) names.push_back(channel.name());
  return DidYouMean(name, names, fmt::format("channels are {}", fmt::join(names, ", ")));
}

// The time and the channels asked for, each once.
std::vector<int> SelectColumns(const v1::GetSeriesRequest& request, const Columns& channels,
                               std::vector<Violation>* violations) {
  std::vector<int> columns = {0};
  const auto select = [&columns](int column) {
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
  };
  std::map<std::string_view, int> places;
  for (const auto& channel : channels) {
    places.emplace(channel.name(), static_cast<int>(places.size()));
  }
  for (int i = 0; i < request.channels_size() && violations->size() < kMaxViolations; ++i) {
    const std::string& name = request.channels(i);
    if (const auto place = places.find(name); place != places.end()) {
      select(place->second);
    } else {
      violations->push_back({fmt::format("channels[{}]", i),
                             fmt::format("{} is no channel of this job", Quoted(name)),
                             ChannelHint(name, channels)});
    }
  }
  if (!request.channels().empty()) return columns;
  columns.resize(channels.size());
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

void CheckTimes(const v1::GetSeriesRequest& request, std::vector<Violation>* violations) {
  if (std::isnan(request.start_time_s())) violations->push_back({"start_time_s", "is nan", ""});
  if (std::isnan(request.end_time_s())) violations->push_back({"end_time_s", "is nan", ""});
  if (request.has_start_time_s() && request.has_end_time_s() &&
      request.start_time_s() > request.end_time_s()) {
    violations->push_back({"end_time_s",
                           fmt::format("is {}, which is before start_time_s, {}",
                                       request.end_time_s(), request.start_time_s()),
                           ""});
  }
}

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

Result<WatchRules> ToRules(const v1::WatchJobRequest& request) {
  std::vector<Violation> violations;
  WatchRules rules;
  rules.kinds = KindSet(request, &violations);
  rules.bookmark_interval = BookmarkInterval(request, &violations);
  const v1::DeliveryOptions& delivery = request.delivery();
  if (delivery.has_min_frame_interval()) {
    rules.delivery.min_frame_interval = Interval(
        "delivery.min_frame_interval", delivery.min_frame_interval(), {0, "[0, 1 h]"}, &violations);
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
  if (!violations.empty()) return FieldInvalid(std::move(violations));
  return rules;
}

Result<JobsRules> ToRules(const v1::WatchJobsRequest& request) {
  v1::ListJobsRequest list;
  *list.mutable_states() = request.states();
  *list.mutable_labels() = request.labels();
  Result<JobQuery> filter = ToQuery(list);
  if (!filter.ok()) return filter.error();
  std::vector<Violation> violations;
  JobsRules rules{std::move(filter.value()), BookmarkInterval(request, &violations)};
  if (!violations.empty()) return FieldInvalid(std::move(violations));
  return rules;
}

Result<SeriesSelection> ToSelection(const v1::GetSeriesRequest& request, const Columns& channels) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  std::vector<Violation> violations;
  SeriesSelection selection;
  selection.columns = SelectColumns(request, channels, &violations);
  selection.start_time = request.has_start_time_s() ? request.start_time_s() : -kEver;
  selection.end_time = request.has_end_time_s() ? request.end_time_s() : kEver;
  CheckTimes(request, &violations);
  if (!v1::GetSeriesRequest::Decimation_IsValid(request.decimation())) {
    violations.push_back({"decimation", "is neither MINMAX nor RAW", ""});
  }
  selection.raw = request.decimation() == v1::GetSeriesRequest::RAW;
  const std::size_t least = selection.raw ? 1 : 2 * selection.columns.size();
  const std::size_t most = kMaxSeriesBytes / sizeof(double) / selection.columns.size();
  if (request.max_points() < 0 ||
      (request.max_points() > 0 && static_cast<std::size_t>(request.max_points()) < least)) {
    violations.push_back({"max_points",
                          fmt::format("is {}; must be at least {} for {} channels",
                                      request.max_points(), least, selection.columns.size() - 1),
                          "ask for more points, or fewer channels"});
  }
  if (!violations.empty()) return FieldInvalid(std::move(violations));
  if (least > most) return SeriesTooLarge(most);
  const std::size_t points = selection.raw ? most : std::max(least, kDefaultPoints);
  selection.max_rows = std::min(
      most, request.max_points() > 0 ? static_cast<std::size_t>(request.max_points()) : points);
  return selection;
}

}  // namespace contact
