#include "cli/figures/run/presets.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "testing/sample_run.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::SizeIs;

using Curve = Figure::Curve;

void Forget(const std::string& ending, Recording* run) {
  std::erase_if(run->columns, [&](const auto& column) { return column.name.ends_with(ending); });
}

// What PresetFigure complains about; empty if it makes the figure.
std::string Complaint(const std::string& preset, const Recording& run) {
  try {
    PresetFigure(preset, run);
    return "";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    return failure.what();
  }
}

TEST(Presets, EveryPresetShowsCurvesWhoseAxesHaveUnits) {
  for (const std::string& preset : PresetNames()) {
    SCOPED_TRACE(preset);
    const Figure figure = PresetFigure(preset, SampleRun());
    EXPECT_EQ(figure.title, "Two balls & a <wall>");
    EXPECT_THAT(figure.sources, SizeIs(1));
    for (const Figure::Panel& panel : figure.panels) {
      EXPECT_THAT(panel.curves, Not(IsEmpty()));
      if (!panel.counted_x) {
        EXPECT_THAT(panel.x_label, MatchesRegex(".* \\[.+\\]"));
      }
      if (preset != "restitution") {
        EXPECT_THAT(panel.y_label, MatchesRegex(".* \\[.+\\]"));
      }
      for (const Curve& curve : panel.curves) EXPECT_EQ(curve.x.size(), curve.y.size());
    }
  }
}

TEST(Presets, AColumnThatIsMissingIsNamed) {
  const std::pair<const char*, const char*> needs[] = {
      {"position", ".position"},
      {"velocity", ".velocity"},
      {"force", ".contact_force"},
      {"force", ".external_force"},
      {"deformation-velocity", ".deformation_velocity"},
      {"hysteresis", ".deformation"},
      {"hysteresis", ".contact_force"},
      {"energy", ".velocity"},
      {"energy", ".deformation"}};
  for (const auto& [preset, column] : needs) {
    SCOPED_TRACE(std::string(preset) + column);
    Recording run = SampleRun();
    Forget(column, &run);
    EXPECT_THAT(Complaint(preset, run), HasSubstr("output.ledger_only"));
  }
}

TEST(Presets, LedgerAndIterationsNeedNoTrajectory) {
  Recording run = SampleRun();
  run.columns.clear();
  EXPECT_EQ(Complaint("restitution", run), "");
  EXPECT_EQ(Complaint("iterations", run), "");
}

TEST(Presets, WhatHasNothingToShowIsTold) {
  Recording run = SampleRun();
  run.job.clear_cycles();
  run.iterations.clear();
  EXPECT_EQ(Complaint("hysteresis", run), "this run has nothing to show there");
  EXPECT_EQ(Complaint("restitution", run), "this run has nothing to show there");
  EXPECT_EQ(Complaint("iterations", run), "this run iterated nothing");
  EXPECT_EQ(Complaint("velocity", run), "");
}

TEST(Presets, CyclesAreBandsAndMarksInTheColourOfTheirContact) {
  const Figure::Panel panel = PresetFigure("force", SampleRun()).panels.at(0);
  ASSERT_THAT(panel.bands, SizeIs(2));
  EXPECT_EQ(panel.bands[1].start, 0.5);
  EXPECT_EQ(panel.bands[1].end, 1);
  EXPECT_EQ(panel.bands[1].colour, 1);
  const auto mark = [](Figure::Mark kind, int colour) {
    return AllOf(Field(&Curve::mark, kind), Field(&Curve::colour, colour));
  };
  EXPECT_THAT(panel.curves,
              Contains(AllOf(mark(Figure::Mark::kStart, 1), Field(&Curve::x, ElementsAre(0.5)))));
  EXPECT_THAT(panel.curves,
              Contains(AllOf(mark(Figure::Mark::kEnd, 0), Field(&Curve::x, ElementsAre(0.5)))));
}

TEST(Presets, BandOfAGroupSpansItsCycles) {
  Recording run = SampleRun();
  v1::Job& job = run.job;
  *job.add_cycles() = job.cycles(1);
  for (const int cycle : {1, 2}) job.mutable_cycles(cycle)->set_group(1);
  v1::Group& group = *job.add_groups();
  group.set_contact("W");
  group.set_start_time_s(0.25);
  group.set_end_time_s(1);
  const Figure::Panel panel = PresetFigure("force", run).panels.at(0);
  ASSERT_THAT(panel.bands, SizeIs(2));  // The cycle of A-B is in no group.
  EXPECT_EQ(panel.bands[0].end, 0.5);
  EXPECT_EQ(panel.bands[1].start, 0.25);
  EXPECT_EQ(panel.bands[1].end, 1);
}

