#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "cli/text/render_progress.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

v1::Progress RunAt(double time_s) {
  v1::Progress progress;
  progress.set_time_s(time_s);
  progress.set_end_time_s(4);
  progress.set_cycles(3);
  return progress;
}

// What is written while `act` has the progress.
template <class Act>
std::string Told(Act act) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    JsonProgress progress(stream, "abc");
    act(progress);
  }
  std::fclose(stream);
  std::string written(text, size);
  std::free(text);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream wants it.
  return written;
}

TEST(JsonProgress, LineTellsARunInJson) {
  EXPECT_EQ(ProgressJson(RunAt(1), "abc", 2),
            R"({"kind":"run","job":"abc","done":0.25,"time_s":1.0,"end_time_s":4.0,"steps":0,)"
            R"("cycles":3,"iterations":0,"busy_with":"","eta_s":6.0})"
            "\n");
  EXPECT_THAT(ProgressJson(RunAt(0), "abc", 2), HasSubstr(R"("eta_s":null)"));
}

TEST(JsonProgress, LineTellsASweepInJson) {
  v1::Progress progress;
  progress.set_cells(8);
  progress.set_cells_done(2);
  progress.set_cells_failed(1);
  EXPECT_EQ(ProgressJson(progress, "abc", 1),
            R"({"kind":"sweep","job":"abc","done":0.25,"cells":8,"cells_done":2,)"
            R"("cells_failed":1,"cells_not_converged":0,"eta_s":3.0})"
            "\n");
}

TEST(JsonProgress, AtMostTenLinesASecondAreToldAndTheLastOneAlways) {
  const auto start = JsonProgress::Clock::now();
  const std::string text = Told([start](JsonProgress& progress) {
    for (int i = 0; i <= 25; ++i) progress.Update(RunAt(i * 0.1), start + i * 10ms);
  });
  std::vector<double> times;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    times.push_back(nlohmann::json::parse(line)["time_s"]);
  }
  EXPECT_THAT(times, ElementsAre(0, 1, 2, 2.5));
}

TEST(JsonProgress, NothingIsToldBeforeAnythingIsKnown) {
  EXPECT_EQ(Told([](JsonProgress& progress) { progress.Update({}); }), "");
}

}  // namespace
}  // namespace contact::cli
