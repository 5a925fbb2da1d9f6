#pragma once

namespace contact::cli {

/// While it lives, the first Ctrl-C is only noted; the second ends the process. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool raised();
};

}  // namespace contact::cli
