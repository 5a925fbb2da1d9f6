#include "gateway/protocol/metadata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace contact::gateway {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(MetadataTest, HeadersOfTheCallerBecomeMetadata) {
  std::string mistake;
  const auto metadata =
      ToMetadata({{"authorization", "Bearer x"}, {"x-trace-bin", "AP8, AQ=="}}, &mistake);
  ASSERT_TRUE(metadata) << mistake;
  EXPECT_THAT(*metadata, ElementsAre(Pair("authorization", "Bearer x"),
                                     Pair("x-trace-bin", std::string("\0\xff", 2)),
                                     Pair("x-trace-bin", "\x01")));
}

TEST(MetadataTest, WhatOnlyTheGatewayOrAProxyMaySayIsLeftOut) {
  std::string mistake;
  const auto metadata = ToMetadata({{"x-contactd-principal", "user:root tenant:a roles:admin"},
                                    {"x-contactd-peer", "ipv4:1.2.3.4:5"},
                                    {"host", "localhost"},
                                    {"cookie", "a=b"},
                                    {"sec-fetch-site", "none"},
                                    {"grpc-timeout", "1S"},
                                    {"connect-timeout-ms", "1"},
                                    {"content-length", "3"}},
                                   &mistake);
  ASSERT_TRUE(metadata);
  EXPECT_THAT(*metadata, IsEmpty());
}

TEST(MetadataTest, WhatGrpcWouldNotTakeIsRefused) {
  for (const auto& header : Headers{{"x$y", "1"}, {"x", "\xe9"}, {"x-bin", "?"}, {"x", "a\tb"}}) {
    std::string mistake;
    EXPECT_FALSE(ToMetadata({header}, &mistake)) << header.first;
    EXPECT_THAT(mistake, HasSubstr("header"));
  }
}

TEST(MetadataTest, BytesOfAnAnswerAreBase64WithoutPadding) {
  EXPECT_THAT(ToHeaders({{"a", "1"}, {"b-bin", "\xff"}, {"grpc-x", "1"}}, "trailer-"),
              ElementsAre(Pair("trailer-a", "1"), Pair("trailer-b-bin", "/w")));
}

TEST(MetadataTest, TimesAreReadInTheFormOfEachProtocol) {
  EXPECT_EQ(ConnectTimeout("1500"), 1500);
  EXPECT_EQ(ConnectTimeout("9999999999"), 9'999'999'999);
  for (const char* bad : {"", "-1", "+1", "1.5", "1s", "12345678901", " 1"}) {
    EXPECT_FALSE(ConnectTimeout(bad)) << bad;
  }
  EXPECT_EQ(GrpcTimeout("2H"), 7'200'000);
  EXPECT_EQ(GrpcTimeout("2M"), 120'000);
  EXPECT_EQ(GrpcTimeout("2S"), 2'000);
  EXPECT_EQ(GrpcTimeout("2m"), 2);
  EXPECT_EQ(GrpcTimeout("1001u"), 2);
  EXPECT_EQ(GrpcTimeout("1n"), 1);
  for (const char* bad : {"", "1", "S", "-1S", "123456789S", "1x", "1 S"}) {
    EXPECT_FALSE(GrpcTimeout(bad)) << bad;
  }
}

}  // namespace
}  // namespace contact::gateway
