#include "simulation/clusters/flight_turns.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "simulation/model/derived.h"

namespace contact {
namespace {

int ChannelOf(const World& world, int body) {
  return static_cast<int>(world.scenario().contacts.size()) + 2 * body;
}

// Under a constant force x turns where ẋ = 0, and ẋ nowhere.
void AddOfFlights(const World& world, int body, double from, double to, std::vector<Turn>* turns) {
  const double acceleration = world.Acceleration(body);
  const std::vector<World::Station>& stations = world.StationsOf(body);
  for (std::size_t i = 0; i < stations.size() && acceleration != 0; ++i) {
    const World::Station& station = stations[i];
    const double next = i + 1 < stations.size() ? stations[i + 1].from : kNever;
    const double time = station.flight.time - station.flight.start.v / acceleration;
    const bool is_there = station.piece == nullptr && time > station.from && time < next;
    if (!is_there || time <= from || time > to) continue;
    turns->push_back(
        {.time = time,
         .channel = ChannelOf(world, body),
         .value = world.scenario().bodies[At(body)].position + station.flight.At(time).u});
  }
}

// Adds the instants at which `rate` changes its sign between two others, at most once.
template <class Rate>
void AddZero(const Rate& rate, double from, double to, std::vector<double>* zeros) {
  const double first = rate(from), last = rate(to);
  if (first == 0 || (first > 0) == (last > 0)) return;
  std::uintmax_t most = 50;
  const boost::math::tools::eps_tolerance<double> tolerance(40);
  zeros->push_back(
      boost::math::tools::toms748_solve(rate, from, to, first, last, tolerance, most).second);
}

// In a quarter of a period, or of a polynomial of the third degree up to its point of inflection,
// ẋ and ẍ change their signs once at most; where a polynomial and a sine add up two that are
// nearer may be missed.
void AddOfDrive(const World& world, const Drive& drive, double from, double to,
                std::vector<Turn>* turns) {
  std::vector<double> still, even;
  const auto velocity = [&](double t) { return MotionAt(drive, t).velocity; };
  const auto acceleration = [&](double t) { return MotionAt(drive, t).acceleration; };
  const double bend = drive.begin - drive.acceleration / drive.jerk;
  const bool swings = drive.amplitude != 0 && drive.angular_frequency > 0;
  const double quarter = swings ? std::numbers::pi / 2 / drive.angular_frequency : kNever;
  for (double begin = from; begin < to;) {
    double end = std::min(begin + quarter, to);
    if (!swings && bend > begin && bend < end) end = bend;
    AddZero(velocity, begin, end, &still);
    AddZero(acceleration, begin, end, &even);
    begin = end;
  }
  const int channel = ChannelOf(world, drive.body);
  const double origin = world.scenario().bodies[At(drive.body)].position;
  for (const double t : still) {
    turns->push_back({t, channel, origin + world.PlaceOf(drive.body, t).u});
  }
  for (const double t : even) turns->push_back({t, channel + 1, velocity(t)});
}

}  // namespace

void AddFlightTurns(const World& world, double from, double to, std::vector<Turn>* turns) {
  for (int body = 0; body < std::ssize(world.scenario().bodies); ++body) {
    if (world.IsMoved(body)) AddOfFlights(world, body, from, to, turns);
    for (const Drive& drive : world.driven().PiecesFrom(body, from)) {
      if (drive.begin >= to) break;
      AddOfDrive(world, drive, std::max(from, drive.begin), std::min(to, drive.end), turns);
    }
  }
}

}  // namespace contact
