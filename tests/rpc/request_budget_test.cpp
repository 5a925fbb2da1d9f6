#include "rpc/call/request_budget.h"

#include <gmock/gmock.h>

#include <string>
#include <utility>

#include "contact/v1/job_service.pb.h"

namespace contact {
namespace {

using testing::HasSubstr;

v1::CreateJobRequest WithContacts(int count) {
  v1::CreateJobRequest request;
  for (int i = 0; i < count; ++i) request.mutable_job()->mutable_scenario()->add_contacts();
  return request;
}

grpc::ByteBuffer Bytes(const std::string& text) {
  const grpc::Slice slice(text);
  return {&slice, 1};
}

std::optional<std::int64_t> Count(const std::string& bytes,
                                  const FieldCount& most = {1 << 20, 1 << 20}) {
  const auto count = CountFields(bytes, *v1::CreateJobRequest::descriptor(), most);
  return count ? std::optional(count->fields) : std::nullopt;
}

TEST(CountFields, CountsAtAllDepths) {
  EXPECT_EQ(Count(""), 0);
  EXPECT_EQ(Count(WithContacts(1000).SerializeAsString()), 1002) << "with job and scenario";
  v1::CreateJobRequest request = WithContacts(1);
  request.mutable_job()->mutable_scenario()->mutable_contacts(0)->add_between("a");
  request.mutable_job()->mutable_scenario()->mutable_contacts(0)->set_stiffness(1);
  (*request.mutable_job()->mutable_labels())["key"] = "value";
  EXPECT_EQ(Count(request.SerializeAsString()), 3 + 2 + 3);
}

TEST(CountFields, StopsWhereThereAreTooMany) {
  EXPECT_EQ(Count(WithContacts(1000).SerializeAsString(), {500, 1 << 20}), 501);
  EXPECT_EQ(Count(WithContacts(1000).SerializeAsString(), {1 << 20, 500}), 501);
}

TEST(CountFields, TellsMessagesFromOtherFields) {
  v1::CreateJobRequest request = WithContacts(3);
  request.mutable_job()->mutable_scenario()->mutable_contacts(0)->set_stiffness(1);
  const auto count =
      CountFields(request.SerializeAsString(), *v1::CreateJobRequest::descriptor(), {100, 100});
  ASSERT_TRUE(count);
  EXPECT_EQ(count->fields, 6);
  EXPECT_EQ(count->messages, 5) << "contacts, job and scenario";
}

TEST(CountFields, SeesWhatIsNoMessage) {
  EXPECT_EQ(Count("\xff\xff\xff\xff\xff\xff"), std::nullopt);
  EXPECT_EQ(Count("\x0a\x05"), std::nullopt) << "cut off";
  const std::string group = "\xc3\x3e\xc4\x3e";  // Of field 1000, which nobody knows.
  EXPECT_EQ(Count(group), 2);
}

class RequestBudgetTest : public testing::Test {
 protected:
  std::string Refusal(const std::string& bytes) {
    const auto error = budget_.Parse(Bytes(bytes), &parsed_, &place_);
    return error ? error->reason + ": " + error->message : "";
  }

  RequestBudget budget_{1'000'000};
  v1::CreateJobRequest parsed_;
  std::shared_ptr<const void> place_;
};

TEST_F(RequestBudgetTest, ParsesAndKeepsAPlaceUntilItGoes) {
  const std::string large = WithContacts(5000).SerializeAsString();  // 760 kB in memory.
  EXPECT_EQ(Refusal(large), "");
  EXPECT_EQ(parsed_.job().scenario().contacts_size(), 5000);
  auto first = std::move(place_);
  EXPECT_THAT(Refusal(large), HasSubstr("RATE_LIMITED"));
  place_.reset();
  EXPECT_EQ(Refusal(WithContacts(10).SerializeAsString()), "") << "small ones have a place";
  place_.reset();
  first.reset();
  EXPECT_EQ(Refusal(large), "");
}

TEST_F(RequestBudgetTest, TakesOneThatNeedsMoreIfItIsAlone) {
  EXPECT_EQ(Refusal(WithContacts(50'000).SerializeAsString()), "");
}

TEST_F(RequestBudgetTest, RefusesWhatIsNoRequestOrHasTooManyFields) {
  EXPECT_EQ(Refusal("\xff"), "FIELD_INVALID: the request is no CreateJobRequest");
  EXPECT_EQ(Refusal(std::string("\x0a\x02\xff\xff", 4)).substr(0, 13), "FIELD_INVALID");
  EXPECT_EQ(Refusal(WithContacts(600'000).SerializeAsString()),
            "FIELD_INVALID: the request has more than 327680 messages");
  v1::CreateJobRequest names;  // Fields that are no messages.
  for (int i = 0; i < 600'000; ++i) names.mutable_job()->mutable_sweep()->add_metrics("");
  EXPECT_EQ(Refusal(names.SerializeAsString()),
            "FIELD_INVALID: the request has more than 524288 fields");
}

}  // namespace
}  // namespace contact
