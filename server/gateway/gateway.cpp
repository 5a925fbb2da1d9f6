#include "gateway/gateway.h"

#include <pthread.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "gateway/call/service.h"
#include "gateway/dispatch.h"
#include "gateway/http2/connection.h"
#include "gateway/net/acceptor.h"

namespace contact {
namespace {

constexpr unsigned kFewestThreads = 2;
constexpr unsigned kMostThreads = 8;

}  // namespace

class GatewayThreads::Pool {
 public:
  Pool() {
    const unsigned number =
        std::clamp(std::thread::hardware_concurrency(), kFewestThreads, kMostThreads);
    for (unsigned i = 0; i < number; ++i) threads_.push_back(std::make_unique<Thread>());
  }

  boost::asio::io_context& first() { return threads_.front()->io; }

  /// Called on the first thread.
  gateway::Http2Thread& Next() { return threads_[next_++ % threads_.size()]->http2; }

 private:
  struct Thread {
    Thread()
        : thread([this] {
            pthread_setname_np(pthread_self(), "gateway");
            io.run();
          }) {}
    ~Thread() { work.reset(); }

    boost::asio::io_context io{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work{
        io.get_executor()};
    gateway::Http2Thread http2{io};
    std::jthread thread;  // Last: it uses all of the above.
  };

  std::vector<std::unique_ptr<Thread>> threads_;
  std::size_t next_ = 0;
};

GatewayThreads::GatewayThreads(std::size_t most_bytes)
    : held_(most_bytes), pool_(std::make_unique<Pool>()) {}

GatewayThreads::~GatewayThreads() = default;

Gateway::Gateway(GatewayThreads& threads, Listener listener,
                 const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options)
    : service_(std::make_shared<gateway::Service>(channel, std::move(options))) {
  acceptor_ = gateway::Acceptor::Open(
      threads.pool_->first(), std::move(listener), service_->connections(),
      service_->options().stall, [service = service_, &threads](gateway::Acceptor::Accepted next) {
        gateway::Dispatch(service, threads.held_, threads.pool_->Next(), std::move(next));
      });
}

Gateway::~Gateway() {
  Drain();
  service_->connections()->TellAll(true);
  service_->connections()->AwaitNone();
}

std::size_t Gateway::connections() const { return service_->connections()->open(); }
std::int64_t Gateway::refused_connections() const { return service_->connections()->refused(); }

void Gateway::Drain() {
  if (const auto acceptor = std::exchange(acceptor_, nullptr)) acceptor->Close();
  service_->requests().Finish(std::chrono::milliseconds(0));
  service_->connections()->TellAll(false);
}

void Gateway::Finish(std::chrono::milliseconds grace) {
  Drain();
  service_->requests().Finish(grace);
}

}  // namespace contact
