#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/clock.h"
#include "jobs/job/errors.h"
#include "jobs/log/stream_source.h"

namespace contact {

/// Why a stream may not go on; nothing if it may.
using Right = std::function<std::optional<Error>()>;

/// A source whose reader is asked for its right again every ten seconds: a token may be revoked or
/// expire, and a rule for certificates may go.
template <class Message>
class RightfulSource final : public StreamSource<Message> {
 public:
  /// The clock outlives the source.
  RightfulSource(std::unique_ptr<StreamSource<Message>> source, Right right, const Clock& clock)
      : source_(std::move(source)),
        right_(std::move(right)),
        clock_(clock),
        asked_(clock.Elapsed()) {}

  StreamStep Read(Message* out) override {
    if (const auto now = clock_.Elapsed(); now - asked_ >= kInterval) {
      asked_ = now;
      if (auto error = right_()) return {.error = std::move(error)};
    }
    return source_->Read(out);
  }
  bool IsDue(std::chrono::steady_clock::time_point now) const override {
    return now - asked_ >= kInterval || source_->IsDue(now);
  }

 private:
  static constexpr std::chrono::seconds kInterval{10};

  const std::unique_ptr<StreamSource<Message>> source_;
  const Right right_;
  const Clock& clock_;
  std::chrono::steady_clock::time_point asked_;
};

}  // namespace contact
