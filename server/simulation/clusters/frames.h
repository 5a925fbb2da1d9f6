#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "simulation/clusters/world.h"
#include "simulation/course/sample_log.h"
#include "simulation/episode/run_state.h"
#include "simulation/model/observer.h"
#include "simulation/motion/equations.h"

namespace contact {

/// Samples of a world, at equal intervals and where its cycles want them; as Sampler makes them.
class Frames {
 public:
  /// All outlive the frames. Once `stop` is requested they hand out no further chunk of samples,
  /// however many there are.
  Frames(const World& world, Observer& observer, std::stop_token stop);

  /// Takes the samples up to an instant that are not taken yet [s]. `pieces`: all that go on after
  /// the last sample. `steps`: see SampleLog::TakeUntil.
  void RecordUntil(double instant, const Pieces& pieces, std::int64_t steps);
  /// A piece ends before all samples to come.
  void Forget(const Piece& piece);
  /// Hands out what is left, at the end of the run.
  void Flush() { log_.Flush(); }
  /// True if samples are missing because the run was asked to stop.
  bool cut_short() const { return log_.cut_short(); }
  /// See SampleLog.
  bool misses_samples() const { return log_.misses_samples(); }

  Sampling Save() const { return log_.Save(); }
  /// Dissipated in the pieces that are forgotten [J].
  double dissipated() const { return forgotten_.dissipated; }
  /// Goes on from there; all up to `time` was taken [s]. `forgotten`: in pieces, of the work that
  /// which steady loads did not do.
  void Restore(Sampling from, double time, const Exchanged& forgotten) {
    log_.Restore(std::move(from));
    until_ = time;
    forgotten_ = forgotten;
  }

 private:
  void FindSamples(double from, double until, const Pieces& pieces);
  void FindTurns(double from, double until, const Pieces& pieces);
  void Append(double instant, const Pieces& pieces, std::vector<double>* row);
  void FindForces(double instant, const Pieces& pieces);
  /// ẍ of all bodies without their contacts.
  void FindAccelerations(double instant);
  /// In a piece from its begin to the instant of the sample; of the work that which steady loads
  /// did not do.
  Exchanged ExchangedIn(const Piece& piece, double instant) const;
  /// Energy of the bodies of a piece, its contacts and supports [J], where its bodies and what
  /// stands or is driven beside them are at these places at the instant.
  double EnergyOf(const Piece& piece, std::span<const Place> places, double instant) const;
  /// Appends force and energy of each support; the sum of the energies [J].
  double AppendSupports(std::vector<double>* row) const;
  /// Appends the energies of the system.
  void AppendEnergies(double instant, const Pieces& pieces, double supports,
                      std::vector<double>* row) const;
  /// By how much a support is longer than without force [m], and its force on its body [N], (M4).
  double Stretch(const Support& support) const;
  double SupportForce(const Support& support) const;
  /// −δ of a contact between the places of the sample [m].
  double Gap(int contact) const;

  const World& world_;
  const Scenario& scenario_;
  const Equations equations_;
  SampleLog log_;
  double until_ = 0;  // All up to here are taken [s].
  Exchanged forgotten_;
  std::vector<CycleSample> wanted_;
  std::vector<Turn> turns_;
  // Of a sample: each body's place, ẋ and ẍ, and F and δ_y of each contact.
  std::vector<Place> places_;
  // Of the bodies of a piece.
  mutable std::vector<Place> own_;
  std::vector<double> velocities_, accelerations_, forces_, yields_;
};

}  // namespace contact
