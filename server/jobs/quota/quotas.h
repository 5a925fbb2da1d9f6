#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/job/errors.h"
#include "jobs/job/job_options.h"
#include "jobs/quota/rate_limit.h"
#include "storage/records.h"

namespace contact {

/// The one place that knows what each principal has of what all share, and refuses more than its
/// limits allow. Principals of the same name in two tenants are two. Thread-safe.
class Quotas {
 public:
  using Resource = v1::Quota::Resource;
  /// Something that a principal has. It is given back once the last copy is destroyed, which may be
  /// after the Quotas themselves.
  using Place = std::shared_ptr<const void>;

  /// `clock` outlives the quotas.
  Quotas(const OwnerLimits& limits, const Clock& clock);

  /// Takes so much of UNFINISHED_JOBS, CELLS, STREAMS or CALLS. QUOTA_EXCEEDED: the principal would
  /// have more than it may.
  Result<Place> Take(const JobOwner& whose, Resource resource, std::int64_t amount = 1);
  /// As Take, whatever the limit is: for jobs that were accepted before this start of the server.
  Place Keep(const JobOwner& whose, Resource resource, std::int64_t amount = 1);
  /// As Take, of CONNECTIONS; calls on the connection `uri` share its place.
  Result<Place> TakeConnection(const JobOwner& whose, const std::string& uri);
  /// Counts a CreateJob call. QUOTA_EXCEEDED, with the time to wait: there were too many of late.
  std::optional<Error> TakeCreateCall(const JobOwner& whose);

  /// The error of one who has `used` and asks for `amount` more.
  Error Exceeded(const JobOwner& whose, Resource resource, std::int64_t used,
                 std::int64_t amount) const;
  /// What the principal has of a resource.
  std::int64_t used(const JobOwner& whose, Resource resource) const;
  /// What the jobs of one owner may take; 0: any number of bytes.
  std::int64_t max_stored_bytes() const { return limits_.stored_bytes; }

  /// The limits of the principal and what it has, of each resource that no job takes.
  std::vector<v1::Quota> Of(const JobOwner& whose) const;

  /// A place that is both.
  static Place Both(Place one, Place other);

 private:
  /// A resource of a principal.
  using Key = std::pair<std::string, Resource>;
  /// What they have. Shared with the places, which give it back.
  struct Book {
    Mutex mutex;
    /// None is 0.
    std::map<Key, std::int64_t> used ABSL_GUARDED_BY(mutex);
    /// By principal and address.
    std::map<std::pair<std::string, std::string>, std::weak_ptr<const void>> connections
        ABSL_GUARDED_BY(mutex);
  };

  /// Books so much as used, until the place goes.
  static Place Write(const std::shared_ptr<Book>& book, const Key& key, std::int64_t amount)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(book->mutex);
  std::int64_t LimitOf(Resource resource) const;

  const OwnerLimits limits_;
  const Clock& clock_;
  const std::shared_ptr<Book> book_ = std::make_shared<Book>();
  /// Of CreateJob calls, by principal.
  RateLimit creates_;
};

}  // namespace contact
