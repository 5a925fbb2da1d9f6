#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/paper/report.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using ::testing::HasSubstr;

Comparison Number(double published, double process, double limit) {
  return {.what = "a", .published = published, .process = process, .limit = limit};
}

std::string FileText(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(PaperReport, AnItemHoldsWhileEveryDeviationIsWithinItsLimit) {
  PaperItem item{"table2", "t", {Number(0.8, 0.8006, 7e-4), Number(6, 6, 0)}, {}};
  EXPECT_TRUE(item.holds());
  item.numbers.push_back(Number(0.8, 0.8008, 7e-4));
  EXPECT_FALSE(item.holds());
  EXPECT_THAT(Summary({item}, Style{}), HasSubstr("DIFFERS"));
}

TEST(PaperReport, ANumberThatIsMissingDoesNotHold) {
  EXPECT_FALSE(Number(6, kNoNumber, 1).holds());
  EXPECT_TRUE(Number(kNoNumber, 6, kNoNumber).holds());  // Nothing to compare with.
}

TEST(PaperReport, FilesHoldWhatTheItemHolds) {
  const TempDirectory directory;
  const PaperItem item{"fig1",
                       "t",
                       {Number(1, 2, 0.5)},
                       {{"fig1", {"time [s]", "force [N]"}, {{0, 0.1}, {1, 1e-300}}}}};
  Write(item, directory.path());
  EXPECT_EQ(FileText(directory.path() / "fig1.csv"), "time [s],force [N]\n0,0.1\n1,1e-300\n");
  const auto json = nlohmann::json::parse(FileText(directory.path() / "fig1.json"));
  EXPECT_FALSE(json["holds"]);
  EXPECT_EQ(json["numbers"][0]["deviation"], 1.0);
  EXPECT_TRUE(json["numbers"][0]["converged"].is_null());
}

TEST(PaperReport, NumbersAreWrittenAsATableToo) {
  const TempDirectory directory;
  Write({"table2", "The title", {Number(1, 2, 0.5)}, {}}, directory.path());
  EXPECT_THAT(FileText(directory.path() / "table2.txt"),
              testing::AllOf(testing::StartsWith("The title\n\n"), HasSubstr("DIFFERS")));
}

TEST(PaperReport, AnItemWithoutNumbersHasDataAlone) {
  const TempDirectory directory;
  Write({"fig1", "t", {}, {{"fig1", {"time [s]"}, {{0}}}}}, directory.path());
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "fig1.csv"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "fig1.json"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "fig1.txt"));
}

TEST(PaperReport, AnItemWithoutNumbersHasNoSummary) {
  EXPECT_EQ(Summary({{"fig1", "t", {}, {}}}, Style{}), "");
}

TEST(PaperReport, ALimitIsMetExactlyDespiteRounding) {
  EXPECT_TRUE(Number(0.7, 0.8, 0.1).holds());  // 0.8 - 0.7 > 0.1 in binary.
  EXPECT_FALSE(Number(0.7, 0.8, 0.0999).holds());
}

TEST(Short, HasFiveDigitsAndNothingForNaN) {
  EXPECT_EQ(Short(0.123456789), "0.12346");
  EXPECT_EQ(Short(kNoNumber), "");
}

}  // namespace
}  // namespace contact::cli
