#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "simulation/episode/quasi_newton.h"
#include "simulation/model/observer.h"
#include "simulation/motion/motion.h"

namespace contact {

struct Guess;
struct RunState;

/// Finds the μ of every cycle of an episode together, so that ε_out = ε_in in each: damped Newton
/// with true sensitivities, (N1) to (N6) of README.md, or as the paper does it, (P1) to (P5).
/// Then plays host to the recording pass.
class EpisodeSolver final : public CycleHost {
 public:
  EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer);

  /// Takes up the episode that begins at `start` and may be recorded up to `until`.
  void Begin(const State& start, int episode, double until);

  /// Passes through the episode with corrected μ until all cycles have converged, or are expected
  /// to with the next pass, which the recording is then, or none can do better. Returns why a pass
  /// could not be completed, or kQuiet: record, and see whether it Accepts that.
  Motion::Pause Solve(const State& start, const std::stop_token& stop, std::int64_t step_limit);

  /// Whether the recording that follows may have to be taken back.
  bool Tentative() const { return stage_ == Stage::kExpected; }

  /// Whether a recording pass that ended so is the one. If not: Solve again, and record again.
  bool Accepts(Motion::Pause recorded);

  /// The instant up to which every cycle that begins has its μ, at most `until`: where a cycle
  /// begins whose end the last pass did not see. `until` if that is at once.
  double SolvedUntil(double until) const;

  /// Writes into the cycles that run on after the episode what became of their requests.
  void HandOver(std::vector<ContactState>& contacts) const;

  /// Forgets the last recording's cycles and takes those that end from now on into the ledger,
  /// with the μ that Solve found.
  void BeginRecording();

  /// Fills what is known of a cycle that the end of the run has cut.
  void FinishCut(const ContactState& state, Cycle& cycle) const;

