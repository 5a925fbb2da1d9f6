#include "cli/base/csv.h"

#include <gmock/gmock.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>

namespace contact::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// Reads CSV as RFC 4180 says.
Rows ReadRows(const std::string& text) {
  Rows rows;
  std::vector<std::string> row(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      if (quoted && i + 1 < text.size() && text[i + 1] == '"') {
        row.back() += text[++i];
      } else {
        quoted = !quoted;
      }
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back(std::move(row));
      row.assign(1, "");
    } else {
      row.back() += c;
    }
  }
  return rows;
}

std::string Formatted(double value, int precision = 0) {
  std::string text;
  AppendNumber(value, precision, &text);
  return text;
}

TEST(Csv, FieldsSurviveAReader) {
  std::mt19937 random(1);
  const std::string alphabet = "a,\"\n\r ;'\xCE\xBC";
  Rows rows(50, std::vector<std::string>(4));
  std::string text;
  CsvWriter csv(&text);
  for (auto& row : rows) {
    for (std::string& field : row) {
      for (std::size_t size = random() % 8; size > 0; --size) {
        field += alphabet[random() % alphabet.size()];
      }
    }
    csv.Row(row);
  }
  EXPECT_EQ(ReadRows(text), rows);
}

TEST(Csv, OnlyFieldsThatNeedThemHaveQuotes) {
  std::string text;
  CsvWriter(&text).Row({"B1.velocity [m/s]", "a,b", "say \"no\"", "", "two\nlines"});
  EXPECT_EQ(text, "B1.velocity [m/s],\"a,b\",\"say \"\"no\"\"\",,\"two\nlines\"\n");
}

TEST(Csv, WordsAndNumbersShareARow) {
  std::string text;
  CsvWriter csv(&text);
  csv.Add("B1").Add(0.1).Add(-2).EndRow();
  csv.Add("").Add(1e300).Add("x").EndRow();
  EXPECT_EQ(text, "B1,0.1,-2\n,1e+300,x\n");
}

TEST(Csv, ARowStartsWithoutACommaAfterTheTextWasTaken) {
  std::string text;
  CsvWriter csv(&text);
  csv.Add(1.0).EndRow();
  text.clear();
  csv.Add(2.0).EndRow();
  EXPECT_EQ(text, "2\n");
}

TEST(Number, EveryNumberReadsBackAsTheSameDouble) {
  std::mt19937_64 random(1);
  std::vector<double> values = {0,
                                -0.0,
                                0.1,
                                std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::min(),
                                std::numeric_limits<double>::max(),
                                -std::numeric_limits<double>::infinity()};
  while (values.size() < 2000) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isnan(value)) values.push_back(value);
  }
  for (const double value : values) {
    const std::string text = Formatted(value);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
  }
  EXPECT_EQ(Formatted(std::nan("")), "nan");
}

TEST(Number, PrecisionIsTheNumberOfSignificantDigits) {
  EXPECT_EQ(Formatted(1.0 / 3, 6), "0.333333");
  EXPECT_EQ(Formatted(123456789, 3), "1.23e+08");
  EXPECT_EQ(Formatted(0.1, 17), "0.10000000000000001");
}

}  // namespace
}  // namespace contact::cli
