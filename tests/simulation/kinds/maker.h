#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact::testing {

/// Random numbers, and the parts that machines are made of. Same kind and seed, same scenario: with
/// own arithmetic, for the distributions of the standard library differ between libraries.
class Maker {
 public:
  Maker(std::string_view kind, unsigned seed);

  double Uniform(double low, double high);
  double Log(double low, double high);  ///< Even in the logarithm; 0 < low < high.
  int Below(int n);                     ///< 0 to n − 1.
  bool Chance(double part) { return Uniform(0, 1) < part; }
  double Sign() { return Chance(0.5) ? 1 : -1; }
  double OneOf(const std::vector<double>& values);

  /// Sets what the next balls and contacts are made of, in random ranges.
  struct Range {
    double low, high;
  };
  Range mass{0.02, 2}, stiffness{1e6, 3e8}, restitution{0.3, 0.9};
  double radius = 0.02;                   ///< [m]
  std::vector<double> exponents = {1.5};  ///< One of them.

  /// Adds a ball, its centre at `position`. Returns its index.
  int Ball(double position, double velocity = 0);
  /// Adds balls to the right of the last, or one at 0; each touches the one before, or is `gap`
  /// away.
  void Row(int balls, double gap = 0);
  /// A contact between two bodies, or one body and a wall on its other side, which is `gap` away.
  Contact& Pair(int left, int right);
  Contact& WallLeft(int body, double gap = 0);
  Contact& WallRight(int body, double gap = 0);
  /// Contacts between each ball and the next, from `first` on.
  void Neighbours(int first = 0);

  Body& At(int body) { return s.bodies[static_cast<std::size_t>(body)]; }
  Body& Last() { return s.bodies.back(); }
  int last() const { return static_cast<int>(s.bodies.size()) - 1; }

  void Gravity(double acceleration = -9.81);  ///< On all bodies that can move, as they are now.
  void Force(int body, double force) { s.loads.push_back({.body = body, .constant = force}); }
  void Step(int body, double force, double begin);
  void Pulse(int body, double force, double begin, double duration);
  void HalfSine(int body, double amplitude, double begin, double duration);
  void Sine(int body, double amplitude, double angular_frequency, double phase = 0);
  /// Linear between points of (time, force), 0 before and after.
  struct Point {
    double time, force;
  };
  void Table(int body, const std::vector<Point>& points);
  /// A spring and damper to the ground that is slack at the body's place; `ratio` of critical
  /// damping.
  Support& Spring(int body, double stiffness, double ratio);
  /// Makes a body one that moves as given: from where it is, by a sine that begins in its middle,
  /// or at rest, then with each acceleration for a time and in the end as it moves then.
  void Swing(int body, double amplitude, double angular_frequency);
  struct Push {
    double acceleration, duration;
  };
  void Move(int body, const std::vector<Push>& pushes);
  /// The two contacts of a body that moves freely by `play` to either side of another, or, as
  /// kNone, of the place x.
  void Play(int body, int other, double play, double x = 0);
  /// The same between two bodies at their distance.
  Support& Joint(int body, int other, double stiffness, double ratio);

  Scenario s;

 private:
  std::mt19937 engine_;
};

}  // namespace contact::testing
