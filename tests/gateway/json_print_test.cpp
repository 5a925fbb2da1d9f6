#include "gateway/protocol/json_print.h"

#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/wrappers.pb.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "contact/v1/model_service.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact::gateway {
namespace {

namespace pb = google::protobuf;
using nlohmann::json;
using pb::FieldDescriptor;

// Fills messages with values that are hard to print.
class Filler {
 public:
  explicit Filler(unsigned seed) : random_(seed) {}

  void Fill(pb::Message* message, int depth) {
    const pb::Descriptor& type = *message->GetDescriptor();
    if (FillTime(message) || type.full_name() == "google.protobuf.Any") return;
    for (int i = 0; i < type.field_count(); ++i) {
      const FieldDescriptor& field = *type.field(i);
      if (Below(3) == 0) continue;
      if (field.is_map()) {
        FillMap(message, field);
      } else {
        for (int n = field.is_repeated() ? Below(3) : 1; n > 0; --n) Set(message, field, depth);
      }
    }
  }

 private:
  int Below(int end) { return std::uniform_int_distribution(0, end - 1)(random_); }
  std::uint64_t Bits() { return std::uniform_int_distribution<std::uint64_t>()(random_); }
  // Any number that a double can be, and those at its borders.
  double Real() {
    using Limits = std::numeric_limits<double>;
    constexpr std::array kHard = {0.0,
                                  -0.0,
                                  0.1,
                                  1e22,
                                  1e-7,
                                  Limits::min(),
                                  Limits::max(),
                                  Limits::denorm_min(),
                                  Limits::infinity(),
                                  -Limits::infinity()};
    const auto which = static_cast<std::size_t>(Below(2 * kHard.size()));
    if (which < kHard.size()) return kHard.at(which);
    const auto any = std::bit_cast<double>(Bits());
    return any == any ? any : 1.0;  // NaN has no equal.
  }
  std::string Text() {
    constexpr std::array kTexts = {"", "plain", "\"\\/\b\f\n\r\t", "\x01\x1f\x7f", "Δμ 𝛼 <&>"};
    return kTexts.at(static_cast<std::size_t>(Below(kTexts.size())));
  }

  bool FillTime(pb::Message* message) {
    if (auto* time = pb::DynamicCastToGenerated<pb::Timestamp>(message)) {
      time->set_seconds(Below(1 << 30) - (1 << 29));
      time->set_nanos(Nanos());
    } else if (auto* span = pb::DynamicCastToGenerated<pb::Duration>(message)) {
      const int sign = Below(2) == 0 ? 1 : -1;
      span->set_seconds(sign * Below(1000));
      span->set_nanos(sign * Nanos());
    } else {
      return false;
    }
    return true;
  }
  int Nanos() {
    constexpr std::array kNanos = {0, 5'000'000, 999'999'000, 1};
    return kNanos.at(static_cast<std::size_t>(Below(kNanos.size())));
  }

  void FillMap(pb::Message* message, const FieldDescriptor& field) {
    pb::Message* entry = message->GetReflection()->AddMessage(message, &field);
    Set(entry, *field.message_type()->map_key(), 0);
    Set(entry, *field.message_type()->map_value(), 0);
  }

  void Set(pb::Message* message, const FieldDescriptor& field, int depth) {
    const pb::Reflection& of = *message->GetReflection();
    const bool list = field.is_repeated();
    const auto set = [&](auto one, auto add, auto value) {
      list ? (of.*add)(message, &field, value) : (of.*one)(message, &field, value);
    };
    using R = pb::Reflection;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_INT32:
        return set(&R::SetInt32, &R::AddInt32, static_cast<std::int32_t>(Bits()));
      case FieldDescriptor::CPPTYPE_UINT32:
        return set(&R::SetUInt32, &R::AddUInt32, static_cast<std::uint32_t>(Bits()));
      case FieldDescriptor::CPPTYPE_INT64:
        return set(&R::SetInt64, &R::AddInt64, static_cast<std::int64_t>(Bits()));
      case FieldDescriptor::CPPTYPE_UINT64:
        return set(&R::SetUInt64, &R::AddUInt64, Bits());
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return set(&R::SetDouble, &R::AddDouble, Real());
      case FieldDescriptor::CPPTYPE_FLOAT:
        return set(&R::SetFloat, &R::AddFloat, static_cast<float>(Below(1000)) / 8);
      case FieldDescriptor::CPPTYPE_BOOL:
        return set(&R::SetBool, &R::AddBool, Below(2) == 0);
      case FieldDescriptor::CPPTYPE_ENUM:
        return set(&R::SetEnumValue, &R::AddEnumValue, Below(20));
      case FieldDescriptor::CPPTYPE_STRING:
        return set(&R::SetString, &R::AddString, Text());
      case FieldDescriptor::CPPTYPE_MESSAGE:
        if (depth == 0) return;
        Fill(list ? of.AddMessage(message, &field) : of.MutableMessage(message, &field), depth - 1);
    }
  }

