#include "storage/postgres/connection.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <utility>

namespace contact::postgres {
namespace {

// What an address does not say. A server that is gone is noticed within seconds; `read-write` finds
// the primary among several hosts.
constexpr std::array kDefaults = {
    std::pair("application_name", "contactd"), std::pair("client_encoding", "UTF8"),
    std::pair("connect_timeout", "3"),         std::pair("tcp_user_timeout", "3000"),
    std::pair("keepalives_idle", "5"),         std::pair("target_session_attrs", "read-write"),
};

// Durable before answered, whatever the server's default is. A lost client holds no lock for long.
// No statement is worth the time to compile it, or to plan it at each call: every plan is one look
// at an index, whatever the parameters. Answers the session.
constexpr char kSettings[] =
    "SELECT set_config('synchronous_commit', 'on', false)"
    " WHERE current_setting('synchronous_commit') IN ('off', 'local');"
    "SET statement_timeout = '4s'; SET idle_in_transaction_session_timeout = '10s';"
    "SET search_path = contactd, pg_temp; SET jit = off;"
    "SET plan_cache_mode = force_generic_plan;"
    "SELECT pid || ' ' || extract(epoch FROM backend_start) FROM pg_stat_activity"
    " WHERE pid = pg_backend_pid()";

// Waits [ms] for less than a statement may take.
constexpr char kEnd[] =
    "SELECT pg_terminate_backend(pid, 3000) FROM pg_stat_activity"
    " WHERE pid || ' ' || extract(epoch FROM backend_start) = $1";

// A server that has not answered for so long [ms] is lost. Longer than any statement may take.
constexpr int kMostSilence = 5000;

// What an SQLSTATE means, by its first characters; PostgreSQL's appendix A.
absl::StatusCode CodeOf(std::string_view state) {
  constexpr std::array<std::pair<std::string_view, absl::StatusCode>, 12> kCodes = {{
      {"08", absl::StatusCode::kUnavailable},            // The connection.
      {"57P", absl::StatusCode::kUnavailable},           // The server ends, or begins.
      {"25006", absl::StatusCode::kUnavailable},         // It is a standby.
      {"53", absl::StatusCode::kResourceExhausted},      // Disk, memory, connections.
      {"40", absl::StatusCode::kAborted},                // Deadlock.
      {"55P03", absl::StatusCode::kAborted},             // A lock was not to be had.
      {"57014", absl::StatusCode::kAborted},             // Took too long.
      {"XX001", absl::StatusCode::kDataLoss},            // A damaged page.
      {"XX002", absl::StatusCode::kDataLoss},            // A damaged index.
      {"42501", absl::StatusCode::kFailedPrecondition},  // No right to it.
      {"3D000", absl::StatusCode::kFailedPrecondition},  // No such database.
      {"28", absl::StatusCode::kFailedPrecondition},     // Wrong user or password.
  }};
  for (const auto& [prefix, code] : kCodes) {
    if (state.starts_with(prefix)) return code;
  }
  return absl::StatusCode::kInternal;
}

std::string FirstLine(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

// What PostgreSQL says of its disk names its files, which are no business of a client: that is for
// the log.
absl::Status WithoutFiles(absl::StatusCode code, const std::string& message) {
  const bool full = code == absl::StatusCode::kResourceExhausted;
  if (!full && code != absl::StatusCode::kDataLoss) return {code, message};
  spdlog::error("{}", message);
  return {code, full ? "the database has no room for more" : "the database finds damage in it"};
}

}  // namespace

absl::StatusOr<std::unique_ptr<Connection>> Connection::Open(const std::string& address) {
  std::vector<const char*> keywords, values;
  for (const auto& [keyword, value] : kDefaults) {
    keywords.push_back(keyword);
    values.push_back(value);
  }
  keywords.insert(keywords.end(), {"dbname", nullptr});
  values.insert(values.end(), {address.c_str(), nullptr});
  std::unique_ptr<Connection> connection(
      new Connection(PQconnectdbParams(keywords.data(), values.data(), 1)));
  if (!connection->good()) {
    const std::string why = FirstLine(PQerrorMessage(connection->connection_.get()));
    const bool refused = absl::StrContains(why, "FATAL:") &&
                         !absl::StrContains(why, "starting up") &&
                         !absl::StrContains(why, "shutting down");
    return refused ? absl::FailedPreconditionError(why) : absl::UnavailableError(why);
  }
  PQsetNoticeProcessor(
      connection->connection_.get(), [](void*, const char*) {}, nullptr);
  const Rows session(PQexec(connection->connection_.get(), kSettings));
  if (!session.ok()) return connection->Failure(session.raw());
  connection->session_ = PQgetvalue(session.raw(), 0, 0);
  PQsetnonblocking(connection->connection_.get(), 1);
  return connection;
}

absl::Status Connection::RunScript(const std::string& sql) {
  const Rows answer(PQexec(connection_.get(), sql.c_str()));
  return answer.ok() ? absl::OkStatus() : Failure(answer.raw());
}

absl::Status Connection::End(const std::string& session) {
  const absl::StatusOr<Rows> ended = Run({kEnd, Parameters().Bytes(session)});
  if (!ended.ok()) return ended.status();
  if (ended->size() == 0 || ended->Integer(0, 0) != 0) return absl::OkStatus();
  return absl::UnavailableError("an earlier session of the database has not ended");
}

absl::StatusOr<Rows> Connection::Run(const Statement& statement) {
  absl::StatusOr<std::vector<Rows>> answers = Run(std::vector{&statement});
  if (!answers.ok()) return answers.status();
  return std::move(answers->front());
}

absl::StatusOr<std::vector<Rows>> Connection::Run(const std::vector<const Statement*>& statements) {
  if (PQenterPipelineMode(connection_.get()) != 1) return Failure(nullptr);
  Expected expected;
  for (const Statement* statement : statements) Send(*statement, &expected);
  PQpipelineSync(connection_.get());
  absl::StatusOr<std::vector<Rows>> answers = Answers(expected);
  PQexitPipelineMode(connection_.get());
  return answers;
}

void Connection::Send(const Statement& statement, Expected* expected) {
  const auto [name, is_new] = names_.try_emplace(statement.sql);
  if (is_new) {
    name->second = absl::StrCat("s", ++numbers_);
    PQsendPrepare(connection_.get(), name->second.c_str(), statement.sql.c_str(), 0, nullptr);
    expected->push_back(&name->first);
  }
  const Parameters& parameters = statement.parameters;
  const std::vector<int> formats(static_cast<std::size_t>(parameters.size()), 1);
  PQsendQueryPrepared(connection_.get(), name->second.c_str(), parameters.size(),
                      parameters.values().data(), parameters.lengths().data(), formats.data(), 1);
  expected->push_back(nullptr);
}

absl::StatusOr<std::vector<Rows>> Connection::Answers(const Expected& expected) {
  std::vector<Rows> answers;
  absl::Status failure;
  for (const std::string* prepares : expected) {
    const Rows answer(Next());
    if (!good()) return Failure(nullptr);
    Next();  // The end of this answer.
    if (!answer.ok()) {
      if (failure.ok()) failure = Failure(answer.raw());
      if (prepares != nullptr) names_.erase(*prepares);
    } else if (prepares == nullptr) {
      answers.push_back(answer);
    }
  }
  // A transaction may also fail at its end: then an error comes before the end.
  for (Rows end(Next()); PQresultStatus(end.raw()) != PGRES_PIPELINE_SYNC; end = Rows(Next())) {
    if (!good()) return Failure(nullptr);
    if (end.raw() != nullptr && failure.ok()) failure = Failure(end.raw());
  }
  if (!failure.ok()) return failure;
  return answers;
}

PGresult* Connection::Next() {
  PGconn* connection = connection_.get();
  for (;;) {
    const int unsent = PQflush(connection);
    if (unsent < 0) return nullptr;
    if (PQisBusy(connection) == 0) return PQgetResult(connection);
    pollfd wait{.fd = PQsocket(connection),
                .events = static_cast<short>(unsent > 0 ? POLLIN | POLLOUT : POLLIN),
                .revents = 0};
    const int ready = ::poll(&wait, 1, kMostSilence);
    if (ready == 0 || (ready < 0 && errno != EINTR)) Abandon();
    if ((wait.revents & ~POLLOUT) != 0 && PQconsumeInput(connection) == 0) return nullptr;
  }
}

std::vector<std::string> Connection::TakeNotifications() {
  std::vector<std::string> texts;
  PQconsumeInput(connection_.get());
  while (const auto notification = std::unique_ptr<PGnotify, decltype(&PQfreemem)>(
             PQnotifies(connection_.get()), PQfreemem)) {
    texts.emplace_back(notification->extra);
  }
  return texts;
}

void Connection::Abandon() { ::shutdown(PQsocket(connection_.get()), SHUT_RDWR); }

absl::Status Connection::Failure(const PGresult* result) const {
  const char* state = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  if (!good() || state == nullptr) {
    return absl::UnavailableError(absl::StrCat("the connection to the database is lost: ",
                                               FirstLine(PQerrorMessage(connection_.get()))));
  }
  return WithoutFiles(CodeOf(state), FirstLine(PQresultErrorMessage(result)));
}

std::string Connection::Name() const {
  return absl::StrCat(PQdb(connection_.get()), " at ", PQhost(connection_.get()));
}

}  // namespace contact::postgres
