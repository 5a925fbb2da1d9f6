#include "cli/figures/run/presets.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

TEST(Presets, CyclesHaveMarksInTheColourOfTheirContact) {
  const Figure::Panel panel = PresetFigure("force", SampleRun()).panels.at(0);
  const auto mark = [](Figure::Mark kind, int colour) {
    return AllOf(Field(&Curve::mark, kind), Field(&Curve::colour, colour));
  };
  EXPECT_THAT(panel.curves,
              Contains(AllOf(mark(Figure::Mark::kStart, 1), Field(&Curve::x, ElementsAre(0.5)))));
  EXPECT_THAT(panel.curves,
              Contains(AllOf(mark(Figure::Mark::kEnd, 0), Field(&Curve::x, ElementsAre(0.5)))));
}

std::vector<std::pair<double, double>> BandsOf(const Recording& run, const FigurePart& part = {}) {
  std::vector<std::pair<double, double>> bands;
  const Figure figure = PresetFigure("force", run, part);
  for (const Figure::Band& band : figure.panels.at(0).bands) {
    bands.emplace_back(band.start, band.end);
  }
  return bands;
}

// Where one shade lay over another there would be a third, which no key explains.
TEST(Presets, BandsOfContactsThatOverlapAreOne) {
  Recording run = SampleRun();
  using testing::Pair;
  EXPECT_THAT(BandsOf(run), ElementsAre(Pair(0, 1)));  // They touch.
  run.job.mutable_cycles(0)->set_end_time_s(0.25);
  EXPECT_THAT(BandsOf(run), ElementsAre(Pair(0, 0.25), Pair(0.5, 1)));
  run.job.mutable_cycles(0)->set_end_time_s(0.75);
  EXPECT_THAT(BandsOf(run), ElementsAre(Pair(0, 1)));
}

TEST(Presets, BandOfAGroupSpansItsCycles) {
  Recording run = SampleRun();
  run.job.mutable_cycles(0)->set_end_time_s(0.125);
  v1::Group& group = *run.job.add_groups();
  group.set_contact("W");
  group.set_start_time_s(0.25);
  group.set_end_time_s(1);
  EXPECT_THAT(BandsOf(run), ElementsAre(testing::Pair(0, 0.125), testing::Pair(0.25, 1)));
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
              Contains(AllOf(Field(&Curve::label, "W"), Field(&Curve::y, ElementsAre(0.8)))));
  EXPECT_THAT(panel.curves,
              Contains(AllOf(Field(&Curve::label, "A-B"), Field(&Curve::y, ElementsAre(0.79)))));
}

TEST(Presets, ErrorsOfTheRestitutionHaveALogarithmicPanel) {
  Recording run = SampleRun();
  run.job.mutable_cycles(1)->set_restitution_out(0.8);  // As it was asked for.
  std::vector<Figure::Panel> panels = PresetFigure("restitution", run).panels;
  ASSERT_THAT(panels, SizeIs(2));
  EXPECT_TRUE(panels[1].log_y);
  EXPECT_THAT(panels[1].curves[0].y, ElementsAre(testing::DoubleNear(0.0125, 1e-12)));
  EXPECT_THAT(panels[1].curves[1].y, ElementsAre(1e-17));
  for (v1::Cycle& cycle : *run.job.mutable_cycles()) cycle.set_restitution_in(NAN);  // μ is given.
  panels = PresetFigure("restitution", run).panels;
  ASSERT_THAT(panels, SizeIs(1));
  EXPECT_THAT(panels[0].curves, Each(Field(&Curve::mark, Figure::Mark::kEnd)));
}

TEST(Presets, MarksLieOnTheirCurveBetweenSamples) {
  Recording run = SampleRun();
  run.job.mutable_cycles(0)->set_start_time_s(0.3);  // Position is twice the time.
  const Figure::Panel panel = PresetFigure("position", run).panels.at(0);
  EXPECT_THAT(panel.curves, Contains(AllOf(Field(&Curve::mark, Figure::Mark::kStart),
                                           Field(&Curve::x, ElementsAre(0.3)),
                                           Field(&Curve::y, ElementsAre(testing::DoubleEq(0.6))))));
}

// The curve with this name; empty if there is none.
Curve Named(const Figure::Panel& panel, const std::string& label) {
  const auto found = std::ranges::find(panel.curves, label, &Curve::label);
  return found == panel.curves.end() ? Curve() : *found;
}

