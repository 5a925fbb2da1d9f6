#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/export/data_table.h"
#include "cli/export/writers.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;

// What a writer writes.
template <class Write>
std::string Written(Write write) {
  char* data = nullptr;
  std::size_t size = 0;
  std::FILE* file = open_memstream(&data, &size);
  write(file);
  std::fclose(file);
  std::string text(data, size);
  std::free(data);
  return text;
}

std::string Csv(const DataTable& table, int precision = 0) {
  return Written([&](std::FILE* file) { WriteCsv(table, file, precision); });
}

std::vector<nlohmann::json> JsonLines(const DataTable& table, int precision = 0) {
  std::istringstream lines(
      Written([&](std::FILE* file) { WriteJsonLines(table, file, precision); }));
  std::vector<nlohmann::json> objects;
  for (std::string line; std::getline(lines, line);) objects.push_back(nlohmann::json::parse(line));
  return objects;
}

DataTable Example() {
  const std::vector<std::string> words = {"B1", "a \"b\",\n\\", "μ"};
  const std::vector<double> numbers = {0.1, std::nan(""), -std::numeric_limits<double>::infinity()};
  return {"bodies", "body", {{"name", "", "", words}, {"velocity", "m/s", "", numbers}}};
}

std::vector<std::string> Headers(const DataTable& table) {
  std::vector<std::string> headers;
  for (const DataColumn& column : table.columns) headers.push_back(column.Header());
  return headers;
}

TEST(ExportCsv, HeadersHaveUnitsAndWordsQuotesWhereTheyNeedThem) {
  EXPECT_EQ(Csv(Example()), "name,velocity [m/s]\nB1,0.1\n\"a \"\"b\"\",\n\\\",nan\nμ,-inf\n");
}

TEST(ExportCsv, ATableWithoutRowsHasItsHeader) {
  EXPECT_EQ(Csv(CyclesTable(v1::Job())).find('\n'), Csv(CyclesTable(v1::Job())).size() - 1);
  EXPECT_EQ(Csv(BodiesTable(v1::Job())), "name,position [m],velocity [m/s]\n");
}

