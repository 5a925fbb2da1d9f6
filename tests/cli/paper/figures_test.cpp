#include "cli/paper/figures.h"

#include <gmock/gmock.h>

#include "cli/paper/cases.h"
#include "testing/fake_lab.h"

namespace contact::cli {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::Not;
using testing::SizeIs;

using Curve = Figure::Curve;
using Mark = Figure::Mark;

TEST(DeformationVelocityFigure, PairsCompressionAndRestitutionOfEachRestitution) {
  const Data data{"fig3",
                  {"restitution", "deformation_m", "deformation_velocity_m_per_s"},
                  {{0.9, 0, 0.5}, {0.9, 1e-5, 0}, {0.9, 0, -0.45}, {0.5, 0, 0.5}, {0.5, 0, -0.25}}};
  const Figure figure = DeformationVelocityFigure(data);
  const auto& curves = figure.panels.at(0).curves;
  ASSERT_THAT(curves, SizeIs(4));
  EXPECT_EQ(curves[0].label, "ε = 0.9");
  EXPECT_THAT(curves[0].y, ElementsAre(0.5, 0));
  EXPECT_EQ(curves[1].mark, Mark::kDashed);
  EXPECT_THAT(curves[1].y, ElementsAre(0.45));  // Its magnitude.
  EXPECT_EQ(curves[2].label, "ε = 0.5");
  EXPECT_NE(curves[2].colour, curves[0].colour);
}

TEST(ColumnsFigure, HasACurveForEachColumnButTheFirst) {
  const Figure figure =
      ColumnsFigure({"d", {"x", "a", "b"}, {{0, 1, 2}, {1, 3, 4}}}, "α", {"A", "B"});
  const auto& curves = figure.panels.at(0).curves;
  ASSERT_THAT(curves, SizeIs(2));
  EXPECT_THAT(curves[0].y, ElementsAre(1, 3));
  EXPECT_THAT(curves[1].y, ElementsAre(2, 4));
  EXPECT_THAT(curves, Each(Field(&Curve::x, ElementsAre(0, 1))));
  EXPECT_EQ(figure.panels[0].y_label, "α");
}

TEST(AddIdeal, IsTheDiagonal) {
  Figure figure{.panels = {{}}};
  AddIdeal(&figure);
  EXPECT_EQ(figure.panels[0].curves.at(0).x, figure.panels[0].curves.at(0).y);
  EXPECT_EQ(figure.panels[0].curves.at(0).mark, Mark::kDotted);
}

TEST(VelocitiesFigure, BallsHaveLinesOfTheirOwn) {
  FakeLab lab;
  const Figure figure = VelocitiesFigure(lab.SolveOne(TripleChain(0.8, 0.7)));
  for (const Mark mark : {Mark::kLine, Mark::kDashed, Mark::kDotted}) {
    EXPECT_THAT(figure.panels.at(0).curves, Contains(Field(&Curve::mark, mark)).Times(1));
  }
}

TEST(ModelsFigure, HasTheForcesOfEveryModelInItsColour) {
  FakeLab lab;
  const std::vector<Solved> runs = lab.Solve({TripleChain(0.8, 0.7), TripleChain(0.8, 0.7)});
  const Figure figure = ModelsFigure("force", {&runs[0], &runs[1]}, {"one", "two"});
  const auto& curves = figure.panels.at(0).curves;
  for (const char* label : {"one, B1-B2", "one, B2-B3", "two, B1-B2", "two, B2-B3"}) {
    EXPECT_THAT(curves, Contains(Field(&Curve::label, label)).Times(1));
  }
  for (const Curve& curve : curves) {
    if (curve.label.starts_with("one")) {
      EXPECT_EQ(curve.colour, 0);
    }
    if (curve.label.starts_with("two")) {
      EXPECT_EQ(curve.colour, 1);
    }
  }
  EXPECT_THAT(curves, Not(Contains(Field(&Curve::label, testing::HasSubstr("external")))));
  EXPECT_THAT(figure.sources, SizeIs(2));
}

TEST(ModelsFigure, SecondContactIsDashed) {
  FakeLab lab;
  const Solved run = lab.SolveOne(TripleChain(0.8, 0.7));
  const Figure figure = ModelsFigure("force", {&run}, {"m"});
  for (const Curve& curve : figure.panels.at(0).curves) {
    if (curve.label == "m, B1-B2") {
      EXPECT_EQ(curve.mark, Mark::kLine);
    }
    if (curve.label == "m, B2-B3") {
      EXPECT_EQ(curve.mark, Mark::kDashed);
    }
  }
}

}  // namespace
}  // namespace contact::cli
