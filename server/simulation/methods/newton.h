#pragma once

#include <Eigen/Core>

namespace contact {

/// Equations r(x) = 0 as Newton asks for them.
class Residuals {
 public:
  /// What they are at one x.
  struct Value {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd slopes;  ///< ∂residuals/∂step; empty: not asked for.
    double merit = 0;        ///< What a step must lower; as a rule Σ residual².
    double miss = 0;         ///< What is compared with the goal; as a rule the largest |residual|.
    bool valid = true;       ///< False: nothing is known here, a step must not lead here.
  };

  virtual ~Residuals() = default;
  virtual Value At(const Eigen::VectorXd& x, bool slopes) = 0;
  /// Where a step leads to from x. What a step is in is up to the equations, which may limit it.
  virtual Eigen::VectorXd Moved(const Eigen::VectorXd& x, const Eigen::VectorXd& step) const {
    return x + step;
  }
  /// A step was taken; `part`: of the whole one.
  virtual void OnStep(double part) { (void)part; }
  /// Whether no value means anything any more.
  virtual bool Aborted() const { return false; }
};

/// What a search for a root may do.
struct NewtonOptions {
  double goal = 1e-10;         ///< The miss at which it is found.
  int most_steps = 100;        ///< Steps at most.
  bool slopes_at_once = true;  ///< A whole step is tried with slopes; else they follow if it helps.
  int most_trials = 20;        ///< Trials of a step, each 0.35 times as long as the one before.
  bool limited = false;        ///< No unknown can be moved by −1 or less: see Sinks.
  double blind = 0;            ///< A last step leads there unseen if it leaves less than this.
};

/// Newton's method with steps that are shortened until the merit falls. It knows nothing of what
/// the equations mean.
class Newton {
 public:
  enum class End {
    kSolved,
    kUnseen,   ///< A last step was taken that leaves less than `blind`, and not looked at.
    kStalled,  ///< No step helps.
    kLimit,    ///< As many steps as are allowed.
    kAborted,
  };

  explicit Newton(Residuals& equations) : equations_(equations) {}

  /// Goes on from x, where the equations are known to have the value `at`, with slopes.
  End Solve(const NewtonOptions& options, Residuals::Value at, Eigen::VectorXd* x);

  /// Newton's step from a value with slopes; where these are singular the residuals back.
  static Eigen::VectorXd Step(const Residuals::Value& value);

  int steps() const { return steps_; }

 private:
  bool Sinks(const Eigen::VectorXd& step);
  bool Correct(Eigen::VectorXd* x);

  Residuals& equations_;
  NewtonOptions options_;
  Residuals::Value now_;
  int steps_ = 0;
  Eigen::Array<bool, Eigen::Dynamic, 1> sinks_;  // Unknowns that the last step led below −1.
};

}  // namespace contact