TEST(ExportCsv, NothingIsLostBetweenBlocks) {
  std::vector<double> numbers(50'000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i) / 3;
  std::istringstream lines(Csv({"series", "time", {{"time", "s", "", numbers}}}));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time [s]");
  for (const double number : numbers) {
    ASSERT_TRUE(std::getline(lines, line));
    ASSERT_EQ(std::stod(line), number);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(ExportCsv, PrecisionRoundsNumbersOnly) {
  const DataTable table{"t",
                        "r",
                        {{"a", "1", "", std::vector<double>{2.0 / 3}},
                         {"b", "", "", std::vector<std::string>{"0.12345"}}}};
  EXPECT_EQ(Csv(table, 3), "a [1],b\n0.667,0.12345\n");
}

TEST(ExportJsonLines, EveryLineIsAnObjectWithTheHeadersOfCsv) {
  const std::vector<nlohmann::json> rows = JsonLines(Example());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["name"], "B1");
  EXPECT_EQ(rows[0]["velocity [m/s]"], 0.1);
  EXPECT_EQ(rows[1]["name"], "a \"b\",\n\\");
  EXPECT_EQ(rows[2]["name"], "μ");
  EXPECT_EQ(rows[0].size(), 2U);
}

TEST(ExportJsonLines, NumbersThatJsonLacksAreNull) {
  const std::vector<nlohmann::json> rows = JsonLines(Example());
  EXPECT_TRUE(rows.at(1)["velocity [m/s]"].is_null());
  EXPECT_TRUE(rows.at(2)["velocity [m/s]"].is_null());
}

TEST(ExportJsonLines, NumbersReadBackAsTheSameDoubles) {
  const std::vector<double> numbers = {1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22};
  const auto rows = JsonLines({"t", "r", {{"a", "1", "", numbers}}});
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(rows.at(i)["a [1]"].get<double>(), numbers[i]);
  }
  EXPECT_EQ(JsonLines({"t", "r", {{"a", "1", "", std::vector{1.0 / 3}}}}, 2)[0]["a [1]"], 0.33);
}

// A column for each field, with a unit if it holds numbers, or words that are lists of numbers.
void ExpectComplete(const DataTable& table, const google::protobuf::Descriptor& type) {
  EXPECT_EQ(table.columns.size(), static_cast<std::size_t>(type.field_count()));
  for (const DataColumn& column : table.columns) {
    const bool words = std::holds_alternative<std::vector<std::string>>(column.values);
    EXPECT_EQ(column.unit.empty(), words && column.name != "other_roots") << column.name;
    EXPECT_FALSE(column.description.empty()) << column.name;
  }
}

TEST(DataTable, EveryFieldOfTheLedgerIsAColumn) {
  ExpectComplete(CyclesTable(v1::Job()), *v1::Cycle::descriptor());
  ExpectComplete(GroupsTable(v1::Job()), *v1::Group::descriptor());
}

TEST(DataTable, CutCycleHasItsStatusAndNoNumberForWhatTheEndHides) {
  v1::Job job;
  v1::Cycle& cycle = *job.add_cycles();
  cycle.set_status(v1::Cycle::CUT);
  cycle.set_peak_force_n(std::numeric_limits<double>::quiet_NaN());
  cycle.set_mu(3);
  const DataTable table = CyclesTable(job);
  const auto values = [&table](const std::string& name) {
    return std::ranges::find(table.columns, name, &DataColumn::name)->values;
  };
  EXPECT_EQ(std::get<std::vector<std::string>>(values("status")).at(0), "CUT");
  EXPECT_TRUE(std::isnan(std::get<std::vector<double>>(values("peak_force")).at(0)));
  EXPECT_EQ(std::get<std::vector<double>>(values("mu")).at(0), 3);
}

TEST(DataTable, EveryGroupIsARow) {
  v1::Job job;
  for (const double mu : {3.0, 4.0}) {
    v1::Group& group = *job.add_groups();
    group.set_mu(mu);
    group.set_growth(v1::Group::TOO_LITTLE);
    group.add_other_roots(2 * mu), group.add_other_roots(1e8);
  }
  const DataTable table = GroupsTable(job);
  EXPECT_EQ(table.name, "groups");
  const auto column = [&](const std::string& header) {
    return *std::ranges::find(table.columns, header, &DataColumn::Header);
  };
  EXPECT_THAT(std::get<std::vector<double>>(column("mu [N·s/m^(n+1)]").values), ElementsAre(3, 4));
  EXPECT_THAT(std::get<std::vector<std::string>>(column("growth").values),
              ElementsAre("TOO_LITTLE", "TOO_LITTLE"));
  EXPECT_THAT(std::get<std::vector<std::string>>(column("other_roots [N·s/m^(n+1)]").values),
              ElementsAre("6 100000000", "8 100000000"));
}

TEST(DataTable, RowsOfTheLedgerHaveTheValuesOfTheCycles) {
  v1::Job job;
  v1::Cycle& cycle = *job.add_cycles();
  cycle.set_contact("B1-B2");
  cycle.set_number(3);
  cycle.set_mu(2.5e8);
  cycle.set_approach_velocity_m_per_s(0.2);
  const DataTable table = CyclesTable(job);
  std::map<std::string, std::variant<std::vector<double>, std::vector<std::string>>> columns;
  for (const DataColumn& column : table.columns) columns[column.Header()] = column.values;
  EXPECT_EQ(columns.at("contact"),
            decltype(columns)::mapped_type(std::vector<std::string>{"B1-B2"}));
  EXPECT_EQ(columns.at("number [1]"), decltype(columns)::mapped_type(std::vector<double>{3}));
  EXPECT_EQ(columns.at("mu [N·s/m^(n+1)]"),
            decltype(columns)::mapped_type(std::vector<double>{2.5e8}));
  EXPECT_EQ(columns.at("approach_velocity [m/s]"),
            decltype(columns)::mapped_type(std::vector<double>{0.2}));
  EXPECT_EQ(columns.at("status"), decltype(columns)::mapped_type(std::vector<std::string>{""}));
}

TEST(DataTable, EveryUnknownOfAPassIsARow) {
  v1::Iteration pass;
  pass.set_episode(2);
  pass.set_number(5);
  pass.set_accepted(true);
  for (const double mu : {1.0, 2.0}) pass.add_unknowns()->set_mu(mu);
  const DataTable table = IterationsTable({pass, pass});
  EXPECT_THAT(Headers(table),
              ElementsAre("episode [1]", "pass [1]", "start_time [s]", "accepted [1]", "contact",
                          "cycle [1]", "mu [N·s/m^(n+1)]", "restitution_out [1]",
                          "restitution_in [1]", "residual [1]", "bracket_low [N·s/m^(n+1)]",
                          "bracket_high [N·s/m^(n+1)]", "update"));
  EXPECT_EQ(table.rows(), 4U);
  EXPECT_THAT(std::get<std::vector<double>>(table.columns[6].values), ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(std::get<std::vector<double>>(table.columns[3].values), ElementsAre(1, 1, 1, 1));
}

TEST(DataTable, SeriesHaveTheColumnsOfTheRecording) {
  Recording recording;
  recording.columns = {{"time", "time", "s", {0, 1}},
                       {"B1-B2.contact_force", "contact_force", "N", {2, 3}}};
  const DataTable table = SeriesTable(std::move(recording));
  EXPECT_THAT(Headers(table), ElementsAre("time [s]", "B1-B2.contact_force [N]"));
  EXPECT_EQ(table.columns[0].description, "simulated time");
  EXPECT_EQ(table.columns[1].description, "contact force of B1-B2");
  EXPECT_EQ(table.rows(), 2U);
}

}  // namespace
}  // namespace contact::cli
