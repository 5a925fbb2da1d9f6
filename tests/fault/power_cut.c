// A disk that can be cut off, fill up and fail, for one process: preload it (LD_PRELOAD).
//
// It passes on what the process does to the files below POWER_CUT_DIR and notes it in the file
// POWER_CUT_LOG, in order and with content. The notes survive the process; power_cut.py makes
// of them any state in which a power cut may have left the disk: what was synced, and as much of
// the rest as it likes.
//
// POWER_CUT_FAIL_WRITE=n  the n-th write or truncation fails, once, with EIO
// POWER_CUT_FAIL_SYNC=n   the same of syncs; what it was to sync may or may not be on the disk
// POWER_CUT_FULL=file     while this file exists, no other can grow: ENOSPC

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum { kMaxDescriptors = 4096 };

// What is noted of one operation; `path` and, for a write or the target of a rename, data follow.
struct Note {
  char op;  // Create, Write, Truncate, Sync, Rename, Unlink
  char unused[3];
  uint32_t path_length;
  uint64_t offset;  // Of a write; the size, for a truncation.
  uint64_t data_length;
};

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static char* paths[kMaxDescriptors];  // Of the open files below POWER_CUT_DIR.
static const char* directory;
static const char* full;
static int log_fd = -1;
static long writes_left = -1;  // Before one fails; negative: none will.
static long syncs_left = -1;

static int (*real_open)(const char*, int, ...);
static int (*real_close)(int);
static int (*real_rename)(const char*, const char*);
static int (*real_unlink)(const char*);
static int (*real_fsync)(int);
static int (*real_fdatasync)(int);
static int (*real_ftruncate)(int, off_t);
static ssize_t (*real_write)(int, const void*, size_t);
static ssize_t (*real_pwrite)(int, const void*, size_t, off_t);

// dlsym gives an object pointer, which C does not turn into a function's.
static void Find(void* function, const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  memcpy(function, &found, sizeof found);
}

// Other libraries open files before a constructor here could run: every call comes through this.
static void Initialise(void) {
  if (real_open) return;
  Find(&real_close, "close");
  Find(&real_rename, "rename");
  Find(&real_unlink, "unlink");
  Find(&real_fsync, "fsync");
  Find(&real_fdatasync, "fdatasync");
  Find(&real_ftruncate, "ftruncate64");
  Find(&real_write, "write");
  Find(&real_pwrite, "pwrite64");
  Find(&real_open, "open64");
  directory = getenv("POWER_CUT_DIR");
  full = getenv("POWER_CUT_FULL");
  if (getenv("POWER_CUT_FAIL_WRITE")) writes_left = atol(getenv("POWER_CUT_FAIL_WRITE"));
  if (getenv("POWER_CUT_FAIL_SYNC")) syncs_left = atol(getenv("POWER_CUT_FAIL_SYNC"));
  const char* log = getenv("POWER_CUT_LOG");
  if (log) log_fd = real_open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (log && log_fd < 0) abort();
}

static int Watched(const char* path) {
  Initialise();
  return directory && path && strncmp(path, directory, strlen(directory)) == 0;
}

static const char* PathOf(int fd) {
  Initialise();
  return fd >= 0 && fd < kMaxDescriptors ? paths[fd] : NULL;
}

static void Remember(char op, const char* path, uint64_t offset, const void* data, size_t length) {
  if (log_fd < 0) return;
  struct Note note = {
      .op = op, .path_length = (uint32_t)strlen(path), .offset = offset, .data_length = length};
  struct iovec parts[] = {{&note, sizeof note}, {(void*)path, strlen(path)}, {(void*)data, length}};
  const ssize_t size = (ssize_t)(sizeof note + strlen(path) + length);
  if (writev(log_fd, parts, 3) != size) abort();  // Without notes the test means nothing.
}

// Whether this one fails, of which so many were left.
static int Fails(long* left) {
  if (*left < 0 || --*left != 0) return 0;
  *left = -1;
  errno = EIO;
  return 1;
}

