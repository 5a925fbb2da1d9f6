#pragma once

#include <memory>
#include <vector>

#include "simulation/clusters/driven_paths.h"
#include "simulation/clusters/piece.h"
#include "simulation/model/index.h"

namespace contact {

/// All bodies and contacts of a run: what each has done so far, and what it does next.
///
/// The past of a body is a list of stations: it flies, moves in a piece, flies on or waits. What a
/// piece has found out can be undone.
class World {
 public:
  /// From one instant on a body moves in a piece, or flies, or waits.
  struct Station {
    double from = 0;                         ///< [s].
    std::shared_ptr<Piece> piece = nullptr;  ///< Null: it flies or waits.
    Flight flight = {};
  };

  /// The scenario must outlive the world.
  explicit World(const Scenario& scenario);
  /// The run begins: these wait, and all other bodies fly.
  void Begin(const std::vector<Waiting>& groups);

  const Scenario& scenario() const { return scenario_; }
  const DrivenPaths& driven() const { return driven_; }
  /// The contacts of a body, and those that it has with bodies that move.
  const std::vector<int>& ContactsOf(int body) const { return contacts_of_[At(body)]; }
  /// The body on the other side of a contact; kNone if it does not move.
  int Other(int contact, int body) const;
  /// The loads on a body, and the supports that hold it; of those between two that move the first.
  const std::vector<int>& LoadsOf(int body) const { return loads_of_[At(body)]; }
  const std::vector<int>& SupportsOf(int body) const { return supports_of_[At(body)]; }
  /// The sum of the loads on a body that are always the same [N].
  double SteadyForce(int body) const {
    return scenario_.bodies[At(body)].mass * Acceleration(body);
  }
  /// The bodies of a contact that move: the left one first, at most two.
  const std::vector<int>& Sides(int contact) const { return sides_[At(contact)]; }

  /// −δ [m] and δ̇ [m/s] of a contact, where its bodies are so.
  double Gap(int contact, const Place& left, const Place& right) const;
  /// That at an instant [s].
  struct Distance {
    double gap = 0, speed = 0;
  };
  Distance DistanceAt(int contact, double instant) const;
  /// Below this a gap is round-off [m].
  double Noise(int contact, double instant) const;

  /// Where a body is at an instant [s]. What stands still is at 0.
  Place PlaceOf(int body, double instant) const;
  const std::vector<Station>& StationsOf(int body) const { return stations_[At(body)]; }
  /// The last piece of a body; null if it has moved in none since what was forgotten.
  const Piece* LastPiece(int body) const;
  /// With which bodies it waits; null if it flies.
  const std::shared_ptr<const Waiting>& WaitingOf(int body) const { return waiting_[At(body)]; }
  /// How often the future of a body has changed.
  int Changes(int body) const { return body == kNone ? 0 : changes_[At(body)]; }
  /// Whether forces move a body, which may be kNone.
  bool IsMoved(int body) const { return body != kNone && !scenario_.bodies[At(body)].fixed; }
  /// By how much a support is longer than without force [m], where its bodies are so.
  double Stretch(const Support& support, const Place& body, const Place& other) const;
  /// ẍ of a body in flight [m/s²]; of one that no force moves 0.
  double Acceleration(int body) const { return body == kNone ? 0 : accelerations_[At(body)]; }
  /// From when on nothing holds a body that touches nothing, and the force on it is constant [s]:
  /// then it flies. Before it waits.
  double FliesFrom(int body) const { return flies_from_[At(body)]; }
  /// δ̈ of a contact whose bodies are both in flight [m/s²]; what is round-off of it is 0.
  double Approach(int contact) const;

  /// When a contact of two bodies that fly begins [s]; kNever if it does not, or one waits.
  double NextTouch(int contact) const;
  /// The bodies at an instant at which each flies, or has just begun to wait. `touch`: a contact
  /// that begins there, or kNone.
  Cast Assemble(const std::vector<int>& bodies, double instant, int touch) const;

  /// The bodies of a piece have moved so, and go on like that: those in `groups` wait together, and
  /// the others fly.
  void Commit(const std::shared_ptr<Piece>& piece, const std::vector<Waiting>& groups);
  /// The last piece of its bodies has never been.
  void Undo(const Piece& piece);
  /// What a body did before the station in which it came to an instant [s].
  void Forget(int body, double instant);

  const std::vector<ContactState>& contacts() const { return states_; }
  /// All becomes as it was when these were the contacts, stations and groups that wait.
  void Restore(std::vector<ContactState> contacts, std::vector<std::vector<Station>> stations,
               const std::vector<Waiting>& groups);

 private:
  void Wait(const std::vector<Waiting>& groups);
  double NextTouchOfDriven(int contact, double from) const;
  void ContactsAmong(const std::vector<int>& bodies, Cast* cast) const;
  void Touch(int touch, Cast* cast) const;

  const Scenario& scenario_;
  const DrivenPaths driven_;
  std::vector<double> gaps_;             // At t = 0 [m].
  std::vector<std::vector<int>> sides_;  // Of each contact.
  std::vector<double> accelerations_;    // In flight [m/s²].
  std::vector<double> flies_from_;       // [s].
  std::vector<std::vector<int>> contacts_of_, loads_of_, supports_of_;
  std::vector<ContactState> states_;
  std::vector<std::vector<Station>> stations_;
  std::vector<std::shared_ptr<const Waiting>> waiting_;
  std::vector<int> changes_;
};

}  // namespace contact