  std::mt19937_64 random_;
};

std::string ByProtobuf(const pb::Message& message) {
  std::string text;
  EXPECT_TRUE(pb::util::MessageToJsonString(message, &text).ok());
  return text;
}

std::string Printed(const pb::Message& message) {
  const auto text = PrintJson(message);
  EXPECT_TRUE(text) << message.DebugString();
  return text.value_or("");
}

void ExpectSame(const pb::Message& message) {
  EXPECT_EQ(json::parse(Printed(message)), json::parse(ByProtobuf(message)))
      << message.DebugString();
}

TEST(JsonPrintTest, EveryMessageOfTheContractIsWhatProtobufPrints) {
  v1::GetJobRequest::descriptor();
  v1::TranslateModelRequest::descriptor();
  google::rpc::ErrorInfo::descriptor();
  int seen = 0;
  for (const char* name :
       {"contact/v1/job_service.proto", "contact/v1/job.proto", "contact/v1/event.proto",
        "contact/v1/model_service.proto", "contact/v1/motion.proto", "contact/v1/force_table.proto",
        "contact/v1/scenario.proto", "google/rpc/error_details.proto"}) {
    const auto* file = pb::DescriptorPool::generated_pool()->FindFileByName(name);
    ASSERT_NE(file, nullptr) << name;
    for (int i = 0; i < file->message_type_count(); ++i) {
      const auto* prototype =
          pb::MessageFactory::generated_factory()->GetPrototype(file->message_type(i));
      for (unsigned seed = 0; seed < 20; ++seed) {
        const std::unique_ptr<pb::Message> message(prototype->New());
        Filler(seed).Fill(message.get(), 4);
        ExpectSame(*message);
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(JsonPrintTest, MessagesWithAJsonOfTheirOwnHaveThat) {
  google::rpc::Status status;
  google::rpc::ErrorInfo info;
  info.set_reason("NO");
  status.add_details()->PackFrom(info);
  ExpectSame(status);
  pb::Struct object;
  (*object.mutable_fields())["a"].set_null_value(pb::NULL_VALUE);
  (*object.mutable_fields())["b"].mutable_list_value()->add_values()->set_number_value(0.1);
  ExpectSame(object);
  pb::Int64Value wrapped;
  wrapped.set_value(1);
  ExpectSame(wrapped);
}

TEST(JsonPrintTest, ANumberHasTheFewestDigitsThatIdentifyIt) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    v1::Body body;
    body.set_mass_kg(value);
    const std::string text = Printed(body);
    const std::string digits = text.substr(10, text.size() - 11);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(digits.c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(value))
        << text;
    EXPECT_LE(text.size(), ByProtobuf(body).size());
  }
}

TEST(JsonPrintTest, WhatIsNoNumberIsAText) {
  v1::Body body;
  body.set_mass_kg(std::numeric_limits<double>::quiet_NaN());
  body.set_radius_m(-std::numeric_limits<double>::infinity());
  EXPECT_EQ(Printed(body), R"({"massKg":"NaN","radiusM":"-Infinity"})");
}

TEST(JsonPrintTest, ATimeOutOfRangeHasNoJson) {
  v1::Job job;
  job.mutable_create_time()->set_seconds(253'402'300'800);
  EXPECT_EQ(PrintJson(job), std::nullopt);
  job.mutable_create_time()->set_seconds(0);
  job.mutable_create_time()->set_nanos(-1);
  EXPECT_EQ(PrintJson(job), std::nullopt);
  job.clear_create_time();
  job.mutable_time_to_live()->set_seconds(1);
  job.mutable_time_to_live()->set_nanos(-1);
  EXPECT_EQ(PrintJson(job), std::nullopt);
}

}  // namespace
}  // namespace contact::gateway
