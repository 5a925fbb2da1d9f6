#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_limit.h"
#include "read_config.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

using testing::HasSubstr;

class ConfigTest : public testing::Test {
 protected:
  ~ConfigTest() override {
    for (const auto& [name, value] : environment_) unsetenv(name.c_str());
  }

  void Set(const std::string& name, const std::string& value) {
    environment_[name] = value;
    setenv(name.c_str(), value.c_str(), 1);
  }

  static std::variant<Config, Exit> Read(std::vector<const char*> flags) {
    flags.insert(flags.begin(), "contactd");
    return ReadConfig(static_cast<int>(flags.size()), flags.data());
  }

  static Config Good(std::vector<const char*> flags) {
    flags.insert(flags.begin(), {"--data-dir", "/data"});
    const auto read = Read(std::move(flags));
    if (const Exit* exit = std::get_if<Exit>(&read)) ADD_FAILURE() << exit->text;
    return std::holds_alternative<Config>(read) ? std::get<Config>(read) : Config{};
  }

  static Exit Bad(std::vector<const char*> flags) {
    flags.insert(flags.begin(), {"--data-dir", "/data"});
    const auto read = Read(std::move(flags));
    EXPECT_TRUE(std::holds_alternative<Exit>(read));
    return std::holds_alternative<Exit>(read) ? std::get<Exit>(read) : Exit{-1, ""};
  }

  std::string File(const std::string& text) {
    std::string path = (folder_.path() / "contactd.conf").string();
    std::ofstream(path) << text;
    return path;
  }

 private:
  const TempDirectory folder_;
  std::map<std::string, std::string> environment_;
};

TEST_F(ConfigTest, FsckIsAskedForByItsNameAndTakesTheSameFlags) {
  EXPECT_FALSE(Good({}).fsck);
  const Config config = Good({"fsck", "--data-dir", "/other"});
  EXPECT_TRUE(config.fsck);
  EXPECT_EQ(config.data_dir, "/other");
  EXPECT_EQ(Bad({"fsck", "--no-such-flag"}).code, 2);
  EXPECT_EQ(Bad({"fsk"}).code, 2);
}

TEST_F(ConfigTest, StoreIsADirectoryOrADatabase) {
  EXPECT_EQ(Good({}).store_address, "");
  const Config config = Good({"--store", "postgresql://ada@db/contact"});
  EXPECT_EQ(config.store_address, "postgresql://ada@db/contact");
  EXPECT_EQ(config.store.max_bytes, 0) << "the disk of the directory is not the database's";
  EXPECT_TRUE(Good({"migrate", "--store", "postgres://db/contact"}).migrate);
  EXPECT_EQ(Good({"copy-store", "--from", "/a", "--to", "postgres://db/b"}).copy_from, "/a");
  EXPECT_THAT(Bad({"--store", "mysql://db"}).text, HasSubstr("must be postgresql://"));
  EXPECT_THAT(Bad({"migrate"}).text, HasSubstr("needs --store"));
  EXPECT_THAT(Bad({"fsck", "--store", "postgres://db/contact"}).text, HasSubstr("pg_amcheck"));
  EXPECT_THAT(Bad({"--store", "postgres://db/contact", "--max-stored-bytes", "1000"}).text,
              HasSubstr("its own limits"));
}

TEST_F(ConfigTest, DefaultsServeThisMachineOnly) {
  const Config config = Good({});
  EXPECT_EQ(config.listen, "127.0.0.1:7070");
  EXPECT_GE(config.jobs.workers, 1);
  EXPECT_EQ(config.jobs.checkpoint_interval, std::chrono::seconds(1));
  EXPECT_TRUE(config.rpc.reflection);
  EXPECT_FALSE(config.rpc.channelz);
}

