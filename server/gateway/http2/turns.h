#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

namespace contact::gateway {

/// Who waits for a turn.
class TurnTaker {
 public:
  virtual ~TurnTaker() = default;
  /// Starts some calls. Waits again if there are more.
  virtual void TakeTurn() = 0;
};

/// Lets the connections of one thread start calls in turn, and few calls be between their start and
/// the beginning of their answer: a flood on some connections waits in their own sockets, and not
/// in gRPC before the calls of others. Used on one thread.
class Turns {
 public:
  /// Calls that a connection starts in one turn.
  static constexpr int kCalls = 16;

  explicit Turns(boost::asio::io_context& io) : io_(io), lapse_(io) {}

  /// A place for a call that starts; nothing if there is none.
  std::optional<std::uint64_t> Take();
  /// Gives a place back, unless that has been done.
  void GiveBack(std::uint64_t place);

  /// Calls `who` once there are places, after those who wait already.
  void Wait(std::weak_ptr<TurnTaker> who);

 private:
  /// Gives turns, later and once.
  void RunSoon();
  void Run();
  /// Has places of calls that are slow to answer given back.
  void AwaitLapse();

  boost::asio::io_context& io_;
  boost::asio::steady_timer lapse_;
  bool lapsing_ = false;
  bool running_ = false;
  std::uint64_t next_ = 0;
  /// Places that are taken, and since when.
  std::map<std::uint64_t, std::chrono::steady_clock::time_point> taken_;
  std::deque<std::weak_ptr<TurnTaker>> waiting_;
};

}  // namespace contact::gateway
