#include <google/protobuf/io/zero_copy_stream_impl.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <cstdio>

#include "cli/base/files.h"
#include "cli/base/interrupt.h"
#include "cli/export/writers.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"

namespace contact::cli {
namespace {

// Writes what it hears, and notes what it is spared.
class Writer final : public WatchObserver {
 public:
  Writer(const std::string& path, const v1::Job& job) : file_(path), stream_(fileno(file_.get())) {
    Write(job);
  }

  void OnEvent(const v1::Event& event) override {
    if (event.has_bookmark()) return;
    if (event.has_gap()) {
      has_holes_ = true;
      return;
    }
    Write(event);
    ++events_;
  }

  bool has_holes() const { return has_holes_; }
  std::int64_t events() const { return events_; }

  void Close() {
    if (!stream_.Flush()) Fail();
    file_.Close();
  }

 private:
  void Write(const google::protobuf::Message& message) {
    if (!google::protobuf::util::SerializeDelimitedToZeroCopyStream(message, &stream_)) Fail();
  }

  [[noreturn]] static void Fail() { throw Failure(ExitCode::kLocal, "the file cannot be written"); }

  OutputFile file_;
  google::protobuf::io::FileOutputStream stream_;
  std::int64_t events_ = 0;
  bool has_holes_ = false;
};

}  // namespace

std::int64_t WriteProtobuf(Client& client, const std::string& job, const Settings& settings,
                           const std::string& path) {
  const Interrupt interrupt;
  WatchOptions options{.name = JobName(job), .kinds = {"state_changed"}};
  WatchObserver silence;
  WatchToEnd(client, options, settings, silence);
  options.kinds.clear();
  options.overflow = v1::DeliveryOptions::LAG;
  std::int64_t events = 0;
  ReplayWhole(job, [&] {
    Writer writer(path, GetJob(client, job));
    WatchToEnd(client, options, settings, writer);
    writer.Close();
    events = writer.events();
    return !writer.has_holes();
  });
  return events;
}

}  // namespace contact::cli
