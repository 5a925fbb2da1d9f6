#include "cli/export/writers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace contact::cli {
namespace {

TEST(WritersTest, EveryDataFormatButTheEventsHasOneWriter) {
  for (const FormatInfo& info : Formats()) {
    const int writers = static_cast<int>(TableWriterOf(info.format) != nullptr) +
                        static_cast<int>(FileWriterOf(info.format) != nullptr);
    const bool tables = (info.uses & kData) != 0 && info.format != OutputFormat::kProtobuf;
    EXPECT_EQ(writers, tables ? 1 : 0) << info.name;
  }
}

TEST(WritersTest, EveryDataFormatIsToldByAnEnding) {
  for (const FormatInfo& info : Formats()) {
    EXPECT_TRUE((info.uses & kData) == 0 || !info.ending.empty()) << info.name;
  }
}

TEST(WritersTest, WriterOfATableWritesALineForEachRow) {
  DataTable table;
  table.name = "bodies";
  table.columns = {{"time", "s", "", std::vector<double>{0, 1, 2}}};
  for (const FormatInfo& info : Formats()) {
    TableWriter* write = TableWriterOf(info.format);
    if (write == nullptr) continue;
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* file = open_memstream(&text, &size);
    write(table, file, 0);
    std::fclose(file);
    const std::string written(text, size);
    std::free(text);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream wants it.
    const auto lines = std::ranges::count(written, '\n');
    EXPECT_TRUE(lines == 3 || lines == 4) << info.name;  // Three rows, with or without a header.
  }
}

}  // namespace
}  // namespace contact::cli
