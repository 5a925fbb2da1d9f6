#include "storage/store.h"

#include <utility>

namespace contact {

void Store::Create(const NewJob& job, Callback<StoredJob> done) {
  Insert(ToInsert(job), std::move(done));
}

Store::Encoded Store::Encode(const JobUpdate& update) {
  return std::make_shared<const JobChange>(ToChange(update));
}

void Store::Update(const JobUpdate& update, Callback<std::uint64_t> done) {
  Update(Encode(update), update.epoch, std::move(done));
}

}  // namespace contact
