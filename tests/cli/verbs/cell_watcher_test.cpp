#include "cli/verbs/sweep/cell_watcher.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/verbs/verb_case.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

v1::Event CellEvent(int index, double metric) {
  v1::Event event;
  event.mutable_sweep_cell()->set_index(index);
  event.mutable_sweep_cell()->add_metrics(metric);
  return event;
}

v1::Event ProgressEvent(int done, int cells) {
  v1::Event event;
  event.mutable_progress()->set_cells(cells);
  event.mutable_progress()->set_cells_done(done);
  return event;
}

// What a watcher writes to the standard error, from its first event to its end.
template <class Show>
std::string Said(ProgressForm form, Show show) {
  testing::internal::CaptureStderr();
  {
    CellWatcher watcher("abc", form);
    show(watcher);
  }
  std::fflush(stderr);
  return testing::internal::GetCapturedStderr();
}

TEST(CellCollectorTest, NewestStateOfEachCellIsKeptInOrder) {
  CellCollector collector;
  for (const int index : {3, 0, 2}) collector.OnEvent(CellEvent(index, index));
  collector.OnEvent(CellEvent(0, 7));
  collector.OnEvent(ProgressEvent(3, 4));
  const SweepCells cells = collector.Take();
  std::vector<int> indices;
  for (const auto& [index, cell] : cells) indices.push_back(index);
  EXPECT_THAT(indices, ElementsAre(0, 2, 3));
  EXPECT_DOUBLE_EQ(cells.at(0).metrics(0), 7);
}

TEST(CellWatcherTest, GathersCellsInEveryFormOfProgress) {
  for (const ProgressForm form :
       {ProgressForm::kNone, ProgressForm::kBar, ProgressForm::kLines, ProgressForm::kJson}) {
    Said(form, [](CellWatcher& watcher) {
      watcher.OnEvent(CellEvent(0, 1));
      watcher.OnEvent(ProgressEvent(1, 2));
      watcher.OnEvent(CellEvent(1, 1));
      EXPECT_EQ(watcher.Take().size(), 2U);
    });
  }
}

TEST(CellWatcherTest, WithoutProgressNothingIsSaid) {
  EXPECT_EQ(Said(ProgressForm::kNone,
                 [](CellWatcher& watcher) {
                   for (int i = 0; i <= 50; ++i) watcher.OnEvent(ProgressEvent(i, 50));
                 }),
            "");
}

TEST(CellWatcherTest, LinesTellEachTenthOnce) {
  const std::string said = Said(ProgressForm::kLines, [](CellWatcher& watcher) {
    for (int i = 0; i <= 200; ++i) watcher.OnEvent(ProgressEvent(i, 200));
  });
  std::vector<std::string> begins;
  for (const std::string& line : Lines(said)) begins.push_back(line.substr(0, line.find(" cells")));
  EXPECT_THAT(begins,
              ElementsAre("20 of 200", "40 of 200", "60 of 200", "80 of 200", "100 of 200",
                          "120 of 200", "140 of 200", "160 of 200", "180 of 200", "200 of 200"));
}

TEST(CellWatcherTest, LinesCountFailedAndUnconvergedCells) {
  const std::string said = Said(ProgressForm::kLines, [](CellWatcher& watcher) {
    v1::Event event = ProgressEvent(4, 4);
    event.mutable_progress()->set_cells_failed(2);
    event.mutable_progress()->set_cells_not_converged(1);
    watcher.OnEvent(event);
  });
  EXPECT_THAT(said, testing::StartsWith("4 of 4 cells, 2 failed, 1 not converged"));
}

TEST(CellWatcherTest, BarIsOneLineThatIsErasedAtTheEnd) {
  const std::string said = Said(ProgressForm::kBar, [](CellWatcher& watcher) {
    watcher.OnEvent(ProgressEvent(1, 3));
    watcher.OnEvent(ProgressEvent(2, 3));
  });
  EXPECT_THAT(said, testing::Not(HasSubstr("\n")));
  EXPECT_THAT(said, HasSubstr("\r\x1b[K2 of 3 cells"));
  EXPECT_TRUE(said.ends_with("\r\x1b[K"));
}

TEST(CellWatcherTest, LostConnectionTakesThePlaceOfTheBar) {
  const std::string said = Said(ProgressForm::kBar, [](CellWatcher& watcher) {
    watcher.OnEvent(ProgressEvent(1, 3));
    watcher.OnLost("reset");
    watcher.OnRegained();
  });
  EXPECT_TRUE(said.ends_with("\r\x1b[Kconnection lost (reset); trying again\nconnected again\n"));
}

TEST(CellWatcherTest, LastLineOfJsonIsTheStateOfTheEndedJob) {
  const std::string said = Said(ProgressForm::kJson, [](CellWatcher& watcher) {
    watcher.OnEvent(ProgressEvent(1, 3));
    v1::Job job;
    *job.mutable_progress() = ProgressEvent(3, 3).progress();
    watcher.OnSnapshot(job);
  });
  const std::vector<std::string> lines = Lines(said);
  ASSERT_FALSE(lines.empty());
  const auto last = nlohmann::json::parse(lines.back());
  EXPECT_EQ(last["job"], "abc");
  EXPECT_EQ(last["kind"], "sweep");
  EXPECT_EQ(last["cells_done"], 3);
  EXPECT_DOUBLE_EQ(last["done"], 1.0);
}

}  // namespace
}  // namespace contact::cli
