#include "base/future.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace contact {
namespace {

TEST(AwaitTest, ReturnsWhatAnotherThreadAnswers) {
  std::thread thread;
  const auto answer = Await<std::string>([&thread](std::function<void(std::string)> done) {
    thread = std::thread([done = std::move(done)] { done("answer"); });
  });
  thread.join();
  EXPECT_EQ(answer, "answer");
}

TEST(AwaitTest, AnswerWithinTheCallIsReturned) {
  EXPECT_EQ(Await<int>([](const auto& done) { done(7); }), 7);
}

TEST(AwaitTest, MoveOnlyAnswerIsHandedOver) {
  const auto answer =
      Await<std::unique_ptr<int>>([](const auto& done) { done(std::make_unique<int>(3)); });
  EXPECT_EQ(*answer, 3);
}

}  // namespace
}  // namespace contact
