#include "rpc/stream/watch_message.h"

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <gtest/gtest.h>

#include <string>

#include "contact/v1/job_service.pb.h"

namespace contact {
namespace {

// The bytes that are composed are those that protobuf would write, but for the order of fields.
TEST(WatchMessageTest, ParsesToWhatWasPutIn) {
  v1::WatchJobResponse expected;
  expected.mutable_snapshot()->set_name("jobs/a");
  WatchMessage message;
  message.SetSnapshot(expected.snapshot());
  for (const std::size_t size : {0U, 1U, 100U, 127U, 128U, 4095U, 4096U, 4097U, 300'000U}) {
    for (const std::uint64_t sequence : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
      v1::Event& event = *expected.add_events();
      event.mutable_event_time()->set_seconds(7);
      event.mutable_log_entry()->set_message(std::string(size, 'x'));
      message.Add(ToRecord(sequence, event));
      if (sequence > 0) event.set_sequence(sequence);
    }
  }
  grpc::ByteBuffer bytes = message.Take();
  v1::WatchJobResponse parsed;
  ASSERT_TRUE(grpc::SerializationTraits<v1::WatchJobResponse>::Deserialize(&bytes, &parsed).ok());
  EXPECT_EQ(parsed.SerializeAsString(), expected.SerializeAsString());
}

TEST(WatchMessageTest, SharedBytesOutliveTheLog) {
  WatchMessage message;
  v1::Event event;
  event.mutable_log_entry()->set_message(std::string(10'000, 'x'));
  {
    const LogRecord record = ToRecord(1, event);
    message.Add(record);
  }
  grpc::ByteBuffer bytes = message.Take();
  v1::WatchJobResponse parsed;
  ASSERT_TRUE(grpc::SerializationTraits<v1::WatchJobResponse>::Deserialize(&bytes, &parsed).ok());
  EXPECT_EQ(parsed.events(0).log_entry().message().size(), 10'000U);
}

}  // namespace
}  // namespace contact
