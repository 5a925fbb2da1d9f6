#pragma once

#include <sqlite3.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <new>
#include <utility>

namespace contact {

/// Stands between SQLite and the disk of this process, and makes the n-th write or sync fail with
/// an I/O error. One at a time.
class FailingDisk {
 public:
  FailingDisk() : real_(sqlite3_vfs_find(nullptr)), vfs_(*real_) {
    instance_ = this;
    vfs_.zName = "failing";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.xOpen = Open;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~FailingDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real_, 1);
  }
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;

  /// Lets `n` more writes and syncs succeed, then fails all.
  void FailAfter(int n) { left_ = n; }
  /// Lets `n` more succeed, then fails one, as a disk does that has a bad moment.
  void FailOnceAfter(int n) {
    once_ = true;
    left_ = n;
  }
  /// From now on there is no space for writes while `full` says so. It is called on the thread that
  /// writes.
  void FullWhile(std::function<bool()> full) { full_ = std::move(full); }
  /// Succeeds from now on.
  void Heal() { left_ = kNever; }
  bool failed() const { return left_ < 0; }

 private:
  static constexpr int kNever = 1 << 30;

  // What SQLite sees; the real file follows it in memory.
  struct File {
    sqlite3_file base;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  static sqlite3_file* Real(sqlite3_file* file) { return reinterpret_cast<File*>(file)->real(); }
  static bool Fails() {
    const int left = instance_->left_--;
    return instance_->once_ ? left == 0 : left <= 0;
  }

  static int Open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
    static const sqlite3_io_methods kMethods = Methods();
    const int result = instance_->real_->xOpen(instance_->real_, name, Real(file), flags, out);
    file->pMethods = result == SQLITE_OK ? &kMethods : nullptr;
    return result;
  }

  static sqlite3_io_methods Methods() {
    sqlite3_io_methods methods = {};
    methods.iVersion = 1;  // Without shared memory, which an exclusive connection does not use.
    methods.xClose = [](sqlite3_file* f) { return Real(f)->pMethods->xClose(Real(f)); };
    methods.xRead = [](sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
      return Real(f)->pMethods->xRead(Real(f), to, size, at);
    };
    methods.xWrite = [](sqlite3_file* f, const void* from, int size, sqlite3_int64 at) {
      if (instance_->full_ && instance_->full_()) return SQLITE_FULL;
      return Fails() ? SQLITE_IOERR_WRITE : Real(f)->pMethods->xWrite(Real(f), from, size, at);
    };
    // The process does not lose its power, so a sync that succeeds need not take its time.
    methods.xSync = [](sqlite3_file*, int) { return Fails() ? SQLITE_IOERR_FSYNC : SQLITE_OK; };
    methods.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
      return Real(f)->pMethods->xTruncate(Real(f), size);
    };
    methods.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
      return Real(f)->pMethods->xFileSize(Real(f), size);
    };
    methods.xLock = [](sqlite3_file* f, int lock) {
      return Real(f)->pMethods->xLock(Real(f), lock);
    };
    methods.xUnlock = [](sqlite3_file* f, int lock) {
      return Real(f)->pMethods->xUnlock(Real(f), lock);
    };
    methods.xCheckReservedLock = [](sqlite3_file* f, int* held) {
      return Real(f)->pMethods->xCheckReservedLock(Real(f), held);
    };
    methods.xFileControl = [](sqlite3_file* f, int op, void* argument) {
      return Real(f)->pMethods->xFileControl(Real(f), op, argument);
    };
    methods.xSectorSize = [](sqlite3_file* f) { return Real(f)->pMethods->xSectorSize(Real(f)); };
    methods.xDeviceCharacteristics = [](sqlite3_file* f) {
      return Real(f)->pMethods->xDeviceCharacteristics(Real(f));
    };
    return methods;
  }

  inline static FailingDisk* instance_ = nullptr;
  sqlite3_vfs* const real_;
  sqlite3_vfs vfs_;
  std::function<bool()> full_;
  std::atomic<bool> once_ = false;
  std::atomic<int> left_ = kNever;
};

}  // namespace contact
