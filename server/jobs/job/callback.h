#pragma once

#include <functional>

#include "jobs/job/errors.h"

namespace contact {

/// Takes the answer of a call. It is called exactly once, on a thread of the jobs or of the store
/// or before the call returns, after what it reports is committed. It must not block.
template <class T>
using Callback = std::function<void(Result<T>)>;

/// Answers true once nobody waits for the answer of a call any more, so that work on it that has
/// not begun is left out. May be asked until the call's callback is called. Empty: somebody always
/// waits.
using Abandoned = std::function<bool()>;

/// Tells the reader of a stream that its source may have something new. Called from any thread, and
/// possibly more often than needed. It must not block, and must not call the source from within. A
/// call that has begun may go on while the source is destroyed.
using Wake = std::function<void()>;

}  // namespace contact
