#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "storage/postgres/postgres_store.h"
#include "storage/store_fixture.h"
#include "testing/postgres_database.h"

namespace contact {

enum class Engine { kSqlite, kPostgres };

/// What every engine promises: the same test runs on each.
class EveryStoreTest : public StoreTest, public testing::WithParamInterface<Engine> {
 protected:
  EveryStoreTest() {
    if (GetParam() == Engine::kPostgres) postgres_.emplace();
  }
  ~EveryStoreTest() override { store_.reset(); }

  absl::StatusOr<std::unique_ptr<Store>> OpenStore(StoreOptions options) override {
    if (!postgres_) return StoreTest::OpenStore(std::move(options));
    return OpenPostgres(postgres_->address(), std::move(options));
  }
  std::int64_t Number(const std::string& sql) override {
    if (!postgres_) return StoreTest::Number(sql);
    return postgres_->Run("SELECT (" + sql + ")::bigint").Integer(0, 0);
  }

  std::optional<PostgresDatabase> postgres_;
};

/// Has the tests of a fixture run on each engine.
#define INSTANTIATE_FOR_EVERY_STORE(Fixture)                                 \
  INSTANTIATE_TEST_SUITE_P(                                                  \
      Every, Fixture, ::testing::Values(Engine::kSqlite, Engine::kPostgres), \
      [](const auto& made) { return made.param == Engine::kSqlite ? "Sqlite" : "Postgres"; })

}  // namespace contact