// A run whose cycle of A-B ends compressed: from δ = 0 at 3 m/s to 0.01 m at rest.
Recording RunThatEndsCompressed() {
  Recording run = SampleRun();
  v1::Cycle& cycle = *run.job.mutable_cycles(0);
  cycle.set_start_time_s(0.1);
  cycle.set_end_time_s(0.4);
  cycle.set_end(v1::Cycle::NON_SEPARATION);
  cycle.set_approach_velocity_m_per_s(3);
  cycle.set_delta_end_m(0.01);
  return run;
}

TEST(Presets, MarksStandWhereTheLedgerSaysNotAtTheNearestSample) {
  const Recording run = RunThatEndsCompressed();
  const Figure::Panel force = PresetFigure("force", run).panels.at(0);
  EXPECT_THAT(Named(force, "A-B starts").y, ElementsAre(0));
  EXPECT_THAT(Named(force, "A-B ends").y, ElementsAre(testing::DoubleEq(1e8 * 0.001)));  // k δ^1.5
  const Figure::Panel speed = PresetFigure("deformation-velocity", run).panels.at(0);
  EXPECT_THAT(Named(speed, "A-B starts").y, ElementsAre(3));
  EXPECT_THAT(Named(speed, "A-B ends").y, ElementsAre(0));
}

TEST(Presets, DamperThatDoesNotFadeHasAForceAtTheStart) {
  Recording run = RunThatEndsCompressed();
  v1::Contact& contact = *run.job.mutable_scenario()->mutable_contacts(0);
  contact.set_damping(v1::Contact::KELVIN_VOIGT);
  contact.set_exponent(1);
  run.job.mutable_cycles(0)->set_mu(20);
  EXPECT_THAT(Named(PresetFigure("force", run).panels.at(0), "A-B starts").y, ElementsAre(60));
}

TEST(Presets, EndOfACycleThatTheRunCutsIsThatOfTheCurve) {
  Recording run = RunThatEndsCompressed();
  run.job.mutable_cycles(0)->set_end(v1::Cycle::RUN_END);
  const double at_end = 100 * std::sin(0.4);  // Of the sample run.
  EXPECT_THAT(Named(PresetFigure("force", run).panels.at(0), "A-B ends").y,
              ElementsAre(testing::DoubleNear(at_end, 0.01)));
}

TEST(Presets, DisplacementIsThePositionLessThatAtTheStart) {
  const Figure::Panel position = PresetFigure("position", SampleRun()).panels.at(0);
  const Figure::Panel panel = PresetFigure("displacement", SampleRun()).panels.at(0);
  EXPECT_EQ(panel.y_label, "displacement [m]");
  const Curve here = Named(position, "B"), moved = Named(panel, "B");
  ASSERT_EQ(here.y.size(), moved.y.size());
  for (std::size_t i = 0; i < here.y.size(); ++i) EXPECT_DOUBLE_EQ(moved.y[i], here.y[i] - 1);
  EXPECT_THAT(Named(panel, "B, A-B ends").y, ElementsAre(testing::DoubleEq(2 * 0.5 - 1)));
}

TEST(Presets, WallIsWhereTheCentreOfTheBallStopsAtFirstTouch) {
  EXPECT_THAT(PresetFigure("position", SampleRun()).panels.at(0).dotted_lines, ElementsAre(1.25));
}

TEST(Presets, LoopsHoldTheSamplesOfTheirCycleOnly) {
  const Figure::Panel panel = PresetFigure("hysteresis", SampleRun()).panels.at(0);
  EXPECT_THAT(panel.curves.at(0).x, SizeIs(33));  // 31 samples between 0 and 0.5 s, and both ends.
  EXPECT_EQ(panel.curves.at(0).label, "A-B");
}

TEST(Presets, LoopsCloseWhereTheCycleSeparates) {
  const Curve loop = Named(PresetFigure("hysteresis", SampleRun()).panels.at(0), "W");
  EXPECT_EQ(std::pair(loop.x.front(), loop.y.front()), std::pair(0.0, 0.0));
  EXPECT_EQ(std::pair(loop.x.back(), loop.y.back()), std::pair(0.0, 0.0));
  const Figure::Panel open = PresetFigure("hysteresis", RunThatEndsCompressed()).panels.at(0);
  EXPECT_THAT(Named(open, "A-B starts").x, ElementsAre(0));
  EXPECT_THAT(Named(open, "A-B ends").x, ElementsAre(0.01));
  EXPECT_EQ(Named(open, "A-B").y.back(), Named(open, "A-B ends").y.front());
}