TEST(Presets, CycleHasTheRestitutionOfItsGroup) {
  Recording run = SampleRun();
  run.job.mutable_cycles(1)->set_group(1);
  v1::Group& group = *run.job.add_groups();
  group.set_contact("W");
  group.set_number(1);
  group.set_restitution_out(0.8);
  const Figure::Panel panel = PresetFigure("restitution", run).panels.at(0);
  EXPECT_THAT(panel.curves,
              Contains(AllOf(Field(&Curve::label, "W had"), Field(&Curve::y, ElementsAre(0.8)))));
  EXPECT_THAT(panel.curves, Contains(AllOf(Field(&Curve::label, "A-B had"),
                                           Field(&Curve::y, ElementsAre(0.79)))));
}

TEST(Presets, MarksLieOnTheirCurveBetweenSamples) {
  Recording run = SampleRun();
  run.job.mutable_cycles(0)->set_start_time_s(0.3);  // Position is twice the time.
  const Figure::Panel panel = PresetFigure("position", run).panels.at(0);
  EXPECT_THAT(panel.curves, Contains(AllOf(Field(&Curve::mark, Figure::Mark::kStart),
                                           Field(&Curve::x, ElementsAre(0.3)),
                                           Field(&Curve::y, ElementsAre(testing::DoubleEq(0.6))))));
}

TEST(Presets, WallIsWhereTheCentreOfTheBallStopsAtFirstTouch) {
  EXPECT_THAT(PresetFigure("position", SampleRun()).panels.at(0).dotted_lines, ElementsAre(1.25));
}

TEST(Presets, LoopsHoldTheSamplesOfTheirCycleOnly) {
  const Figure::Panel panel = PresetFigure("hysteresis", SampleRun()).panels.at(0);
  EXPECT_THAT(panel.curves.at(0).x, SizeIs(33));  // 0 to 0.5 s, both ends included.
  EXPECT_EQ(panel.curves.at(0).label, "A-B");
}

TEST(Presets, PeaksOfCyclesWithTooFewSamplesHaveNoLabel) {
  Recording run = SampleRun();
  EXPECT_THAT(PresetFigure("force", run).panels.at(0).labels,
              ElementsAre(Field(&Figure::Label::text, "μ/k = 0.5 s/m"), testing::_));
  run.job.mutable_cycles(0)->set_end_time_s(0.1);
  EXPECT_THAT(PresetFigure("force", run).panels.at(0).labels, SizeIs(1));
}

TEST(Presets, ResidualOfZeroStaysOnALogarithmicAxis) {
  const std::vector<Figure::Panel> panels = PresetFigure("iterations", SampleRun()).panels;
  ASSERT_THAT(panels, SizeIs(2));
  EXPECT_THAT(panels[0].curves.at(0).y, ElementsAre(1e6, 2e6, 3e6));
  EXPECT_TRUE(panels[1].log_y);
  EXPECT_THAT(panels[1].curves.at(0).y, Each(testing::Gt(0)));
}

TEST(Presets, OnlyTheEpisodeWithMostPassesIsShown) {
  Recording run = SampleRun();
  v1::Iteration other = run.iterations.front();
  other.set_episode(2);
  run.iterations.push_back(other);
  const Figure::Panel panel = PresetFigure("iterations", run).panels.at(0);
  EXPECT_EQ(panel.x_label, "pass of episode 1");
  EXPECT_THAT(panel.curves.at(0).x, ElementsAre(0, 1, 2));
}

TEST(Presets, SumOfEnergyIsThatOfItsParts) {
  const Figure::Panel panel = PresetFigure("energy", SampleRun()).panels.at(0);
  const std::vector<double>& sum = panel.curves.back().y;
  EXPECT_EQ(panel.curves.back().label, "sum");
  for (std::size_t i = 0; i < sum.size(); ++i) {
    double parts = 0;
    for (std::size_t c = 0; c + 1 < panel.curves.size(); ++c) parts += panel.curves[c].y[i];
    EXPECT_DOUBLE_EQ(sum[i], parts);
  }
}

}  // namespace
}  // namespace contact::cli
