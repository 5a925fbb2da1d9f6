#include "base/file_descriptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <utility>

namespace contact {
namespace {

int OpenNull() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

bool IsOpen(int fd) { return ::fcntl(fd, F_GETFD) >= 0; }

TEST(FileDescriptorTest, IsClosedAtTheEndOfItsScope) {
  const int fd = OpenNull();
  {
    const FileDescriptor owner(fd);
    EXPECT_TRUE(owner.valid());
    EXPECT_EQ(owner.get(), fd);
    EXPECT_TRUE(IsOpen(fd));
  }
  EXPECT_FALSE(IsOpen(fd));
}

TEST(FileDescriptorTest, MoveHandsItOver) {
  const int fd = OpenNull();
  FileDescriptor to;
  EXPECT_FALSE(to.valid());
  {
    FileDescriptor from(fd);
    to = std::move(from);
  }
  EXPECT_EQ(to.get(), fd);
  EXPECT_TRUE(IsOpen(fd));
}

TEST(FileDescriptorTest, AssignmentClosesTheOldOneWithTheTemporary) {
  const int before = OpenNull();
  const int after = OpenNull();
  FileDescriptor owner(before);
  owner = FileDescriptor(after);
  EXPECT_FALSE(IsOpen(before));
  EXPECT_EQ(owner.get(), after);
}

TEST(FileDescriptorTest, ReleaseLeavesItOpen) {
  const int fd = OpenNull();
  {
    FileDescriptor owner(fd);
    EXPECT_EQ(owner.Release(), fd);
    EXPECT_FALSE(owner.valid());
  }
  EXPECT_TRUE(IsOpen(fd));
  ::close(fd);
}

}  // namespace
}  // namespace contact