TEST(Presets, OnlyTheFirstLoopOfAContactIsInTheKey) {
  Recording run = SampleRun();
  v1::Cycle second = run.job.cycles(1);
  second.set_contact("A-B");
  second.set_number(2);
  *run.job.add_cycles() = second;
  const Figure::Panel panel = PresetFigure("hysteresis", run).panels.at(0);
  EXPECT_TRUE(Named(panel, "A-B").keyed);
  EXPECT_FALSE(Named(panel, "A-B #2").keyed);
  EXPECT_THAT(Named(panel, "A-B #2").x, Not(IsEmpty()));
}

TEST(Presets, PeaksOfCyclesWithTooFewSamplesHaveNoLabel) {
  Recording run = SampleRun();
  EXPECT_THAT(PresetFigure("force", run).panels.at(0).labels,
              ElementsAre(Field(&Figure::Label::text, "μ/k = 0.5 s/m"), testing::_));
  run.job.mutable_cycles(0)->set_end_time_s(0.1);
  EXPECT_THAT(PresetFigure("force", run).panels.at(0).labels, SizeIs(1));
}

// A run of one contact with a cycle every 10 ms, a peak each.
Recording RunWithPeaks(const std::vector<double>& peaks) {
  Recording run = SampleRun();
  const v1::Cycle cycle = run.job.cycles(0);
  run.job.clear_cycles();
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    v1::Cycle& next = *run.job.add_cycles() = cycle;
    next.set_turn_time_s(0.03 * static_cast<double>(i + 1));
    next.set_end_time_s(1);
    next.set_peak_force_n(peaks[i]);
  }
  return run;
}

std::vector<double> LabelledPeaks(const Recording& run) {
  std::vector<double> peaks;
  const Figure figure = PresetFigure("force", run);
  for (const auto& label : figure.panels.at(0).labels) peaks.push_back(label.y);
  return peaks;
}

TEST(Presets, LabelsStandAtTheLargestPeaksInTheOrderOfTime) {
  std::vector<double> peaks;
  for (int i = 0; i < 20; ++i) peaks.push_back(100 + i);
  std::vector<double> largest(peaks.end() - 12, peaks.end());
  EXPECT_EQ(LabelledPeaks(RunWithPeaks(peaks)), largest);
  std::ranges::reverse(peaks);
  std::ranges::reverse(largest);
  EXPECT_EQ(LabelledPeaks(RunWithPeaks(peaks)), largest);
}

TEST(Presets, OfPeaksAtTheSameTimeTheLargestHasTheLabel) {
  Recording run = RunWithPeaks({5, 7, 6});
  for (v1::Cycle& cycle : *run.job.mutable_cycles()) cycle.set_turn_time_s(0.5);
  EXPECT_THAT(LabelledPeaks(run), ElementsAre(7));
}

TEST(FigurePart, ShowsTheContactsNamedAndTheirBodies) {
  const FigurePart part{.contacts = {"W"}};
  const Figure::Panel force = PresetFigure("force", SampleRun(), part).panels.at(0);
  EXPECT_THAT(force.curves, Each(Field(&Curve::colour, 1)));  // That which it has among all.
  EXPECT_THAT(force.bands, SizeIs(1));
  EXPECT_EQ(force.bands.at(0).start, 0.5);
  EXPECT_THAT(force.labels, SizeIs(1));
  const Figure::Panel speed = PresetFigure("velocity", SampleRun(), part).panels.at(0);
  EXPECT_THAT(speed.curves, Each(Field(&Curve::label, testing::StartsWith("B"))));
  const FigurePart pair{.contacts = {"A-B"}};
  EXPECT_THAT(PresetFigure("position", SampleRun(), pair).panels.at(0).dotted_lines, IsEmpty());
  EXPECT_THAT(PresetFigure("restitution", SampleRun(), pair).panels.at(0).curves, SizeIs(2));
  EXPECT_THAT(Complaint("iterations", SampleRun()), "");
  EXPECT_THROW(PresetFigure("iterations", SampleRun(), part), Failure);  // W iterated nothing.
}

