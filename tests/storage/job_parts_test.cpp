#include "storage/job_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

void FillField(const FieldDescriptor& field, Message* message);

// Sets every field but maps, also of the messages inside; of a oneof the last. Reflection on maps
// breaks with ThreadSanitizer, for it changes the layout of protobuf's classes but not its library.
void FillJob(Message* message) {
  for (int i = 0; i < message->GetDescriptor()->field_count(); ++i) {
    FillField(*message->GetDescriptor()->field(i), message);
  }
}

void FillField(const FieldDescriptor& field, Message* message) {
  if (field.is_map()) return;
  const auto& set = *message->GetReflection();
  const bool many = field.is_repeated();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return FillJob(many ? set.AddMessage(message, &field) : set.MutableMessage(message, &field));
    case FieldDescriptor::CPPTYPE_STRING:
      return many ? set.AddString(message, &field, field.name())
                  : set.SetString(message, &field, field.name());
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return many ? set.AddDouble(message, &field, 2.5) : set.SetDouble(message, &field, 2.5);
    case FieldDescriptor::CPPTYPE_INT32:
      return many ? set.AddInt32(message, &field, 3) : set.SetInt32(message, &field, 3);
    case FieldDescriptor::CPPTYPE_INT64:
      return set.SetInt64(message, &field, 4);
    case FieldDescriptor::CPPTYPE_UINT64:
      return set.SetUInt64(message, &field, 5);
    case FieldDescriptor::CPPTYPE_ENUM:
      return many ? set.AddEnumValue(message, &field, 1) : set.SetEnumValue(message, &field, 1);
    case FieldDescriptor::CPPTYPE_BOOL:
      return set.SetBool(message, &field, true);
    default:
      FAIL() << "no value for " << field.full_name();
  }
}

v1::Job FullJob() {
  v1::Job job;
  FillJob(&job);
  (*job.mutable_labels())["key"] = "value";
  return job;
}

TEST(Split, PiecesGiveTheWholeJobInAnyOrder) {
  v1::Job job = FullJob();
  const JobParts parts = Split(job);
  EXPECT_EQ(parts.end_time, job.end_time().seconds());
  job.clear_note();  // It is in the JobRemark.
  std::array<std::string, 3> pieces{parts.header, parts.spec, parts.result};
  std::sort(pieces.begin(), pieces.end());
  do {
    v1::Job merged;
    for (const std::string& piece : pieces) ASSERT_TRUE(merged.MergeFromString(piece));
    EXPECT_EQ(merged.SerializeAsString(), job.SerializeAsString());
  } while (std::next_permutation(pieces.begin(), pieces.end()));
}

TEST(Split, LargeFieldsStandInOnePieceOnly) {
  const v1::Job job = FullJob();
  const JobParts parts = Split(job);
  v1::Job header, spec, result;
  ASSERT_TRUE(header.ParseFromString(parts.header) && spec.ParseFromString(parts.spec) &&
              result.ParseFromString(parts.result));
  EXPECT_EQ(header.spec_case(), v1::Job::SPEC_NOT_SET);
  EXPECT_EQ(header.cycles_size() + header.groups_size() + header.final_bodies_size(), 0);
  EXPECT_EQ(spec.cycles_size() + spec.groups_size() + spec.final_bodies_size(), 0);
  EXPECT_EQ(result.spec_case(), v1::Job::SPEC_NOT_SET);
}

TEST(Split, SpecDependsOnWhatTheClientSentAlone) {
  v1::Job one, other;
  for (int i = 0; i < 20; ++i) (*one.mutable_labels())["key" + std::to_string(i)] = "value";
  for (int i = 20; i-- > 0;) (*other.mutable_labels())["key" + std::to_string(i)] = "value";
  one.mutable_scenario()->set_title("one");
  other.mutable_scenario()->set_title("one");
  other.set_name("jobs/other");
  other.set_state(v1::Job::RUNNING);
  other.add_cycles();
  EXPECT_EQ(Split(one).spec, Split(other).spec);
  EXPECT_TRUE(Split(one).result.empty());
  other.set_priority(1);
  EXPECT_NE(Split(one).spec, Split(other).spec);
}

TEST(TitleOf, IsThatOfTheScenarioOrOfTheBaseOfTheSweep) {
  v1::Job job;
  EXPECT_EQ(TitleOf(job), "");
  job.mutable_scenario()->set_title("one");
  EXPECT_EQ(TitleOf(job), "one");
  job.mutable_sweep()->mutable_base()->set_title("many");
  EXPECT_EQ(TitleOf(job), "many");
}

TEST(Split, TitleIsPartOfTheHeader) {
  v1::Job header;
  ASSERT_TRUE(header.ParseFromString(Split(FullJob()).header));
  EXPECT_EQ(header.title(), "title");
}

TEST(ToRows, KindIsTheFieldNumberOfThePayload) {
  std::vector<v1::Event> events;
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (int i = 0; i < payload.field_count(); ++i) {
    FillField(*payload.field(i), &events.emplace_back());
  }
  const std::vector<EventRow> rows = ToRows(events);
  ASSERT_EQ(rows.size(), events.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].kind, payload.field(static_cast<int>(i))->number());
    v1::Event event;
    ASSERT_TRUE(DecodeEvent(rows[i].event.coding, rows[i].event.bytes, &event));
    EXPECT_EQ(event.SerializeAsString(), events[i].SerializeAsString());
  }
}

}  // namespace
}  // namespace contact
