#include "cli/base/interrupt.h"

#include <csignal>

namespace contact::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void NoteInterrupt(int) { interrupted = 1; }

void Handle(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  interrupted = 0;
  Handle(NoteInterrupt);
}

Interrupt::~Interrupt() { Handle(SIG_DFL); }

bool Interrupt::raised() { return interrupted != 0; }

}  // namespace contact::cli