TEST(FigurePart, UnknownContactIsRefusedWithTheNearest) {
  try {
    PresetFigure("force", SampleRun(), {.contacts = {"A-C"}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("did you mean 'A-B'?"));
  }
}

TEST(FigurePart, WindowCutsCurvesMarksAndBandsAtItsEnds) {
  const FigurePart part{.from = 0.3, .to = 0.7};
  const Figure::Panel panel = PresetFigure("position", SampleRun(), part).panels.at(0);
  const Curve curve = Named(panel, "A");
  EXPECT_EQ(curve.x.front(), 0.3);  // Between two samples; position is twice the time.
  EXPECT_EQ(curve.x.back(), 0.7);
  EXPECT_DOUBLE_EQ(curve.y.front(), 0.6);
  EXPECT_DOUBLE_EQ(curve.y.back(), 1.4);
  EXPECT_TRUE(std::ranges::is_sorted(curve.x, std::less_equal()));
  EXPECT_THAT(Named(panel, "A, A-B starts").x, IsEmpty());  // At 0.
  EXPECT_THAT(Named(panel, "A, A-B ends").x, ElementsAre(0.5));
  EXPECT_THAT(BandsOf(SampleRun(), part), ElementsAre(testing::Pair(0.3, 0.7)));
  EXPECT_THAT(PresetFigure("force", SampleRun(), part).panels.at(0).labels, IsEmpty());
}

TEST(FigurePart, WindowLeavesTheCyclesThatItOverlaps) {
  const FigurePart part{.from = 0.6};
  const Figure::Panel loops = PresetFigure("hysteresis", SampleRun(), part).panels.at(0);
  EXPECT_THAT(loops.curves, Each(Field(&Curve::colour, 1)));
  EXPECT_THAT(Named(loops, "W").x, SizeIs(33));  // The whole loop.
  const Figure::Panel ledger = PresetFigure("restitution", SampleRun(), part).panels.at(0);
  EXPECT_THAT(ledger.curves, Each(Field(&Curve::x, ElementsAre(2))));  // Its place among all.
}

TEST(FigurePart, WindowOfNothingIsRefused) {
  EXPECT_THROW(PresetFigure("force", SampleRun(), {.from = 0.5, .to = 0.5}), Failure);
  EXPECT_THROW(PresetFigure("force", SampleRun(), {.from = 2}), Failure);  // After the run.
}

TEST(ChannelsFigure, HasAPanelForEachQuantity) {
  const Figure figure =
      ChannelsFigure({"A.velocity", "W.deformation_velocity", "B.velocity"}, SampleRun());
  ASSERT_THAT(figure.panels, SizeIs(2));
  EXPECT_EQ(figure.panels[0].y_label, "velocity [m/s]");
  EXPECT_EQ(figure.panels[1].y_label, "deformation velocity [m/s]");
  EXPECT_THAT(figure.panels[0].curves,
              ElementsAre(Field(&Curve::label, "A.velocity"), Field(&Curve::label, "B.velocity")));
}

TEST(ChannelsFigure, UnknownChannelIsRefusedWithTheNearest) {
  try {
    ChannelsFigure({"A.velocty"}, SampleRun());
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("did you mean 'A.velocity'?"));
  }
}

TEST(Presets, ResidualOfZeroStaysOnALogarithmicAxis) {
  const std::vector<Figure::Panel> panels = PresetFigure("iterations", SampleRun()).panels;
  ASSERT_THAT(panels, SizeIs(2));
  EXPECT_THAT(panels[0].curves.at(0).y, ElementsAre(1e6, 2e6, 3e6));
  EXPECT_TRUE(panels[1].log_y);
  EXPECT_THAT(panels[1].curves.at(0).y, Each(testing::Gt(0)));
}

TEST(Presets, FactorsOfManySizesHaveALogarithmicAxis) {
  Recording run = SampleRun();
  EXPECT_FALSE(PresetFigure("iterations", run).panels[0].log_y);
  run.iterations.front().mutable_unknowns(0)->set_mu(1e3);
  EXPECT_TRUE(PresetFigure("iterations", run).panels[0].log_y);
  run.iterations.front().mutable_unknowns(0)->set_mu(0);
  EXPECT_FALSE(PresetFigure("iterations", run).panels[0].log_y);
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
