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

/// The threads of the gateway and what runs on them.
class Gateway::Threads {
 public:
  Threads(const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options)
      : service_(channel, std::move(options)) {
    const unsigned number =
        std::clamp(std::thread::hardware_concurrency(), kFewestThreads, kMostThreads);
    for (unsigned i = 0; i < number; ++i) {
      threads_.emplace_back([this] {
        pthread_setname_np(pthread_self(), "http");
        io_.run();
      });
    }
  }
  /// Waits until all connections have ended.
  ~Threads() {
    work_.reset();
    threads_.clear();
  }

  void Serve(int fd) {
    boost::asio::post(io_, [this, fd] { gateway::Serve(io_, service_, fd); });
  }

 private:
  gateway::Service service_;
  boost::asio::io_context io_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
      io_.get_executor()};
  std::vector<std::jthread> threads_;  // Last: they use all of the above.
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
  Close();
  acceptor_->Cut();
  threads_.reset();
}

std::size_t Gateway::connections() const { return acceptor_->open(); }
std::int64_t Gateway::refused_connections() const { return acceptor_->refused(); }
void Gateway::Close() { acceptor_->Close(); }

}  // namespace contact
