#include "jobs/quota/quotas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>

namespace contact {
namespace {

using Q = v1::Quota;
using std::chrono::milliseconds;

// How a limit is told.
struct Words {
  v1::Quota::Resource resource;
  const char* what;
  const char* advice;
  // Time after which there may be some again; 0: only the principal can change that.
  milliseconds retry_after;
};
constexpr std::array kWords = std::to_array<Words>({
    {Q::UNFINISHED_JOBS, "jobs that wait or run", "wait for the end of some, or cancel them",
     milliseconds(1000)},
    {Q::CELLS, "cells of sweeps that wait or run",
     "wait for the end of sweeps, or make them smaller", milliseconds(1000)},
    {Q::STORED_BYTES, "bytes in the store", "delete jobs that nobody needs", milliseconds(0)},
    {Q::CREATE_CALLS, "CreateJob calls of late", "call less often, or make a sweep of the jobs",
     milliseconds(1000)},
    {Q::STREAMS, "open streams", "end some", milliseconds(1000)},
    {Q::CALLS, "open calls", "wait for their answers", milliseconds(1000)},
    {Q::CONNECTIONS, "connections with open calls", "make calls on one connection",
     milliseconds(1000)},
});

const Words& WordsOf(v1::Quota::Resource resource) {
  const auto found = std::ranges::find(kWords, resource, &Words::resource);
  assert(found != kWords.end());
  return *found;
}

// Names have no slash.
std::string NameOf(const JobOwner& whose) { return whose.tenant + '/' + whose.owner; }

}  // namespace

Quotas::Quotas(const OwnerLimits& limits, const Clock& clock)
    : limits_(limits), clock_(clock), creates_(limits.creates_per_second, limits.create_burst) {}

Quotas::Place Quotas::Write(const std::shared_ptr<Book>& book, const Key& key,
                            std::int64_t amount) {
  book->used[key] += amount;
  return {book.get(), [book, key, amount](const void*) {
            const MutexLock lock(book->mutex);
            if ((book->used[key] -= amount) == 0) book->used.erase(key);
          }};
}

Result<Quotas::Place> Quotas::Take(const JobOwner& whose, Resource resource, std::int64_t amount) {
  const Key key(NameOf(whose), resource);
  const std::int64_t limit = LimitOf(resource);
  const MutexLock lock(book_->mutex);
  const auto found = book_->used.find(key);
  const std::int64_t has = found == book_->used.end() ? 0 : found->second;
  if (limit > 0 && has + amount > limit) return Exceeded(whose, resource, has, amount);
  return Write(book_, key, amount);
}

Quotas::Place Quotas::Keep(const JobOwner& whose, Resource resource, std::int64_t amount) {
  const MutexLock lock(book_->mutex);
  return Write(book_, {NameOf(whose), resource}, amount);
}

Result<Quotas::Place> Quotas::TakeConnection(const JobOwner& whose, const std::string& uri) {
  const std::pair<std::string, std::string> name(NameOf(whose), uri);
  {
    const MutexLock lock(book_->mutex);
    const auto found = book_->connections.find(name);
    if (found != book_->connections.end()) {
      if (Place shared = found->second.lock()) return shared;
    }
  }
  Result<Place> taken = Take(whose, Q::CONNECTIONS);
  if (!taken.ok()) return taken.error();
  Place connection(book_.get(), [book = book_, name, taken = taken.value()](const void*) mutable {
    taken = nullptr;
    const MutexLock lock(book->mutex);
    const auto found = book->connections.find(name);
    if (found != book->connections.end() && found->second.expired()) book->connections.erase(found);
  });
  const MutexLock lock(book_->mutex);
  book_->connections[name] = connection;
  return connection;
}

Quotas::Place Quotas::Both(Place one, Place other) {
  return std::make_shared<const std::pair<Place, Place>>(std::move(one), std::move(other));
}

std::optional<Error> Quotas::TakeCreateCall(const JobOwner& whose) {
  const milliseconds wait = creates_.Take(NameOf(whose), clock_.Elapsed());
  if (wait.count() == 0) return std::nullopt;
  Error error = Exceeded(whose, Q::CREATE_CALLS, limits_.create_burst, 1);
  error.message += fmt::format("; {:g} a second are accepted, the next in {} ms",
                               limits_.creates_per_second, wait.count());
  error.retry_after = wait;
  return error;
}

std::int64_t Quotas::used(const JobOwner& whose, Resource resource) const {
  const MutexLock lock(book_->mutex);
  const auto found = book_->used.find({NameOf(whose), resource});
  return found == book_->used.end() ? 0 : found->second;
}

Error Quotas::Exceeded(const JobOwner& whose, Resource resource, std::int64_t used,
                       std::int64_t amount) const {
  const Words& words = WordsOf(resource);
  const std::int64_t limit = LimitOf(resource);
  Error error =
      MakeError(Reason::kQuotaExceeded,
                fmt::format("{} has {} {}{} and may have {}; {}", whose.owner, used, words.what,
                            amount > 1 ? fmt::format(", asks for {} more", amount) : "", limit,
                            words.advice));
  error.metadata = {{"principal", whose.owner},
                    {"resource", v1::Quota::Resource_Name(resource)},
                    {"limit", std::to_string(limit)},
                    {"used", std::to_string(used)}};
  error.retry_after = amount > limit ? milliseconds(0) : words.retry_after;
  return error;
}

std::int64_t Quotas::LimitOf(Resource resource) const {
  switch (resource) {
    case Q::UNFINISHED_JOBS:
      return limits_.unfinished_jobs;
    case Q::CELLS:
      return limits_.cells;
    case Q::STORED_BYTES:
      return limits_.stored_bytes;
    case Q::CREATE_CALLS:
      return limits_.creates_per_second > 0 ? limits_.create_burst : 0;
    case Q::STREAMS:
      return limits_.streams;
    case Q::CALLS:
      return limits_.calls;
    case Q::CONNECTIONS:
      return limits_.connections;
    default:
      return 0;
  }
}

std::vector<v1::Quota> Quotas::Of(const JobOwner& whose) const {
  const std::string name = NameOf(whose);
  std::vector<v1::Quota> quotas;
  for (const Words& words : kWords) {
    if (words.resource == Q::UNFINISHED_JOBS || words.resource == Q::CELLS ||
        words.resource == Q::STORED_BYTES) {
      continue;
    }
    v1::Quota& quota = quotas.emplace_back();
    quota.set_resource(words.resource);
    quota.set_limit(LimitOf(words.resource));
    if (words.resource == Q::CREATE_CALLS) {
      quota.set_per_second(limits_.creates_per_second);
      quota.set_used(std::llround(std::ceil(creates_.TakenBy(name, clock_.Elapsed()))));
      continue;
    }
    const MutexLock lock(book_->mutex);
    const auto found = book_->used.find({name, words.resource});
    if (found != book_->used.end()) quota.set_used(found->second);
  }
  return quotas;
}

}  // namespace contact
