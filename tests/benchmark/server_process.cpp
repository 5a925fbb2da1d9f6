#include "server_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "contact/v1/job_service.grpc.pb.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

// For a server to end by itself.
constexpr std::chrono::seconds kPatience{10};

fs::path MakeFolder() {
  std::string name = (fs::temp_directory_path() / "contactd-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
  return name;
}

pid_t Spawn(const std::vector<std::string>& command, int out) {
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("cannot start " + command.front());
  if (pid > 0) return pid;
  // However this process ends, no server outlives it.
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent) {
    ::dup2(out, STDOUT_FILENO);
    ::execv(words[0], words.data());
  }
  ::_exit(127);
}

std::string AddressIn(const std::string& greeting) {
  const std::size_t at = greeting.find("127.0.0.1:");
  if (at == std::string::npos) throw std::runtime_error("the server said: " + greeting);
  return greeting.substr(at, greeting.find_first_of(",\n", at) - at);
}

// As contactd calls the threads that solve.
constexpr char kWorker[] = "worker";

struct Thread {
  pid_t id;
  std::string name;
};

std::vector<Thread> ThreadsOf(pid_t process) {
  std::vector<Thread> threads;
  std::error_code gone;
  for (const auto& task : fs::directory_iterator(fmt::format("/proc/{}/task", process), gone)) {
    Thread thread{std::stoi(task.path().filename()), ""};
    std::getline(std::ifstream(task.path() / "comm"), thread.name);
    threads.push_back(std::move(thread));
  }
  return threads;
}

// One thread a call, as plain as gRPC gets.
class BareService final : public v1::JobService::Service {
 public:
  BareService(const fs::path& file, int messages, int bytes)
      : fd_(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)), messages_(messages) {
    auto* const column = message_.add_events()->mutable_frame_chunk()->add_columns();
    column->set_values(std::string(static_cast<std::size_t>(bytes), 'x'));
  }
  ~BareService() override { ::close(fd_); }

  grpc::Status CreateJob(grpc::ServerContext*, const v1::CreateJobRequest* request,
                         v1::Job* job) override {
    static constexpr std::array<char, 1024> kBlock{};
    if (::pwrite(fd_, kBlock.data(), kBlock.size(), 0) < 0 || ::fdatasync(fd_) != 0) {
      return {grpc::StatusCode::INTERNAL, "disk"};
    }
    *job = request->job();
    return grpc::Status::OK;
  }

  grpc::Status WatchJob(grpc::ServerContext*, const v1::WatchJobRequest*,
                        grpc::ServerWriter<v1::WatchJobResponse>* writer) override {
    for (int i = 0; i < messages_ && writer->Write(message_); ++i) {
    }
    return grpc::Status::OK;
  }

 private:
  const int fd_;
  const int messages_;
  v1::WatchJobResponse message_;
};

}  // namespace

ServerProcess::ServerProcess(std::vector<std::string> command) : folder_(MakeFolder()) {
  command.push_back("--listen=127.0.0.1:0");
  command.push_back("--data-dir=" + (folder_ / "data").string());
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = Spawn(command, ends[1]);
  ::close(ends[1]);
  std::FILE* const out = ::fdopen(ends[0], "r");
  std::array<char, 512> line{};
  const char* const greeting = std::fgets(line.data(), static_cast<int>(line.size()), out);
  std::fclose(out);
  address_ = AddressIn(greeting == nullptr ? "" : greeting);
}

ServerProcess::~ServerProcess() {
  ::kill(pid_, SIGTERM);
  const auto limit = std::chrono::steady_clock::now() + kPatience;
  while (::waitpid(pid_, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > limit) ::kill(pid_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

double ServerProcess::ResidentMegabytes() const {
  std::ifstream status(fmt::format("/proc/{}/status", pid_));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}

double ServerProcess::CpuSeconds() const {
  std::ifstream stat(fmt::format("/proc/{}/stat", pid_));
  std::string field;
  std::getline(stat, field, ')');  // The name may have spaces in it.
  for (int i = 0; i < 11; ++i) stat >> field;
  double user = 0;
  double system = 0;
  stat >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

double ServerProcess::WorkerSeconds() const {
  double nanoseconds = 0;
  for (const Thread& thread : ThreadsOf(pid_)) {
    double used = 0;
    std::ifstream(fmt::format("/proc/{}/task/{}/schedstat", pid_, thread.id)) >> used;
    if (thread.name == kWorker) nanoseconds += used;
  }
  return 1e-9 * nanoseconds;
}

WorkersApart::WorkersApart(const ServerProcess& server) : server_(server) {
  if (::sched_getaffinity(0, sizeof all_, &all_) != 0 || CPU_COUNT(&all_) < 2) {
    throw std::runtime_error("two cores are needed");
  }
  std::array<cpu_set_t, 2> cores;
  int core = 0;
  for (cpu_set_t& one : cores) {
    while (!CPU_ISSET(core, &all_)) ++core;
    CPU_ZERO(&one);
    CPU_SET(core++, &one);
  }
  for (const Thread& thread : ThreadsOf(server.pid())) {
    ::sched_setaffinity(thread.id, sizeof(cpu_set_t), &cores[thread.name == kWorker ? 0 : 1]);
  }
  for (const Thread& thread : ThreadsOf(::getpid())) {
    ::sched_setaffinity(thread.id, sizeof(cpu_set_t), &cores[1]);
  }
}

WorkersApart::~WorkersApart() {
  for (const pid_t process : {server_.pid(), ::getpid()}) {
    for (const Thread& thread : ThreadsOf(process)) {
      ::sched_setaffinity(thread.id, sizeof all_, &all_);
    }
  }
}

int ServeBare(const fs::path& data_dir, int messages, int bytes) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  fs::create_directories(data_dir);
  BareService service(data_dir / "file", messages, bytes);
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&service);
  const auto server = builder.BuildAndStart();
  if (!server) return EXIT_FAILURE;
  fmt::print("bare gRPC on 127.0.0.1:{}\n", port);
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  server->Shutdown();
  return EXIT_SUCCESS;
}

}  // namespace contact
