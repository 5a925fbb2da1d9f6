#include "wire/ledger_codec.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "two_contacts.h"

namespace contact {
namespace {

using testing::ElementsAre;

TEST(Encode, CycleKeepsEveryField) {
  const Cycle cycle{.contact = 1,
                    .number = 2,
                    .group = 25,
                    .episode = 3,
                    .kind = Cycle::Kind::kCollision,
                    .end = Cycle::End::kNonSeparation,
                    .status = Cycle::Status::kInfeasible,
                    .iterations = 4,
                    .start_time = 5,
                    .turn_time = 6,
                    .end_time = 7,
                    .start_deformation = 8,
                    .max_deformation = 9,
                    .end_deformation = 10,
                    .approach_velocity = 11,
                    .separation_velocity = -12,
                    .mu = 13,
                    .work_compression = 14,
                    .work_restitution = -15,
                    .dissipated_compression = 16,
                    .dissipated_restitution = 17,
                    .external_compression = 18,
                    .external_restitution = 19,
                    .restitution_in = 20,
                    .restitution_out = 21,
                    .peak_force = 22,
                    .tension_time = 23,
                    .identity_residual = 24};
  EXPECT_EQ(Encode(TwoContacts(), cycle).ShortDebugString(),
            "contact: \"b-wall\" number: 2 kind: COLLISION end: NON_SEPARATION status: INFEASIBLE "
            "iterations: 4 episode: 3 start_time_s: 5 turn_time_s: 6 end_time_s: 7 "
            "delta_start_m: 8 delta_max_m: 9 delta_end_m: 10 approach_velocity_m_per_s: 11 "
            "separation_velocity_m_per_s: -12 mu: 13 mu_over_k_s_per_m: 3.25 alpha: 35.75 "
            "work_compression_j: 14 work_restitution_j: -15 dissipated_compression_j: 16 "
            "dissipated_restitution_j: 17 external_work_compression_j: 18 "
            "external_work_restitution_j: 19 restitution_in: 20 restitution_out: 21 "
            "peak_force_n: 22 tension_time_s: 23 identity_residual: 24 group: 25");
}

TEST(Encode, NewtonsRestitutionIsThatOfCollisionsThatSeparate) {
  Cycle cycle{.approach_velocity = 2, .separation_velocity = -1};
  cycle.end = Cycle::End::kSeparation;
  EXPECT_EQ(Encode(TwoContacts(), cycle).newton_restitution(), 0.5);
  cycle.approach_velocity = 0;  // From rest.
  EXPECT_FALSE(Encode(TwoContacts(), cycle).has_newton_restitution());
  cycle.approach_velocity = 2;
  cycle.end = Cycle::End::kRunEnd;
  EXPECT_FALSE(Encode(TwoContacts(), cycle).has_newton_restitution());
}

Group FullGroup() {
  return {.contact = 1,
          .number = 2,
          .encounter = 3,
          .first_cycle = 4,
          .cycles = 5,
          .start_time = 6,
          .end_time = 7,
          .end = Cycle::End::kNonSeparation,
          .status = Cycle::Status::kJump,
          .growth = Growth::kTooMuch,
          .mu = 8,
          .work_compression = 9,
          .work_restitution = -10,
          .restitution_in = 11,
          .restitution_out = 12,
          .residual = 13,
          .too_much = {.mu = 14, .restitution = 15},
          .too_little = {.mu = 16, .restitution = 17},
          .other_roots = {18, 19}};
}

TEST(Encode, GroupKeepsEveryField) {
  EXPECT_EQ(Encode(TwoContacts(), FullGroup()).ShortDebugString(),
            "contact: \"b-wall\" number: 2 first_cycle: 4 cycles: 5 encounter: 3 start_time_s: 6 "
            "end_time_s: 7 end: NON_SEPARATION mu: 8 work_compression_j: 9 "
            "work_restitution_j: -10 restitution_in: 11 restitution_out: 12 status: JUMP "
            "growth: TOO_MUCH residual: 13 too_much_mu: 14 too_much_restitution: 15 "
            "too_little_mu: 16 too_little_restitution: 17 other_roots: 18 other_roots: 19");
}

TEST(Encode, GroupOfWhichNothingWasReachedTellsNoMu) {
  const v1::Group group = Encode(TwoContacts(), Group{});
  for (const bool told : {group.has_too_much_mu(), group.has_too_much_restitution(),
                          group.has_too_little_mu(), group.has_too_little_restitution()}) {
    EXPECT_FALSE(told);
  }
}

TEST(Encode, GrowthKeepsWhatIsKnownOfTheGroup) {
  EXPECT_EQ(EncodeGrowth(TwoContacts(), FullGroup()).ShortDebugString(),
            "contact: \"b-wall\" encounter: 3 first_cycle: 4 cycles: 5 start_time_s: 6 "
            "restitution_in: 11 growth: TOO_MUCH mu: 8");
}

TEST(Encode, EveryReasonToGrowHasItsWord) {
  std::vector<int> growths;
  for (const Growth growth : {Growth::kNotGrown, Growth::kTooLittle, Growth::kTooMuch,
                              Growth::kJump, Growth::kNoProgress}) {
    growths.push_back(Encode(TwoContacts(), Group{.growth = growth}).growth());
  }
  EXPECT_THAT(growths, ElementsAre(v1::Group::NOT_GROWN, v1::Group::TOO_LITTLE, v1::Group::TOO_MUCH,
                                   v1::Group::JUMP, v1::Group::NO_PROGRESS));
}

TEST(Encode, NirvCycleHasNoAlpha) {
  const Cycle cycle{.kind = Cycle::Kind::kNirv, .approach_velocity = 1e-18, .mu = 13};
  EXPECT_EQ(Encode(TwoContacts(), cycle).alpha(), 0);
  EXPECT_EQ(Encode(TwoContacts(), cycle).mu_over_k_s_per_m(), 13);
}

TEST(Encode, OpenCycleKeepsItsNans) {
  const v1::Cycle cycle = Encode(TwoContacts(), Cycle{});
  EXPECT_TRUE(std::isnan(cycle.turn_time_s()));
  EXPECT_TRUE(std::isnan(cycle.restitution_out()));
  EXPECT_EQ(cycle.end(), v1::Cycle::RUN_END);
}

TEST(Encode, EveryWordOfACycleHasItsOwn) {
  using S = Cycle::Status;
  std::vector<int> statuses;
  for (const S status : {S::kConverged, S::kGivenLaw, S::kInfeasible, S::kSettled, S::kNotConverged,
                         S::kJump, S::kUnfinished, S::kReleased, S::kLimited, S::kCut}) {
    statuses.push_back(Encode(TwoContacts(), Cycle{.status = status}).status());
  }
  EXPECT_THAT(
      statuses,
      ElementsAre(v1::Cycle::CONVERGED, v1::Cycle::GIVEN_LAW, v1::Cycle::INFEASIBLE,
                  v1::Cycle::SETTLED, v1::Cycle::NOT_CONVERGED, v1::Cycle::JUMP,
                  v1::Cycle::UNFINISHED, v1::Cycle::RELEASED, v1::Cycle::LIMITED, v1::Cycle::CUT));
  using E = Cycle::End;
  std::vector<int> ends;
  for (const E end : {E::kSeparation, E::kNonSeparation, E::kRunEnd}) {
    ends.push_back(Encode(TwoContacts(), Cycle{.end = end}).end());
  }
  EXPECT_THAT(ends,
              ElementsAre(v1::Cycle::SEPARATION, v1::Cycle::NON_SEPARATION, v1::Cycle::RUN_END));
  EXPECT_EQ(Encode(TwoContacts(), Cycle{.kind = Cycle::Kind::kNirv}).kind(), v1::Cycle::NIRV);
}

}  // namespace
}  // namespace contact
