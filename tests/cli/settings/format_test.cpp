#include "cli/settings/format.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>

#include "cli/base/failure.h"
#include "cli/settings/settings.h"

namespace contact::cli {
namespace {

TEST(FormatTest, RowsStandInTheOrderOfTheirEnumerators) {
  for (std::size_t i = 0; i < Formats().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(Formats()[i].format), i) << Formats()[i].name;
  }
}

TEST(FormatTest, EachNameFindsItsFormat) {
  for (const FormatInfo& info : Formats()) {
    EXPECT_EQ(FindFormat(info.name), info.format) << info.name;
  }
  EXPECT_EQ(FindFormat("tabel"), std::nullopt);
  EXPECT_EQ(FindFormat(""), std::nullopt);
}

TEST(FormatTest, AnEndingTellsOneFormatOfEachUse) {
  for (const FormatUse use : {kPrinted, kData, kFigure}) {
    std::set<std::string_view> endings;
    for (const FormatInfo& info : Formats()) {
      if ((info.uses & use) == 0 || info.ending.empty()) continue;
      EXPECT_TRUE(endings.insert(info.ending).second) << info.name;
      EXPECT_EQ(FormatOfFile("some.where/file" + std::string(info.ending), use), info.format);
    }
  }
}

TEST(FormatTest, TheEndingOfAnotherUseOrAFolderTellsNothing) {
  EXPECT_EQ(FormatOfFile("chain.nc", kFigure), std::nullopt);
  EXPECT_EQ(FormatOfFile("chain.svg", kData), std::nullopt);
  EXPECT_EQ(FormatOfFile("results.mat/chain", kData), std::nullopt);
  EXPECT_EQ(FormatOfFile("", kData), std::nullopt);
}

TEST(FormatTest, EndingMayHaveCapitalLetters) {
  EXPECT_EQ(FormatOfFile("FORCE.SVG", kFigure), OutputFormat::kSvg);
}

TEST(FormatTest, UnknownEndingIsRefusedWithThoseThatThereAre) {
  for (const char* path : {"r.h5", "r.xlsx", "results.nc/r.parquet", "r.svg"}) {
    try {
      RequireFormatOfFile(path, kData, OutputFormat::kCsv);
      ADD_FAILURE() << path;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(failure.what()).find("there are .jsonl, .csv, .nc, .mat, .pb"),
                std::string::npos);
    }
  }
}

TEST(FormatTest, NameWithoutEndingSaysNothing) {
  for (const char* path : {"", "chain", "/dev/stdout", "results.h5/chain", ".hidden", "chain."}) {
    EXPECT_EQ(RequireFormatOfFile(path, kData, OutputFormat::kCsv), OutputFormat::kCsv) << path;
  }
  EXPECT_EQ(RequireFormatOfFile("chain.nc", kData, OutputFormat::kCsv), OutputFormat::kNetcdf);
}

TEST(FormatTest, HelpNamesEachFormatOfAUse) {
  EXPECT_EQ(FormatHelp(kData).find("svg"), std::string::npos);
  for (const std::string& name : FormatNames(kData)) {
    EXPECT_NE(FormatHelp(kData).find(name), std::string::npos) << name;
  }
}

TEST(SettingsTest, WideAndYamlAreVariantsOfTableAndJson) {
  Settings settings;
  settings.SetOutput("wide");
  EXPECT_EQ(settings.output, OutputFormat::kTable);
  EXPECT_TRUE(settings.wide);
  settings.SetOutput("yaml");
  EXPECT_EQ(settings.output, OutputFormat::kJson);
  EXPECT_TRUE(settings.yaml);
  EXPECT_FALSE(settings.wide);
}

TEST(SettingsTest, RefusedOutputNamesWhereItStandsAndWhatIsPrinted) {
  Settings settings;
  settings.SetOutput("yaml");
  settings.origins["output"] = "contact.toml:3";
  EXPECT_NO_THROW(settings.RequireOutput({OutputFormat::kJson}));
  try {
    settings.RequireOutput({OutputFormat::kTable, OutputFormat::kCsv});
    FAIL() << "yaml is neither table nor csv";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_STREQ(failure.what(), "contact.toml:3: output yaml: this command prints table, csv");
  }
}

}  // namespace
}  // namespace contact::cli
