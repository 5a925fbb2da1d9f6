#include "simulation/kinds/maker.h"

#include <cmath>
#include <numbers>
#include <string>

#include "simulation/model/derived.h"

namespace contact::testing {
namespace {

// FNV-1a: the same for all standard libraries, and no kind has the dice of another.
std::uint32_t Hash(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

}  // namespace

Maker::Maker(std::string_view kind, unsigned seed) : engine_(Hash(kind) + seed * 2654435769U) {}

double Maker::Uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
}

double Maker::Log(double low, double high) {
  return std::exp(Uniform(std::log(low), std::log(high)));
}

int Maker::Below(int n) { return static_cast<int>(Uniform(0, n)); }

double Maker::OneOf(const std::vector<double>& values) {
  return values[static_cast<std::size_t>(Below(static_cast<int>(values.size())))];
}

int Maker::Ball(double position, double velocity) {
  s.bodies.push_back({.name = "B" + std::to_string(s.bodies.size() + 1),
                      .mass = Log(mass.low, mass.high),
                      .radius = radius,
                      .position = position,
                      .velocity = velocity});
  return last();
}

void Maker::Row(int balls, double gap) {
  for (int i = 0; i < balls; ++i) {
    Ball(s.bodies.empty() ? 0 : Last().position + Last().radius + gap + radius);
  }
}

Contact& Maker::Pair(int left, int right) {
  s.contacts.push_back({.name = "C" + std::to_string(s.contacts.size() + 1),
                        .left = left,
                        .right = right,
                        .stiffness = Log(stiffness.low, stiffness.high),
                        .exponent = OneOf(exponents),
                        .restitution = Uniform(restitution.low, restitution.high)});
  return s.contacts.back();
}

Contact& Maker::WallLeft(int body, double gap) {
  Contact& contact = Pair(kNone, body);
  contact.wall_position = At(body).position - At(body).radius - gap;
  return contact;
}

Contact& Maker::WallRight(int body, double gap) {
  Contact& contact = Pair(body, kNone);
  contact.wall_position = At(body).position + At(body).radius + gap;
  return contact;
}

void Maker::Neighbours(int first) {
  for (int i = first; i < last(); ++i) Pair(i, i + 1);
}

void Maker::Gravity(double acceleration) {
  for (int i = 0; i <= last(); ++i) {
    if (!At(i).fixed) Force(i, acceleration * At(i).mass);
  }
}

void Maker::Step(int body, double force, double begin) {
  s.loads.push_back({.body = body, .begin = begin, .constant = force});
}

void Maker::Pulse(int body, double force, double begin, double duration) {
  s.loads.push_back({.body = body, .begin = begin, .end = begin + duration, .constant = force});
}

void Maker::HalfSine(int body, double amplitude, double begin, double duration) {
  s.loads.push_back({.body = body,
                     .begin = begin,
                     .end = begin + duration,
                     .amplitude = amplitude,
                     .angular_frequency = std::numbers::pi / duration});
}

void Maker::Sine(int body, double amplitude, double angular_frequency, double phase) {
  s.loads.push_back({.body = body,
                     .amplitude = amplitude,
                     .angular_frequency = angular_frequency,
                     .phase = phase});
}

void Maker::Table(int body, const std::vector<Point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &from = points[i - 1], &to = points[i];
    s.loads.push_back({.body = body,
                       .begin = from.time,
                       .end = to.time,
                       .constant = from.force,
                       .slope = (to.force - from.force) / (to.time - from.time)});
  }
}

Support& Maker::Spring(int body, double k, double ratio) {
  s.supports.push_back({.body = body,
                        .stiffness = k,
                        .damping = 2 * ratio * std::sqrt(k * At(body).mass),
                        .rest_position = At(body).position});
  return s.supports.back();
}

Support& Maker::Joint(int body, int other, double k, double ratio) {
  const double m = 1 / (1 / At(body).mass + 1 / At(other).mass);
  s.supports.push_back({.body = body,
                        .other = other,
                        .stiffness = k,
                        .damping = 2 * ratio * std::sqrt(k * m),
                        .rest_position = At(body).position - At(other).position});
  return s.supports.back();
}

void Maker::Swing(int body, double amplitude, double angular_frequency) {
  Body& b = At(body);
  b.fixed = true;
  b.velocity = amplitude * angular_frequency;
  s.drives.push_back({.body = body,
                      .position = b.position,
                      .amplitude = amplitude,
                      .angular_frequency = angular_frequency});
}

void Maker::Move(int body, const std::vector<Push>& pushes) {
  Body& b = At(body);
  b.fixed = true;
  b.velocity = 0;
  contact::Drive piece{.body = body, .position = b.position};
  for (const Push& push : pushes) {
    piece.acceleration = push.acceleration;
    piece.end = piece.begin + push.duration;
    s.drives.push_back(piece);
    const DrivenMotion reached = MotionAt(piece, piece.end);
    piece = {.body = body,
             .begin = piece.end,
             .position = reached.position,
             .velocity = reached.velocity};
  }
  s.drives.push_back(piece);
}

void Maker::Play(int body, int other, double play, double x) {
  for (const bool left : {true, false}) {
    Contact& side = left ? Pair(other, body) : Pair(body, other);
    side.name = At(body).name + (left ? "-left" : "-right");
    side.wall_position = x;
    side.play = play;
    if (!left) {  // Both of one law.
      const Contact& first = s.contacts[s.contacts.size() - 2];
      side.stiffness = first.stiffness, side.exponent = first.exponent;
      side.restitution = first.restitution;
    }
  }
}

}  // namespace contact::testing
