#pragma once

#include <vector>

/// What Simbody needs of a scenario, for its headers are not C++20 and those of the simulation are.
struct SimbodyRow {
  struct Ball {
    double mass, radius, position, velocity;  ///< SI units.
  };
  struct Touch {
    int left, right;             ///< Indices of balls; `right` −1: a wall at `wall` [m].
    double wall, stiffness, mu;  ///< F = k δ^1.5 + μ δ^1.5 δ̇.
  };
  struct Spring {
    int ball;
    double stiffness, damping, rest;  ///< Force −k (x − rest) − c ẋ.
  };
  struct Push {
    int ball;
    double constant, amplitude, angular_frequency, phase;  ///< Force c + A sin(ω t + φ).
  };
  std::vector<Ball> balls;
  std::vector<Touch> touches;
  std::vector<Spring> springs;
  std::vector<Push> pushes;
  double end_time = 0;
};

/// The velocities at the end: sliders, a HuntCrossleyForce for each contact, and the
/// Runge-Kutta-Merson integrator with this accuracy.
std::vector<double> BySimbody(const SimbodyRow& row, double accuracy);
