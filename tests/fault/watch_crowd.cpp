// Watches one job many times over, from a process that a test may kill.
//
//   watch_crowd ADDRESS JOB WATCHERS CONNECTIONS [KIND]
//
// Says "attached SECONDS" when all have their first message, and, when all streams have ended, a
// line of JSON with what came: streams that ended with OK and otherwise, events, and
// percentiles of the milliseconds from the server's stamp of a live event to its receipt.
#include "testing/watch_crowd.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using contact::testing::Percentile;
using contact::testing::WatchCrowd;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{120};

int Watch(const WatchCrowd::Options& options) {
  const auto begin = steady_clock::now();
  WatchCrowd crowd(options);
  if (!crowd.AwaitAttached(kPatience)) {
    fmt::print(stderr, "attached: {} of {}\n", crowd.figures().attached, options.watchers);
    return EXIT_FAILURE;
  }
  fmt::print("attached {}\n", std::chrono::duration<double>(steady_clock::now() - begin).count());
  std::fflush(stdout);
  if (!crowd.AwaitEnded(0, kPatience)) return EXIT_FAILURE;
  const auto figures = crowd.figures();
  fmt::print(R"({{"ended": {}, "failed": {}, "events": {}, "p50": {}, "p99": {}, "max": {}}})"
             "\n",
             figures.ended, figures.failed, figures.events, Percentile(figures.latencies_ms, 50),
             Percentile(figures.latencies_ms, 99), Percentile(figures.latencies_ms, 100));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    fmt::print(stderr, "watch_crowd ADDRESS JOB WATCHERS CONNECTIONS [KIND]\n");
    return EXIT_FAILURE;
  }
  WatchCrowd::Options options;
  options.address = argv[1];
  options.request.set_name(argv[2]);
  options.watchers = std::atoi(argv[3]);
  options.connections = std::atoi(argv[4]);
  if (argc > 5) options.request.add_kinds(argv[5]);
  return Watch(options);
}
