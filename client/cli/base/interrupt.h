#pragma once

namespace contact::cli {

/// While an Interrupt lives, the first Ctrl-C only sets raised() and the second one ends the
/// process. At most one lives at a time.
class Interrupt {
 public:
  /// Installs the handler of SIGINT and clears raised().
  Interrupt();
  /// Gives SIGINT its default effect back.
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// True after a Ctrl-C since the last Interrupt was made. Safe on any thread.
  static bool raised();
};

}  // namespace contact::cli
