// Seeded random scenarios of the kinds on which the search for the damping factors is judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "simulation/model/scenario.h"

namespace contact::testing {

/// What a random scenario looks like: six kinds of one to five balls, and four of six to thirty.
enum class Kind {
  kRow,
  kGaps,
  kWall,
  kSupport,
  kPressed,
  kBouncing,
  kLong,
  kColumn,
  kCradle,
  kRattler
};
inline constexpr int kSmallKinds = 6, kKinds = 10;
inline constexpr const char* kKindNames[kKinds] = {
    "row", "gaps", "wall", "support", "pressed", "bouncing", "long", "column", "cradle", "rattler"};

/// Rolls scenarios: the same seed and kind, the same scenario.
class Dice {
 public:
  Dice(unsigned seed, Kind kind) : engine_(seed * 16 + static_cast<unsigned>(kind)), kind_(kind) {}

  Scenario Roll() {
    const bool many = kind_ >= Kind::kLong;
    const int balls = kind_ == Kind::kBouncing ? 1 : many ? 6 + Below(25) : 2 + Below(4);
    low_ = many ? 0.45 : 0.35, high_ = many ? 0.96 : 0.98;
    AddBalls(balls);
    AddWallsAndLoads(balls);
    for (std::size_t i = 0; i < s_.contacts.size(); ++i)
      s_.contacts[i].name = "C" + std::to_string(i + 1);
    s_.end_time = EndTime(balls);
    s_.solver.max_steps = 20'000'000;
    return s_;
  }

 private:
  // Own arithmetic, for the distributions of the standard library differ between libraries.
  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  double Log(double low, double high) { return std::exp(Uniform(std::log(low), std::log(high))); }
  int Below(int n) { return static_cast<int>(Uniform(0, n)); }

  Contact Law(int left, int right, double wall = 0) {
    return {.name = {},
            .left = left,
            .right = right,
            .wall_position = wall,
            .stiffness = Log(1e6, 3e8),
            .restitution = Uniform(low_, high_)};
  }

  void AddBalls(int balls) {
    const bool gaps = kind_ == Kind::kGaps || kind_ == Kind::kRattler;
    const bool pushed =
        kind_ == Kind::kPressed || kind_ == Kind::kColumn || kind_ == Kind::kBouncing;
    double at = 0;
    for (int i = 0; i < balls; ++i) {
      Body ball{.name = "B" + std::to_string(i + 1), .mass = Log(0.03, 3), .radius = 0.02};
      if (i > 0) at += 0.04 + (gaps ? Log(1e-6, 1e-3) : 0);
      ball.position = at;
      if (i == 0 && !pushed) ball.velocity = Uniform(0.05, 2);
      if (kind_ == Kind::kRattler ||
          (i == balls - 1 && i > 0 && Below(4) == 0 && !pushed && kind_ != Kind::kCradle)) {
        ball.velocity = i == 0 ? ball.velocity : Uniform(-1, kind_ == Kind::kRattler ? 1 : 0);
      }
      s_.bodies.push_back(ball);
      if (i > 0) s_.contacts.push_back(Law(i - 1, i));
    }
  }

  void AddWallsAndLoads(int balls) {
    if (kind_ == Kind::kWall) AddWall(Below(2) ? 0 : Log(1e-5, 1e-3));
    if (kind_ == Kind::kPressed || kind_ == Kind::kColumn || kind_ == Kind::kBouncing) Press();
    if (kind_ == Kind::kSupport) {
      const int shaken = Below(balls), held = Below(balls);
      Shake(held, shaken);
    }
    if (kind_ == Kind::kCradle) Hang();
    if (kind_ == Kind::kRattler) {
      s_.contacts.push_back(Law(kNone, 0, -0.02 - Log(1e-5, 1e-3)));
      AddWall(Log(1e-5, 1e-3));
    }
  }

  // To the right of the last ball.
  void AddWall(double gap) {
    const int last = static_cast<int>(s_.bodies.size()) - 1;
    s_.contacts.push_back(Law(last, kNone, s_.bodies.back().position + 0.02 + gap));
  }

  // Against a wall, by a force on the first ball.
  void Press() {
    AddWall(kind_ == Kind::kBouncing ? Log(1e-5, 1e-2) : 0);
    const double force = kind_ == Kind::kBouncing ? Log(1, 200) : Uniform(100, 1400);
    s_.loads.push_back({.body = 0, .constant = force});
    if (kind_ == Kind::kBouncing) s_.bodies[0].velocity = Below(2) ? 0 : Uniform(0, 1);
    if (kind_ == Kind::kColumn) {
      s_.loads.push_back(
          {.body = 0, .begin = 0.01, .end = 0.011, .constant = force * Uniform(0.1, 1)});
    }
  }

  void Shake(int held, int shaken) {
    s_.supports.push_back({.body = held,
                           .stiffness = Log(1e4, 5e5),
                           .damping = Log(3, 100),
                           .rest_position = s_.bodies[static_cast<std::size_t>(held)].position});
    s_.loads.push_back(
        {.body = shaken, .amplitude = Uniform(10, 300), .angular_frequency = Log(200, 6000)});
  }

  // On strings, as linear springs: what has swung out comes back.
  void Hang() {
    for (int i = 0; const Body& ball : s_.bodies) {
      s_.supports.push_back({.body = i++,
                             .stiffness = 98.1 * ball.mass,
                             .damping = 0.02 * ball.mass,
                             .rest_position = ball.position});
    }
  }

  // A few times as long as a pulse of the softest contacts takes to run through.
  double EndTime(int balls) {
    if (kind_ == Kind::kPressed) return Uniform(0.003, 0.02);
    if (kind_ == Kind::kColumn) return 0.02;
    if (kind_ == Kind::kBouncing) return Uniform(0.01, 0.1);
    if (kind_ == Kind::kRattler) return 0.01;
    return std::min(0.05, Uniform(0.002, 0.008) * (balls > 5 ? std::sqrt(balls) : balls));
  }

  std::mt19937 engine_;
  Kind kind_;
  double low_ = 0.35, high_ = 0.98;
  Scenario s_;
};

}  // namespace contact::testing
