#include "gateway/protocol/frames.h"

#include <gtest/gtest.h>

#include <string>

namespace contact::gateway {
namespace {

TEST(FramesTest, AFrameHasFlagsLengthAndPayload) {
  EXPECT_EQ(ToBytes({kEndOfStream, "{}"}), std::string("\x02\0\0\0\x02{}", 7));
  EXPECT_EQ(ToBytes({0, std::string(0x010203, 'x')}).substr(0, 5), std::string("\0\0\1\2\3", 5));
}

TEST(FramesTest, FramesComeBackAsTheyWent) {
  const auto frames = ToFrames(ToBytes({0, "one"}) + ToBytes({kTrailers, ""}) + ToBytes({1, "3"}));
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 3U);
  EXPECT_EQ(frames->at(0).payload, "one");
  EXPECT_EQ(frames->at(1).flags, kTrailers);
  EXPECT_EQ(frames->at(2).flags, kCompressed);
}

TEST(FramesTest, AnIncompleteFrameIsNone) {
  const std::string whole = ToBytes({0, "payload"});
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_FALSE(ToFrames(whole.substr(0, size))) << size;
  }
  EXPECT_TRUE(ToFrames("")->empty());
  EXPECT_FALSE(ToFrames(std::string("\0\xff\xff\xff\xffx", 6)));
}

TEST(FramesTest, Base64IsReadWithAndWithoutPaddingAndUrlSafe) {
  const std::string bytes("\xfb\xff\0a", 4);
  EXPECT_EQ(ToBase64(bytes), "+/8AYQ");
  EXPECT_EQ(ToPaddedBase64(bytes), "+/8AYQ==");
  for (const char* text : {"+/8AYQ", "+/8AYQ==", "-_8AYQ", "-_8AYQ=="}) {
    EXPECT_EQ(FromBase64(text), bytes) << text;
  }
  EXPECT_FALSE(FromBase64("a"));
  EXPECT_FALSE(FromBase64("ab!d"));
}

TEST(FramesTest, ATextStreamMayBePaddedInTheMiddle) {
  EXPECT_EQ(FromBase64Stream("YQ==Yg==YWJj"), "ababc");
  EXPECT_EQ(FromBase64Stream(""), "");
  EXPECT_FALSE(FromBase64Stream("YQ==="));
}

}  // namespace
}  // namespace contact::gateway
