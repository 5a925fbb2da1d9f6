#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "storage/records.h"

namespace contact {

/// Specs of waiting jobs in memory, so that their workers need not wait for the store. Not
/// thread-safe.
class SpecCache {
 public:
  /// Takes the spec out of the job, if it has one, and keeps it with the checkpoint if there is
  /// room: 16 MiB in all.
  void Keep(StoredJob* stored);
  /// Gives away the kept spec of the job with this name. Null if it was not kept.
  std::shared_ptr<const StoredJob> Take(const std::string& name);

 private:
  std::map<std::string, std::shared_ptr<const StoredJob>> specs_;
  /// Of all kept specs.
  std::size_t bytes_ = 0;
};

}  // namespace contact
