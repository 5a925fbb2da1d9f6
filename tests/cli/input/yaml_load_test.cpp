#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/base/failure.h"
#include "cli/input/yaml_document.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

// So many values in a list, one of which it is itself.
std::string List(int values) {
  std::string text = "[";
  for (int i = 1; i < values; ++i) text += "1,";
  return text + "]";
}

TEST(LoadYaml, TakesAMillionValuesAndNoMore) {
  EXPECT_EQ(LoadYaml(List(1'000'000)).first.size(), 999'999U);
  EXPECT_THROW(LoadYaml(List(1'000'001)), YAML::ParserException);
}

TEST(LoadYaml, CountsAValueAsOftenAsItIsReferredTo) {
  const std::string table = "table: &t " + List(1000) + "\nuses: [";
  std::string uses;
  for (int i = 0; i < 998; ++i) uses += "*t,";
  EXPECT_EQ(LoadYaml(table + uses + "]").first["uses"].size(), 998U);
  EXPECT_THROW(LoadYaml(table + uses + "*t,]"), YAML::ParserException);
}

TEST(LoadYaml, RefusesWhatDoublesWithoutEndAtOnce) {
  std::string text = "- &a0 [1]\n";
  for (int i = 1; i < 1000; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "- &a" + std::to_string(i) + " [" + before + "," + before + "]\n";
  }
  EXPECT_THROW(LoadYaml(text), YAML::ParserException);
}

// Of such texts yaml-cpp finds documents without end.
TEST(LoadYaml, ReadsTwoDocumentsAtMost) {
  const YamlText text = LoadYaml("{},");
  ASSERT_TRUE(text.second);
  EXPECT_EQ(text.second->column, 2);
  EXPECT_FALSE(LoadYaml("{}").second);
  EXPECT_FALSE(LoadYaml("").second);
}

TEST(ReadYaml, RefusesAFileWithoutEnd) {
  EXPECT_THROW(ReadYaml("/dev/zero"), Failure);
  const TempDirectory folder;
  const std::string path = folder.path() / "large.yaml";
  std::ofstream(path) << "# ";
  std::filesystem::resize_file(path, 16 << 20);
  EXPECT_EQ(ReadYaml(path).size(), std::size_t{16} << 20);
  std::filesystem::resize_file(path, (16 << 20) + 1);
  EXPECT_THROW(ReadYaml(path), Failure);
}

}  // namespace
}  // namespace contact::cli