TEST_F(ConfigTest, DefaultsLetNoJobTakeTheServerForItself) {
  const RunBudget& budget = Good({}).jobs.max_budget;
  EXPECT_EQ(budget.wall_time, std::chrono::hours(1));
  EXPECT_EQ(budget.steps, 1'000'000'000);
  EXPECT_EQ(budget.output_bytes, 4'000'000'000);
  EXPECT_LE(budget.memory_bytes, std::int64_t{1} << 30);
  EXPECT_LE(8 * Good({"--workers=8"}).jobs.max_budget.memory_bytes, MemoryLimit() / 2);
  EXPECT_EQ(Good({"--max-memory=2GiB"}).jobs.max_budget.memory_bytes, std::int64_t{2} << 30);
  EXPECT_GT(Good({}).store.max_bytes, 1'000'000) << "most of the disk";
  EXPECT_EQ(Good({"--max-stored-bytes=0"}).store.max_bytes, 0);
  const RunBudget any =
      Good({"--max-wall-time=0", "--max-steps=0", "--max-output-bytes=0", "--max-memory=0"})
          .jobs.max_budget;
  EXPECT_EQ(any.wall_time.count() + any.steps + any.output_bytes + any.memory_bytes, 0);
}

TEST_F(ConfigTest, DefaultsLetNoClientTakeTheServerForItself) {
  const Config config = Good({});
  EXPECT_EQ(config.rpc.max_message_bytes, 2 << 20);
  EXPECT_EQ(config.rpc.calls.max_watchers_per_peer, 100);
  EXPECT_EQ(config.jobs.max_disk_percent, 80);
  EXPECT_EQ(config.jobs.admin_slots, 10);
  EXPECT_EQ(config.max_audit_bytes, 100'000'000);
}

TEST_F(ConfigTest, DefaultsLimitEachOwnerWhereCallersAreToldApart) {
  for (const char* flag : {"--tokens=/t", "--listen-as=unix:/x user:ci tenant:acme roles:submit"}) {
    const Config config = Good({"--listen=unix:/s", flag});
    const OwnerLimits& owner = config.jobs.owner_limits;
    EXPECT_EQ(owner.unfinished_jobs, 1000);
    EXPECT_EQ(owner.cells, 200'000);
    EXPECT_EQ(owner.stored_bytes, config.store.max_bytes / 2);
    EXPECT_EQ(owner.creates_per_second, 100);
    EXPECT_EQ(owner.create_burst, 1000);
    EXPECT_EQ(owner.streams, 100);
    EXPECT_EQ(owner.calls, 500);
    EXPECT_EQ(owner.connections, 100);
  }
  const OwnerLimits all = Good({}).jobs.owner_limits;
  EXPECT_EQ(all.unfinished_jobs + all.cells + all.stored_bytes + all.streams + all.calls, 0);
  EXPECT_EQ(all.connections, 0) << "everybody is one owner";
  EXPECT_EQ(all.creates_per_second, 0);
}

TEST_F(ConfigTest, LimitsOfOwnersArrive) {
  const Config config =
      Good({"--max-unfinished-per-owner=1", "--max-cells-per-owner=2",
            "--max-stored-bytes-per-owner=3MB", "--max-creates-per-second-per-owner=0.5",
            "--max-create-burst-per-owner=4", "--max-watchers-per-owner=5",
            "--max-calls-per-owner=6", "--max-connections-per-owner=7", "--max-running-per-owner=8",
            "--admin-slots=9", "--max-disk-percent=90", "--max-audit-bytes=10MB"});
  const OwnerLimits& owner = config.jobs.owner_limits;
  EXPECT_EQ(owner.unfinished_jobs, 1);
  EXPECT_EQ(owner.cells, 2);
  EXPECT_EQ(owner.stored_bytes, 3'000'000);
  EXPECT_EQ(owner.creates_per_second, 0.5);
  EXPECT_EQ(owner.create_burst, 4);
  EXPECT_EQ(owner.streams, 5);
  EXPECT_EQ(owner.calls, 6);
  EXPECT_EQ(owner.connections, 7);
  EXPECT_EQ(config.jobs.max_running_per_owner, 8);
  EXPECT_EQ(config.jobs.admin_slots, 9);
  EXPECT_EQ(config.jobs.max_disk_percent, 90);
  EXPECT_EQ(config.max_audit_bytes, 10'000'000);
  EXPECT_EQ(Bad({"--max-calls-per-owner=-1"}).code, 2);
  EXPECT_EQ(Bad({"--max-disk-percent=101"}).code, 2);
}

TEST_F(ConfigTest, EveryFlagArrives) {
  const Config config = Good({"--listen",    "[::1]:0",
                              "--workers=3", "--max-message-bytes",
                              "65536",       "--max-bodies",
                              "7",           "--max-contacts",
                              "8",           "--max-samples",
                              "9",           "--max-queued-jobs",
                              "10",          "--max-watchers",
                              "11",          "--max-cells",
                              "12",          "--write-stall-seconds",
                              "0.5",         "--max-connections",
                              "13",          "--max-connections-per-peer",
                              "14",          "--max-watchers-per-peer",
                              "15",          "--max-creates-per-second",
                              "1.5",         "--max-create-burst",
                              "16",          "--max-metadata-bytes",
                              "2048",        "--max-stored-bytes",
                              "1000000",     "--metrics-listen",
                              "127.0.0.1:0", "--log-format",
                              "json",        "--max-rpc-memory-bytes",
                              "16777216",    "--log-level",
                              "warn",        "--no-reflection",
                              "--channelz",  "--port-file",
                              "/port"});
  EXPECT_EQ(config.listen, "[::1]:0");
  EXPECT_EQ(config.data_dir, "/data");
  EXPECT_EQ(config.jobs.workers, 3);
  EXPECT_EQ(config.rpc.max_message_bytes, 65536);
  EXPECT_EQ(config.jobs.scenario_limits.max_bodies, 7);
  EXPECT_EQ(config.jobs.scenario_limits.max_contacts, 8);
  EXPECT_EQ(config.jobs.scenario_limits.max_samples, 9);
  EXPECT_EQ(config.jobs.max_queued_jobs, 10);
  EXPECT_EQ(config.jobs.max_watchers, 11);
  EXPECT_EQ(config.jobs.scenario_limits.max_cells, 12);
  EXPECT_EQ(config.rpc.write_stall, std::chrono::milliseconds(500));
  EXPECT_EQ(config.connections.in_all, 13);
  EXPECT_EQ(config.connections.per_peer, 14);
  EXPECT_EQ(config.rpc.calls.max_watchers_per_peer, 15);
  EXPECT_EQ(config.rpc.calls.max_creates_per_second, 1.5);
  EXPECT_EQ(config.rpc.calls.max_create_burst, 16);
  EXPECT_EQ(config.rpc.calls.max_metadata_bytes, 2048);
  EXPECT_EQ(config.store.max_bytes, 1'000'000);
  EXPECT_EQ(config.metrics_listen, "127.0.0.1:0");
  EXPECT_EQ(config.max_connection_bytes, 16 << 20);
  EXPECT_EQ(config.log_format, LogFormat::kJson);
  EXPECT_EQ(config.log_level, spdlog::level::warn);
  EXPECT_FALSE(config.rpc.reflection);
  EXPECT_TRUE(config.rpc.channelz);
  EXPECT_EQ(config.port_file, "/port");
}

TEST_F(ConfigTest, TheGatewayHasAnAddressNamesAndOrigins) {
  const Config config =
      Good({"--http-listen", "127.0.0.1:0", "--http-port-file", "/http", "--http-host", "a.example",
            "--http-host", "b.example", "--http-allow-origin", "https://c.example", "--web-dir",
            "/web", "--docs-dir", "/docs"});
  EXPECT_EQ(config.http_listen, "127.0.0.1:0");
  EXPECT_EQ(config.http_port_file, "/http");
  EXPECT_EQ(config.http_rules.hosts, (std::vector<std::string>{"a.example", "b.example"}));
  EXPECT_EQ(config.http_rules.origins, std::vector<std::string>{"https://c.example"});
  EXPECT_EQ(config.web_dir, "/web");
  EXPECT_EQ(config.docs_dir, "/docs");
  EXPECT_EQ(Good({}).http_listen, "");
}

TEST_F(ConfigTest, TheGatewayLetsInNobodyWhomListenKeepsOut) {
  for (const auto& flags : std::vector<std::vector<const char*>>{
           {"--http-listen", "0.0.0.0:80"},
           {"--http-listen", "127.0.0.1:80", "--listen", "unix:/s"},
           {"--http-listen", "127.0.0.1:80", "--listen", "unix:/s", "--tokens", "/t"}}) {
    auto all = flags;
    all.insert(all.begin(), {"--data-dir", "/data"});
    const auto read = Read(all);
    ASSERT_TRUE(std::holds_alternative<Exit>(read)) << flags[1];
    EXPECT_THAT(std::get<Exit>(read).text, HasSubstr("--http-listen"));
    all.push_back("--insecure-i-know");
    EXPECT_TRUE(std::holds_alternative<Config>(Read(all))) << flags[1];
  }
  Good({"--http-listen", "unix:/h", "--listen", "unix:/s"});
  Good({"--http-listen", "unix:/h", "--listen", "unix:/s", "--tokens", "/t"});
}

TEST_F(ConfigTest, DurationsTakeEveryUnitAndAreRoundedUp) {
  const Config config = Good({"--retain-for", "30d", "--compact-after", "1.5h", "--step-timeout",
                              "90", "--max-wall-time", "10m", "--checkpoint-interval", "250ms"});
  EXPECT_EQ(config.jobs.retention.age, std::chrono::days(30));
  EXPECT_EQ(config.jobs.retention.compact_after, std::chrono::minutes(90));
  EXPECT_EQ(config.jobs.step_timeout, std::chrono::seconds(90));
  EXPECT_EQ(config.jobs.max_budget.wall_time, std::chrono::minutes(10));
  EXPECT_EQ(config.jobs.checkpoint_interval, std::chrono::milliseconds(250));
  EXPECT_EQ(Good({"--retain-for", "1ms"}).jobs.retention.age, std::chrono::seconds(1));
}

TEST_F(ConfigTest, BudgetsAndRetentionArrive) {
  const Config config = Good({"--max-steps", "17", "--max-output-bytes", "2KiB", "--max-attempts",
                              "4", "--retain-bytes", "1GB"});
  EXPECT_EQ(config.jobs.max_budget.steps, 17);
  EXPECT_EQ(config.jobs.max_budget.output_bytes, 2048);
  EXPECT_EQ(config.jobs.max_attempts, 4);
  EXPECT_EQ(config.jobs.retention.bytes, 1'000'000'000);
}

TEST_F(ConfigTest, FlagBeatsVariableBeatsFile) {
  const std::string file = File("workers = 2\nmax-bodies = 20\nmax-contacts = 200\n");
  Set("CONTACTD_CONFIG", file);
  Set("CONTACTD_MAX_BODIES", "30");
  Set("CONTACTD_MAX_CONTACTS", "300");
  const Config config = Good({"--max-contacts", "400"});
  EXPECT_EQ(config.jobs.workers, 2);
  EXPECT_EQ(config.jobs.scenario_limits.max_bodies, 30);
  EXPECT_EQ(config.jobs.scenario_limits.max_contacts, 400);
}

TEST_F(ConfigTest, SwitchesCanBeSetInFileAndEnvironment) {
  const std::string file = File("no-reflection = true\nlisten = \"0.0.0.0:0\"\n");
  Set("CONTACTD_INSECURE_I_KNOW", "1");
  const Config config = Good({"--config", file.c_str()});
  EXPECT_EQ(config.listen, "0.0.0.0:0");
  EXPECT_FALSE(config.rpc.reflection);
}

TEST_F(ConfigTest, UnknownKeyInTheFileIsRefused) {
  const std::string file = File("wrokers = 2\n");
  const Exit exit = Bad({"--config", file.c_str()});
  EXPECT_EQ(exit.code, kExitUsage);
  EXPECT_THAT(exit.text, HasSubstr("wrokers"));
}

TEST_F(ConfigTest, UnknownWordIsRefusedWithTheNearestOne) {
  EXPECT_THAT(Bad({"--lisen", "127.0.0.1:0"}).text,
              HasSubstr("unknown flag '--lisen' — did you mean '--listen'?"));
  EXPECT_THAT(Bad({"--datadir=x"}).text, HasSubstr("did you mean '--data-dir'?"));
  EXPECT_THAT(Bad({"fskc"}).text, HasSubstr("unknown command 'fskc' — did you mean 'fsck'?"));
}

TEST_F(ConfigTest, MissingFileIsRefused) {
  EXPECT_EQ(Bad({"--config", "/nowhere/contactd.conf"}).code, kExitUsage);
}

TEST_F(ConfigTest, BadValuesAreUsageErrorsThatNameTheFlag) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"--workers", "0"},
      {"--workers", "many"},
      {"--max-message-bytes", "-1"},
      {"--max-samples", "1e99"},
      {"--max-cells", "0"},
      {"--write-stall-seconds", "0"},
      {"--log-level", "loud"},
      {"--log-format", "xml"},
      {"--listen", "127.0.0.1"},
      {"--listen", ":7070"},
      {"--listen", "127.0.0.1:http"},
      {"--listen", "127.0.0.1:65536"},
      {"--listen", "::1:70"},
      {"--listen", "unix:"},
      {"--max-connections", "0"},
      {"--max-creates-per-second", "-1"},
      {"--metrics-listen", "9464"},
      {"--metrics-listen", "0.0.0.0:9464"},
      {"--max-stored-bytes", "-1"},
      {"--retain-for", "soon"},
      {"--compact-after", "-1s"},
      {"--step-timeout", "1y"},
  };
  for (const auto& [flag, value] : cases) {
    const Exit exit = Bad({flag, value});
    EXPECT_EQ(exit.code, kExitUsage) << flag << ' ' << value;
    EXPECT_THAT(exit.text, HasSubstr(flag)) << value;
  }
}

TEST_F(ConfigTest, AddressOthersCanReachNeedsConsent) {
  for (const char* address : {"0.0.0.0:7070", "192.168.1.2:7070", "[::]:7070", "example.org:7070",
                              "127.0.0.1.example.org:7070"}) {
    const Exit exit = Bad({"--listen", address});
    EXPECT_EQ(exit.code, kExitUsage) << address;
    EXPECT_THAT(exit.text, HasSubstr("--insecure-i-know"));
    const Config config = Good({"--listen", address, "--insecure-i-know", "--channelz"});
    EXPECT_EQ(config.listen, address);
    EXPECT_FALSE(config.rpc.reflection) << "reflection is for loopback";
    EXPECT_FALSE(config.rpc.channelz) << "and so is channelz";
  }
  for (const char* address : {"127.0.0.1:1", "127.8.9.10:1", "localhost:1", "[::1]:1"}) {
    EXPECT_EQ(Good({"--listen", address}).listen, address);
  }
}

TEST_F(ConfigTest, SocketFileIsLocal) {
  const Config config = Good({"--listen", "unix:/run/contactd.sock"});
  EXPECT_EQ(config.listen, "unix:/run/contactd.sock");
  EXPECT_TRUE(config.rpc.reflection);
}

TEST_F(ConfigTest, EveryListenerIsCheckedAsTheFirst) {
  const Config config = Good({"--listen", "unix:/run/contactd.sock", "--listen", "127.0.0.1:0"});
  EXPECT_EQ(config.listen, "unix:/run/contactd.sock");
  EXPECT_EQ(config.more_listen, std::vector<std::string>{"127.0.0.1:0"});
  setenv("CONTACTD_LISTEN", "127.0.0.1:9", 1);
  EXPECT_TRUE(Good({"--listen=127.0.0.1:0"}).more_listen.empty()) << "the command line wins";
  unsetenv("CONTACTD_LISTEN");
  EXPECT_EQ(Bad({"--listen", "127.0.0.1:0", "--listen", "0.0.0.0:0"}).code, kExitUsage);
  EXPECT_EQ(Bad({"--listen", "127.0.0.1:0", "--listen", "nowhere"}).code, kExitUsage);
}

TEST_F(ConfigTest, DataDirDefaultsToTheStateFolderOfTheUser) {
  const char* home = getenv("HOME");
  const std::string before = home != nullptr ? home : "";
  Set("XDG_STATE_HOME", "/state");
  EXPECT_EQ(std::get<Config>(Read({})).data_dir, "/state/contactd");
  unsetenv("XDG_STATE_HOME");
  setenv("HOME", "/home/jo", 1);
  EXPECT_EQ(std::get<Config>(Read({})).data_dir, "/home/jo/.local/state/contactd");
  unsetenv("HOME");
  const auto read = Read({});
  ASSERT_TRUE(std::holds_alternative<Exit>(read));
  EXPECT_THAT(std::get<Exit>(read).text, HasSubstr("--data-dir"));
  setenv("HOME", before.c_str(), 1);
}

TEST_F(ConfigTest, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(Bad({"--help"}).code, kExitOk);
  EXPECT_THAT(Bad({"--help"}).text, HasSubstr("CONTACTD_DATA_DIR"));
  EXPECT_EQ(Bad({"--version"}).code, kExitOk);
  EXPECT_THAT(Bad({"--version"}).text, HasSubstr("contactd 0."));
}

}  // namespace
}  // namespace contact
