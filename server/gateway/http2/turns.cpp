#include "gateway/http2/turns.h"

#include <boost/asio/post.hpp>
#include <utility>

namespace contact::gateway {
namespace {

using std::chrono::steady_clock;

// An honest call waits for about so many of others, 50 to 100 us each; group commits of the store
// want as many at once. system/flood sees the one, service_benchmark the other.
constexpr std::size_t kPlaces = 64;
// A call that waits for the disk or for other jobs does not use the processor: its place goes to
// another.
constexpr std::chrono::milliseconds kLapse{20};

}  // namespace

std::optional<std::uint64_t> Turns::Take() {
  if (taken_.size() >= kPlaces) return std::nullopt;
  taken_.emplace(next_, steady_clock::now());
  return next_++;
}

void Turns::GiveBack(std::uint64_t place) {
  if (taken_.erase(place) > 0 && !waiting_.empty()) RunSoon();
}

void Turns::Wait(std::weak_ptr<TurnTaker> who) {
  waiting_.push_back(std::move(who));
  if (taken_.size() < kPlaces) {
    RunSoon();
  } else {
    AwaitLapse();
  }
}

void Turns::RunSoon() {
  if (std::exchange(running_, true)) return;
  boost::asio::post(io_, [this] {
    running_ = false;
    Run();
  });
}

void Turns::Run() {
  for (std::size_t all = waiting_.size(); all > 0 && taken_.size() < kPlaces; --all) {
    const auto who = waiting_.front().lock();
    waiting_.pop_front();
    if (who) who->TakeTurn();
  }
  if (!waiting_.empty()) AwaitLapse();
}

void Turns::AwaitLapse() {
  if (std::exchange(lapsing_, true)) return;
  lapse_.expires_after(kLapse);
  lapse_.async_wait([this](boost::system::error_code error) {
    if (error) return;
    lapsing_ = false;
    const auto old = steady_clock::now() - kLapse;
    while (!taken_.empty() && taken_.begin()->second <= old) taken_.erase(taken_.begin());
    Run();
  });
}

}  // namespace contact::gateway
