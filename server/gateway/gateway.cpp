#include "gateway/gateway.h"

#include <pthread.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "gateway/session.h"

namespace contact {
namespace {

constexpr unsigned kFewestThreads = 2;
constexpr unsigned kMostThreads = 8;

}  // namespace

/// The threads of the gateway and what runs on them. Each connection stays on one thread: threads
/// that share an io_context wake each other at each step of a call.
class Gateway::Threads {
 public:
  Threads(const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options)
      : service_(channel, std::move(options)) {
    const unsigned number =
        std::clamp(std::thread::hardware_concurrency(), kFewestThreads, kMostThreads);
    for (unsigned i = 0; i < number; ++i) threads_.push_back(std::make_unique<Thread>());
  }
  /// Waits until all connections have ended.
  ~Threads() { threads_.clear(); }

  void Finish(std::chrono::milliseconds grace) { service_.requests().Finish(grace); }

  /// Called by one thread.
  void Serve(int fd) {
    boost::asio::io_context& io = threads_[next_++ % threads_.size()]->io;
    boost::asio::post(io, [this, &io, fd] { gateway::Serve(io, service_, fd); });
  }

 private:
  struct Thread {
    Thread()
        : thread([this] {
            pthread_setname_np(pthread_self(), "http");
            io.run();
          }) {}
    ~Thread() { work.reset(); }

    boost::asio::io_context io{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work{
        io.get_executor()};
    std::jthread thread;  // Last: it uses both.
  };

  gateway::Service service_;
  std::vector<std::unique_ptr<Thread>> threads_;
  std::size_t next_ = 0;
};

Gateway::Gateway(Listener listener, const std::shared_ptr<grpc::Channel>& channel,
                 GatewayOptions options) {
  ConnectionLimits limits = FitToDescriptors(options.connections);
  limits.stall = options.stall;
  threads_ = std::make_unique<Threads>(channel, std::move(options));
  acceptor_ = std::make_unique<ConnectionAcceptor>(
      std::move(listener), limits, [this](int /*listener*/, int fd) { threads_->Serve(fd); });
}

Gateway::~Gateway() {
  acceptor_->Close();
  acceptor_->Cut();
  threads_.reset();
}

std::size_t Gateway::connections() const { return acceptor_->open(); }
std::int64_t Gateway::refused_connections() const { return acceptor_->refused(); }

void Gateway::Finish(std::chrono::milliseconds grace) {
  acceptor_->Close();
  threads_->Finish(grace);
}

}  // namespace contact