static int IsFull(int fd, off_t end) {
  struct stat file;
  if (!full || access(full, F_OK) != 0) return 0;
  if (fstat(fd, &file) != 0 || end <= file.st_size) return 0;
  errno = ENOSPC;
  return 1;
}

static int Open(const char* path, int flags, mode_t mode) {
  if (!Watched(path)) return real_open(path, flags, mode);
  pthread_mutex_lock(&mutex);
  const int exists = access(path, F_OK) == 0;
  const int fd = real_open(path, flags, mode);
  if (fd >= kMaxDescriptors) abort();
  if (fd >= 0) {
    free(paths[fd]);
    paths[fd] = strdup(path);
    if (!exists) Remember('C', path, 0, NULL, 0);
    if (exists && (flags & O_TRUNC)) Remember('T', path, 0, NULL, 0);
  }
  pthread_mutex_unlock(&mutex);
  return fd;
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return Open(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return Open(path, flags, mode);
}

// What open is in a program that is compiled with _FORTIFY_SOURCE, where the flags are no constant.
int __open_2(const char* path, int flags) { return Open(path, flags, 0); }
int __open64_2(const char* path, int flags) { return Open(path, flags, 0); }

int close(int fd) {
  if (PathOf(fd)) {
    pthread_mutex_lock(&mutex);
    free(paths[fd]);
    paths[fd] = NULL;
    pthread_mutex_unlock(&mutex);
  }
  return real_close(fd);
}

// Writes at `offset`, or where the file stands if that is negative.
static ssize_t Write(int fd, const void* data, size_t size, off_t offset) {
  pthread_mutex_lock(&mutex);
  const off_t at = offset < 0 ? lseek(fd, 0, SEEK_CUR) : offset;
  ssize_t written = -1;
  if (!Fails(&writes_left) && !IsFull(fd, at + (off_t)size)) {
    written = offset < 0 ? real_write(fd, data, size) : real_pwrite(fd, data, size, offset);
  }
  if (written > 0) Remember('W', paths[fd], (uint64_t)at, data, (size_t)written);
  pthread_mutex_unlock(&mutex);
  return written;
}

ssize_t write(int fd, const void* data, size_t size) {
  return PathOf(fd) ? Write(fd, data, size, -1) : real_write(fd, data, size);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  return PathOf(fd) ? Write(fd, data, size, offset) : real_pwrite(fd, data, size, offset);
}

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t offset) {
  return pwrite(fd, data, size, offset);
}

int ftruncate(int fd, off_t size) {
  if (!PathOf(fd)) return real_ftruncate(fd, size);
  pthread_mutex_lock(&mutex);
  const int result = Fails(&writes_left) || IsFull(fd, size) ? -1 : real_ftruncate(fd, size);
  if (result == 0) Remember('T', paths[fd], (uint64_t)size, NULL, 0);
  pthread_mutex_unlock(&mutex);
  return result;
}

int ftruncate64(int fd, off64_t size) { return ftruncate(fd, size); }

static int Sync(int fd, int (*real)(int)) {
  if (!PathOf(fd)) return real(fd);
  pthread_mutex_lock(&mutex);
  const int result = Fails(&syncs_left) ? -1 : real(fd);
  if (result == 0) Remember('S', paths[fd], 0, NULL, 0);
  pthread_mutex_unlock(&mutex);
  return result;
}

int fsync(int fd) { return Sync(fd, real_fsync); }
int fdatasync(int fd) { return Sync(fd, real_fdatasync); }

int rename(const char* from, const char* to) {
  if (!Watched(from)) return real_rename(from, to);
  pthread_mutex_lock(&mutex);
  const int result = real_rename(from, to);
  if (result == 0) Remember('R', from, 0, to, strlen(to));
  pthread_mutex_unlock(&mutex);
  return result;
}

int unlink(const char* path) {
  if (!Watched(path)) return real_unlink(path);
  pthread_mutex_lock(&mutex);
  const int result = real_unlink(path);
  if (result == 0) Remember('U', path, 0, NULL, 0);
  pthread_mutex_unlock(&mutex);
  return result;
}
