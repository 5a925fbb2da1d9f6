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
  /// A cycle of the episode, and what is known of its μ.
  struct Unknown {
    /// Index in Scenario::contacts.
    int contact = 0;
    /// Place among the cycles of its contact, from 1.
    int number = 1;
    /// Start and end in the last pass that saw them [s].
    double start_time = 0, end_time = 0;
    /// μ of the next pass [N·s/mᵖ⁺¹].
    double mu = 0;
    /// μ of the last pass.
    double pass_mu = 0;
    /// The first guess.
    double start_mu = 0;
    /// μ of the best pass.
    double best_mu = 0;
    /// The μ that suits its duration in the last pass, (N7); NaN: not known.
    double natural_mu = kNaN;
    /// Its μ when all cycles of the last window had converged; NaN before.
    double settled_mu = kNaN;
    /// ε_in; NaN for a given μ.
    double restitution_in = kNaN;
    /// A(ε_in), to which the residual is relative.
    double goal = 1;
    /// A(ε_out)/A(ε_in) − 1 of the last pass, and its derivative by ε_out².
    double residual = kNaN, slope = 0;
    /// Whether Newton corrects its μ; else it is given, settled or found infeasible.
    bool iterated = false;
    /// What became of the request for ε_in so far.
    Cycle::Status status = Cycle::Status::kNotConverged;
    /// Sensitivity column of its μ in the last pass, or kNone.
    int column = kNone;
    /// Whether the last pass saw its start and its end.
    bool seen = false, ended = false;
    /// Whether it ends, as far as is known; else no μ of its own is sought.
    bool ends = true;
    /// Whether its μ is more than a guess.
    bool corrected = false;
    /// Whether its W_c is next to nothing.
    bool weak = false;
    /// Whether it begins compressed.
    bool pressed = false;
    /// Scales of its motion in the first pass: δ_m − δ_s [m], largest |δ̇| [m/s]; 0: unknown.
    double length = 0, speed = 0;
    /// ε_out² = −W_r/W_c of the last pass.
    double squared = kNaN;
    /// ∂ε_out²/∂μ for each column of the last pass.
    Eigen::ArrayXd gradient;
    /// Paper (30).
    double frozen_slope = kNaN;
    /// The bracket: μ known to give too much, and too little restitution; 0: none.
    double low = 0, high = 0;
    /// Corrections in a row that wanted μ ≤ 0.
    int shrinks = 0;
    /// Corrections in all that were clipped.
    int wild = 0;
    /// Whether μ = 0 was tried.
    bool zero_tried = false;
    /// Residuals at the ends of the bracket.
    double low_residual = 0, high_residual = 0;
    /// Whether the next pass tells if it has a solution, (N8).
    bool decided = false;
    /// Corrections of this μ.
    int corrections = 0;
    /// How often it was decided.
    int decisions = 0;
    /// How often it was iterated again after it had been given up.
    int chances = 0;
    /// How its μ was changed last.
    Iteration::Update update = Iteration::Update::kNothing;
  };

  /// Whether the work of a contact's cycle is too small to iterate.
  bool IsWeak(const ContactState& state) const;
  /// Writes into a cycle what became of the request for its restitution.
  void Label(Cycle& cycle, bool rested, bool weak) const;
  /// The unknown of a cycle; null if there is none.
  Unknown* Find(int contact, int number);
  const Unknown* Find(int contact, int number) const;
  /// The μ of (N7) that the nearest contact had last; 0: none.
  double NearestNatural(int contact) const;
  /// The first μ of an unknown.
  double FirstFactor(const Unknown& unknown, const ContactState& state, double effective_mass,
                     double external_force);
  /// The first μ of a cycle, (N1), by the law of its contact.
  double StartFactor(const ContactState& state, double effective_mass, double external_force);
  /// The contact next to `contact` whose first cycle is the last begun, or kNone.
  int Neighbour(int contact, int except) const;
  /// The speed that suits the μ of the neighbours [m/s]; 0: none pushes.
  double NeighbourSpeed(int contact) const;
  /// |ε_out − ε_in| ≤ ξ ε_in in the last pass.
  bool Converged(const Unknown& unknown) const;
  /// Whether the last pass saw the end of a cycle that is iterated.
  bool Live(const Unknown& unknown) const;
  /// What is known of cycles that begin after `end`.
  std::vector<Guess> Guesses(const State& end) const;
  /// Takes over what the last episode knew.
  void BeginWith(const std::vector<Guess>& guesses);
  /// An unknown without a guess.
  Unknown MakeUnknown(int contact, int number) const;
  /// Whether an episode that ends at `time` would not be next to nothing.
  bool Advances(double time) const;
  /// A little before the start of a cycle, at most `until` [s].
  double Before(double cycle_start, double until) const;
  /// How many cycles the first passes take in.
  int FirstWindow(const State& start) const;
  /// Whether the episode can be recorded up to a cycle that is not final, (N6).
  bool AnyFinal();
  /// Takes more cycles into the window. False: there may be no more.
  bool Widen();
  /// Forgets merits: nothing before compares with what comes.
  void StartAfresh();
  /// Leaves the worst cycle alone. False: there is no other.
  bool GiveUpWorst();
  /// Whether a step of Newton is out of bounds for a compressed cycle of many.
  bool Lost(const std::vector<Unknown*>& live, const Eigen::VectorXd& step) const;
  /// From now on cycles are taken in one by one, (N8).
  void BeCareful();
  /// Leaves cycles out of Newton's system that no μ nearby solves.
  void Decide();
  /// Whether the next pass shows if a cycle has a solution.
  bool DecideOn(Unknown& unknown) const;
  /// Declares a cycle infeasible that seems so. False: it does not.
  static bool Abandon(Unknown& unknown);
  static void DeclareInfeasible(Unknown& unknown, double mu);
  /// Whether the next pass only measures durations.
  bool LookAgain();
  /// (N7) of a cycle seen.
  static double NaturalFactor(const Contact& contact, const Cycle& cycle);
  /// Lets Newton correct an unknown, as if it were new.
  void Iterate(Unknown& unknown);
  /// Begins anew with what the window has become.
  void TakeInMore();
  static constexpr int kChances = 3;       // To be iterated again after it was given up.
  static constexpr double kSolved = 1e-3;  // Residual of a cycle that lets others be taken in.
  /// Whether a cycle is decided on.
  bool Undecided() const;
  /// Takes in one more cycle when those so far are nearly solved.
  bool TakeInNext();
  /// Whether all cycles were solved that overlap with one in time, directly or not.
  bool Foreseen(const Unknown& unknown) const;
  /// Whether what was found of a cycle without solution is true no more.
  bool MayBeSolved(const Unknown& unknown) const;
  /// Iterates again the cycles that may be solved after all.
  bool Revive();
  /// Corrections of a μ, for the ledger.
  int Corrections(const Unknown& unknown) const;
  /// Prepares the unknowns for a pass.
  void ForgetPass();
  /// Passes through the episode with the present μ.
  Motion::Pause Pass(const State& start, const std::stop_token& stop, std::int64_t step_limit);
  /// Judges the last pass, and plans the next.
  void NextPass();
  /// Largest |residual| of the live unknowns that are not weak; of all if all are weak.
  double Merit() const;
  /// Whether all live unknowns have converged.
  bool Done() const;
  /// The residual that the error of this pass may feign.
  double Feigned() const { return (short_ ? 10 : 100) * tolerance_; }
  /// Whether it is asked of each cycle if it has a solution.
  bool Doubts() const { return careful_ || doubtful_; }
  bool Exact() const { return tolerance_ <= scenario_.solver.relative_tolerance; }
  /// Keeps the μ of the last pass if it is the best so far.
  void KeepBest();
  /// Goes back to the μ of the best pass, and ends the search.
  void UseBest();
  /// Ends the search with the present μ.
  void Finish();
  /// Computes residual and slope from ε_out².
  static void Measure(Unknown& unknown);
  /// The unknowns of Newton's system.
  std::vector<Unknown*> LiveUnknowns();
  static Eigen::VectorXd Values(const std::vector<Unknown*>& live, double Unknown::*value);
  static QuasiNewton::Cycles CyclesOf(const std::vector<Unknown*>& live);
  /// Takes the Jacobian of the last pass.
  void Factorize(const std::vector<Unknown*>& live);
  /// Whether the last Jacobian may correct a pass without sensitivities.
  bool FactorsServe();
  /// Whether a cycle has ended of which that was not expected.
  bool LacksColumns();
  /// (N2): corrects all μ.
  void Correct();
  /// Leaves a cycle with its first guess.
  void GiveUp(Unknown& unknown);
  /// (N3): corrects one μ, within bounds.
  void MoveBy(Unknown& unknown, double relative_step, bool alone);
  /// The next pass is exact, or fine, and needs no sensitivities.
  void PlanLastPasses(bool converges);
  /// (N5): how exact the next pass is, and whether it has sensitivities.
  void PlanNextPass();
  /// (P1).
  static double PaperStartFactor(const ContactState& state, const Contact& contact,
                                 double velocity);
  /// Paper (30).
  static double FrozenSlope(const Cycle& cycle);
  /// Corrects every μ on its own.
  void CorrectAsPaper();
  /// (P2) to (P5).
  void MoveAsPaper(Unknown& unknown) const;
  /// Tells the observer of a pass.
  void Report(int number, double time, bool accepted);
  /// Warns of a contact, at most once.
  void WarnOnce(const Contact& contact, const std::string& text);
  /// Warns once for each law that it does not deliver what was asked.
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
