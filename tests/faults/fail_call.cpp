// Preloaded into a process, makes one of its system calls or allocations fail: as SQLite's tests
// do.
//
//   VANTAGE_FAIL=CALL:N[:on]  the N-th call fails, and with "on" all that follow. CALL is malloc,
//                             open, write, rename, fsync or pthread_create. N of 0: none does.
//   VANTAGE_FAIL_FROM=NAME    calls count from when a file whose path ends so is opened: what the
//                             loader and others' constructors do before is not vantage's.
//   VANTAGE_FAIL_COUNT=FILE   gets the number of calls counted, at the end.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <atomic>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

std::atomic<bool> counting{false};
std::atomic<long> calls{0};

struct Plan {
  char call[32] = "";
  long number = 0;
  bool goes_on = false;
  const char* from = "";
};

Plan read_plan() {
  Plan plan;
  const char* text = getenv("VANTAGE_FAIL");
  const char* from = getenv("VANTAGE_FAIL_FROM");
  if (from != nullptr) plan.from = from;
  if (text == nullptr) return plan;
  const char* colon = strchr(text, ':');
  if (colon == nullptr || size_t(colon - text) >= sizeof plan.call) return plan;
  memcpy(plan.call, text, size_t(colon - text));
  plan.number = atol(colon + 1);
  plan.goes_on = strstr(colon, ":on") != nullptr;
  return plan;
}

Plan plan;  // before its constructor all zero: nothing fails

__attribute__((constructor)) void begin() {
  plan = read_plan();
}

bool fails(const char* call) {
  if (!counting.load(std::memory_order_relaxed) || strcmp(plan.call, call) != 0) return false;
  const long number = ++calls;
  return plan.number > 0 && (number == plan.number || (plan.goes_on && number > plan.number));
}

void look_at(const char* path) {
  const size_t length = strlen(path), end = strlen(plan.from);
  if (end > 0 && length >= end && strcmp(path + length - end, plan.from) == 0) counting = true;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

__attribute__((destructor)) void write_count() {
  const char* path = getenv("VANTAGE_FAIL_COUNT");
  if (path == nullptr) return;
  counting = false;
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld\n", calls.load());
  const int file =
      next<int(const char*, int, ...)>("open")(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  (void)!next<ssize_t(int, const void*, size_t)>("write")(file, text, size_t(length));
  close(file);
}

int open_with(const char* name, const char* path, int flags, mode_t mode) {
  look_at(path);
  if (fails("open")) {
    errno = ENFILE;
    return -1;
  }
  return next<int(const char*, int, ...)>(name)(path, flags, mode);
}

FILE* fopen_with(const char* name, const char* path, const char* mode) {
  look_at(path);
  if (fails("open")) {
    errno = ENFILE;
    return nullptr;
  }
  return next<FILE*(const char*, const char*)>(name)(path, mode);
}

}  // namespace

extern "C" {

/// `new (std::nothrow)`, mangled. valijson takes memory so and does not look whether it got any:
/// these never fail here, as nothing of ours could be done about it.
void* _ZnwmRKSt9nothrow_t(size_t size, const void*) {
  return __libc_malloc(size > 0 ? size : 1);
}

void* malloc(size_t size) {
  if (!fails("malloc")) return __libc_malloc(size);
  errno = ENOMEM;
  return nullptr;
}
void* calloc(size_t count, size_t size) {
  if (!fails("malloc")) return __libc_calloc(count, size);
  errno = ENOMEM;
  return nullptr;
}
void* realloc(void* before, size_t size) {
  if (size == 0 || !fails("malloc")) return __libc_realloc(before, size);
  errno = ENOMEM;
  return nullptr;
}
void* memalign(size_t alignment, size_t size) {
  if (!fails("malloc")) return __libc_memalign(alignment, size);
  errno = ENOMEM;
  return nullptr;
}
void* aligned_alloc(size_t alignment, size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  void* const found = memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *memory = found;
  return 0;
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_with("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_with("open64", path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
  return fopen_with("fopen", path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  return fopen_with("fopen64", path, mode);
}

ssize_t write(int file, const void* bytes, size_t size) {
  // Messages on stderr are not what is tested; that they come out is.
  if (file == STDERR_FILENO || !fails("write")) {
    return next<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
  }
  errno = ENOSPC;
  return -1;
}
int rename(const char* from, const char* to) {
  if (!fails("rename")) return next<int(const char*, const char*)>("rename")(from, to);
  errno = ENOSPC;
  return -1;
}
int fsync(int file) {
  if (!fails("fsync")) return next<int(int)>("fsync")(file);
  errno = EIO;
  return -1;
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) {
  if (fails("pthread_create")) return EAGAIN;
  return next<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(
      thread, attributes, run, argument);
}

}  // extern "C"
