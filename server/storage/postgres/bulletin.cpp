#include "storage/postgres/bulletin.h"

#include <poll.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <utility>

namespace contact::postgres {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr char kChannel[] = "contactd";
constexpr auto kLeastPause = 50ms;
constexpr auto kRetryTime = 200ms;
// A connection that is silent for so long is asked whether it still stands.
constexpr auto kSilence = 5s;

int Milliseconds(SteadyClock::duration time) {
  return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(time).count());
}

}  // namespace

Bulletin::Bulletin(std::string address, Heard heard, Missed missed)
    : address_(std::move(address)),
      heard_(std::move(heard)),
      missed_(std::move(missed)),
      wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      thread_([this] { Loop(); }) {}

Bulletin::~Bulletin() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  eventfd_write(wake_, 1);
  thread_.join();
  close(wake_);
}

void Bulletin::Tell(const Note& note) {
  bool first = false;
  {
    const MutexLock lock(mutex_);
    first = waiting_.empty();
    waiting_.Add(note);
  }
  if (first) eventfd_write(wake_, 1);  // After it the thread looks at the time.
}

bool Bulletin::stopping() const {
  const MutexLock lock(mutex_);
  return stopping_;
}

void Bulletin::Loop() {
  pthread_setname_np(pthread_self(), "bulletin");
  while (!stopping()) {
    if (!connection_ && !Connect()) {
      pollfd wait{.fd = wake_, .events = POLLIN, .revents = 0};
      ::poll(&wait, 1, Milliseconds(kRetryTime));
      ClearWake();
      continue;
    }
    if (!Wait() || !Hear() || !Send()) connection_.reset();
  }
  last_sent_ = {};
  if (connection_) Send();
}

// Listening comes first: what is read after it misses nothing.
bool Bulletin::Connect() {
  auto opened = Connection::Open(address_);
  if (!opened.ok() || !(*opened)->RunScript(std::string("LISTEN ") + kChannel).ok()) return false;
  connection_ = *std::move(opened);
  missed_();
  return true;
}

bool Bulletin::Wait() {
  SteadyClock::duration most = kSilence;
  {
    const MutexLock lock(mutex_);
    if (!waiting_.empty()) most = kLeastPause - (SteadyClock::now() - last_sent_);
  }
  if (most <= 0s) return true;
  std::array<pollfd, 2> waits = {{{.fd = wake_, .events = POLLIN, .revents = 0},
                                  {.fd = connection_->socket(), .events = POLLIN, .revents = 0}}};
  const int ready = ::poll(waits.data(), waits.size(), Milliseconds(most));
  ClearWake();
  return ready != 0 || most != kSilence || connection_->Run({"SELECT 1"}).ok();
}

bool Bulletin::Hear() {
  for (const std::string& text : connection_->TakeNotifications()) {
    for (const Note& note : NotesOf(text)) heard_(note);
  }
  return connection_->good();
}

std::vector<std::string> Bulletin::TakeDue() {
  const auto now = SteadyClock::now();
  const MutexLock lock(mutex_);
  if (waiting_.empty() || now - last_sent_ < kLeastPause) return {};
  last_sent_ = now;
  return waiting_.Take();
}

// What a lost connection takes with it is found by those who hear that they may have missed it.
bool Bulletin::Send() {
  std::vector<Statement> statements;
  for (std::string& text : TakeDue()) {
    statements.push_back(
        {"SELECT pg_notify($1, $2)", Parameters().Bytes(kChannel).Bytes(std::move(text))});
  }
  std::vector<const Statement*> all;
  for (const Statement& statement : statements) all.push_back(&statement);
  return all.empty() || connection_->Run(all).ok();
}

void Bulletin::ClearWake() {
  eventfd_t count = 0;
  eventfd_read(wake_, &count);
}

}  // namespace contact::postgres
