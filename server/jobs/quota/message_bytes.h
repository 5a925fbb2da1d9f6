#pragma once

#include <cstddef>
#include <functional>

#include "jobs/quota/places.h"

namespace contact {

/// Bytes of a message, about, while so many watch or read artifacts: a reader that takes nothing
/// keeps one, so all together have a bounded number.
std::size_t MessageBytes(int readers);

/// Bytes that the next message of a stream may have, about.
using MessageBudget = std::function<std::size_t()>;

/// MessageBytes for the readers that have places now.
inline MessageBudget BudgetOf(const Places& places) {
  return [places] { return MessageBytes(places.taken()); };
}

}  // namespace contact
