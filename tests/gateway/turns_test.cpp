#include "gateway/http2/turns.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace contact::gateway {
namespace {

// Wants some calls started, and notes whose they are.
class Connection : public TurnTaker, public std::enable_shared_from_this<Connection> {
 public:
  Connection(Turns& turns, std::string* order, char name, int calls)
      : turns_(turns), order_(*order), name_(name), calls_(calls) {}

  void TakeTurn() override {
    for (int i = 0; i < Turns::kCalls && calls_ > 0; ++i, --calls_) {
      const auto place = turns_.Take();
      if (!place) break;
      order_ += name_;
      places.push_back(*place);
    }
    if (calls_ > 0) turns_.Wait(weak_from_this());
  }

  std::vector<std::uint64_t> places;

 private:
  Turns& turns_;
  std::string& order_;
  const char name_;
  int calls_;
};

TEST(Turns, ConnectionsStartAFewCallsEachInTheirOrder) {
  boost::asio::io_context io;
  Turns turns(io);
  std::string order;
  const auto many = std::make_shared<Connection>(turns, &order, 'm', 32);
  const auto few = std::make_shared<Connection>(turns, &order, 'f', 1);
  turns.Wait(many);
  turns.Wait(few);
  io.poll();
  EXPECT_EQ(order, std::string(16, 'm') + 'f' + std::string(16, 'm'));
}

TEST(Turns, WhoFindsNoPlaceStartsOnceOneIsGivenBack) {
  boost::asio::io_context io;
  Turns turns(io);
  std::string order;
  const auto flood = std::make_shared<Connection>(turns, &order, 'm', 1000);
  const auto honest = std::make_shared<Connection>(turns, &order, 'h', 1);
  flood->TakeTurn();
  io.poll();
  ASSERT_EQ(order, std::string(64, 'm'));
  turns.Wait(honest);
  for (const std::uint64_t place : std::exchange(flood->places, {})) turns.GiveBack(place);
  io.poll();
  EXPECT_EQ(order.substr(64, 17), std::string(16, 'm') + 'h');
}

TEST(Turns, SlowCallsDoNotKeepTheirPlaces) {
  boost::asio::io_context io;
  Turns turns(io);
  std::string order;
  const auto slow = std::make_shared<Connection>(turns, &order, 's', 64);
  for (int i = 0; i < 4; ++i) slow->TakeTurn();
  const auto honest = std::make_shared<Connection>(turns, &order, 'h', 1);
  turns.Wait(honest);
  io.run();
  EXPECT_TRUE(order.ends_with('h'));
}

}  // namespace
}  // namespace contact::gateway