  Factor OnStart(const ContactState& state, double effective_mass, double external_force) override;
  void OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
             const Eigen::ArrayXd& restitution_gradient, double length, double speed) override;
  void OnCancel(const ContactState& state) override;
  void OnStep() override { observer_.OnStep(); }

  /// What outlives an episode.
  void Save(RunState* state) const;
  void Restore(const RunState& state);

  std::vector<Cycle> accepted;  ///< Cycles ended since BeginRecording.
  std::int64_t iterations() const { return total_iterations_; }

 private:
  struct Unknown {
    int contact = 0;
    int number = 1;
    double start_time = 0, end_time = 0;
    double mu = 0;
    double pass_mu = 0;        // Of the last pass.
    double start_mu = 0;       // The first guess.
    double best_mu = 0;        // Of the best pass.
    double natural_mu = kNaN;  // That suits its duration in the last pass.
    double settled_mu = kNaN;  // When all in the last window had converged.
    double restitution_in = kNaN;
    double goal = 1;                    // A(ε_in),
    double residual = kNaN, slope = 0;  // A(ε_out)/A(ε_in) − 1 of the last pass; d/d(ε_out²).
    bool iterated = false;              // By Newton; else given, settled or found infeasible.
    Cycle::Status status = Cycle::Status::kNotConverged;
    int column = kNone;
    bool seen = false, ended = false;  // In the last pass.
    bool ends = true;                  // As far as is known: else no μ of its own is sought.
    bool corrected = false;            // Its μ is no mere guess any more.
    bool weak = false;                 // Its W_c is next to nothing.
    bool pressed = false;              // It begins compressed.
    double length = 0, speed = 0;      // Scales of its motion in the first pass.
    double squared = kNaN;             // ε_out² = −W_r/W_c of the last pass.
    Eigen::ArrayXd gradient;           // ∂ε_out²/∂μ of each column.
    double frozen_slope = kNaN;        // Paper (30).
    double low = 0, high = 0;  // μ known to give too much, too little restitution; 0: none.
    int shrinks = 0;           // Corrections in a row that wanted μ ≤ 0.
    int wild = 0;              // Corrections in all that were clipped.
    bool zero_tried = false;
    double low_residual = 0, high_residual = 0;  // At the ends of the bracket.
    bool decided = false;                        // The next pass tells whether it has a solution.
    int corrections = 0;                         // Of this μ,
    int decisions = 0;                           // How often it was decided,
    int chances = 0;  // and how often it was iterated again after it was given up.
    Iteration::Update update = Iteration::Update::kNothing;
  };

  bool IsWeak(const ContactState& state) const;
  void Label(Cycle& cycle, bool rested, bool weak) const;
  Unknown* Find(int contact, int number);
  const Unknown* Find(int contact, int number) const;
  double NearestNatural(int contact) const;
  double FirstFactor(const Unknown& unknown, const ContactState& state, double effective_mass,
                     double external_force);
  double StartFactor(const ContactState& state, double effective_mass, double external_force);
  int Neighbour(int contact, int except) const;
  double NeighbourSpeed(int contact) const;
  bool Converged(const Unknown& unknown) const;
  bool Live(const Unknown& unknown) const;
  std::vector<Guess> Guesses(const State& end) const;
  void BeginWith(const std::vector<Guess>& guesses);
  Unknown MakeUnknown(int contact, int number) const;
  bool Advances(double time) const;
  double Before(double cycle_start, double until) const;
  int FirstWindow(const State& start) const;
  bool AnyFinal();
  bool Widen();
  void StartAfresh();
  bool GiveUpWorst();
  bool Lost(const std::vector<Unknown*>& live, const Eigen::VectorXd& step) const;
  void BeCareful();
  void Decide();
  bool DecideOn(Unknown& unknown) const;
  static bool Abandon(Unknown& unknown);
  static void DeclareInfeasible(Unknown& unknown, double mu);
  bool LookAgain();
  static double NaturalFactor(const Contact& contact, const Cycle& cycle);
  void Iterate(Unknown& unknown);
  void TakeInMore();
  static constexpr int kChances = 3;       // To be iterated again after it was given up.
  static constexpr double kSolved = 1e-3;  // Residual of a cycle that lets others be taken in.
  bool Undecided() const;
  bool TakeInNext();
  bool Foreseen(const Unknown& unknown) const;
  bool MayBeSolved(const Unknown& unknown) const;
  bool Revive();
  int Corrections(const Unknown& unknown) const;
  void ForgetPass();
  Motion::Pause Pass(const State& start, const std::stop_token& stop, std::int64_t step_limit);
  void NextPass();
  double Merit() const;
  bool Done() const;
  /// The residual that the error of this pass may feign.
  double Feigned() const { return (short_ ? 10 : 100) * tolerance_; }
  /// Whether it is asked of each cycle if it has a solution.
  bool Doubts() const { return careful_ || doubtful_; }
  bool Exact() const { return tolerance_ <= scenario_.solver.relative_tolerance; }
  void KeepBest();
  void UseBest();
  void Finish();
  static void Measure(Unknown& unknown);
  std::vector<Unknown*> LiveUnknowns();
  static Eigen::VectorXd Values(const std::vector<Unknown*>& live, double Unknown::*value);
  static QuasiNewton::Cycles CyclesOf(const std::vector<Unknown*>& live);
  void Factorize(const std::vector<Unknown*>& live);
  bool FactorsServe();
  bool LacksColumns();
  void Correct();
  void GiveUp(Unknown& unknown);
  void MoveBy(Unknown& unknown, double relative_step, bool alone);
  void PlanLastPasses(bool converges);
  void PlanNextPass();
  static double PaperStartFactor(const ContactState& state, const Contact& contact,
                                 double velocity);
  static double FrozenSlope(const Cycle& cycle);
  void CorrectAsPaper();
  void MoveAsPaper(Unknown& unknown) const;
  void Report(int number, double time, bool accepted);
  void WarnOnce(const Contact& contact, const std::string& text);
  void WarnOfMiss(const Contact& contact, const Cycle& cycle);

  const Scenario& scenario_;
  const bool as_paper_;
  const bool nothing_to_find_;  // Every μ comes from a law.
  const bool packing_;          // Loads or walls may keep contacts closed.
  const bool short_;            // No packing, and of so few contacts that all passes see all.
  Motion& motion_;
  Observer& observer_;
  std::vector<Unknown> unknowns_;  // In order of appearance.
  std::vector<bool> warned_;       // Per contact.
  std::vector<bool> missed_;       // Per law.
  double reference_speed_ = 0;     // Largest approach velocity in the episode.
  double damping_ = 1;             // Of the Newton step.
  double merit_ = 0, last_merit_ = 0, best_merit_ = 0;
  double product_ = 0;    // Of two merits, of which the next pass should leave
  double curvature_ = 0;  // this part; see StartAfresh.
  int best_number_ = 0;   // Corrections before the best pass.
  QuasiNewton jacobian_;
  enum class Stage {
    kSolving,
    kExpected,  // The recording is expected to be the last pass.
    kSolved,
  } stage_ = Stage::kSolved;
  double start_time_ = 0;        // Of the episode, and
  double until_ = 0;             // up to where it may be recorded.
  double solved_until_ = 0;      // Where the first cycle begins that is not final.
  int window_ = 0;               // Cycles in a pass at most.
  bool careful_ = false;         // Cycles are taken into it one by one, until it has
  int whole_window_ = 0;         // so many.
  bool doubtful_ = false;        // As many corrections as a short row may take have not solved it.
  int looks_ = 0;                // Passes to come that only measure durations.
  int known_ = 0;                // Cycles with which it begins then.
  std::vector<double> natural_;  // μ that suits the last cycle of each contact; NaN: none yet.
  bool crowded_ = false;         // The last pass had so many.
  bool closed_ = false;          // The last pass came to a quiet instant before that.
  double fine_ = 0;              // Tolerance of the integration that a residual near ξ demands.
  double coarse_ = 0;            // Tolerance of the first passes.
  double tolerance_ = 0;         // Of the integration in this pass, and whether it has
  bool sensitive_ = true;        // sensitivities.
  bool again_ = false;           // It is the one before once more, with sensitivities.
  int columns_ = 0;
  int episode_ = 0;
  int iterations_ = 0;
  std::int64_t total_iterations_ = 0;
  bool guessing_ = true;  // The μ of neighbours may have changed what is to be guessed.
  bool recording_ = false;
};

}  // namespace contact
