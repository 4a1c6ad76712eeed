/* SPDX-License-Identifier: Apache-2.0 */
/* A library that is preloaded before the program. It makes the N-th call of a kind fail, once or from this call on.
 *
 *   SIXSTEP_FAULT="pwrite 5 28"        the fifth pwrite fails with errno 28
 *   SIXSTEP_FAULT="malloc 300 12 on"   the 300th and every later malloc fails with errno 12
 *   SIXSTEP_FAULT="short 3 0"          the third write writes half of its data
 *
 * Writes to standard streams never fail. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

static char kind[16];
static long at;
static int reason, from_then_on;
static long calls;

__attribute__((constructor)) static void read_order(void) {
  const char* text = getenv("SIXSTEP_FAULT");
  if (text == NULL) return;
  size_t n = 0;
  for (; *text && *text != ' ' && n + 1 < sizeof kind; ++text) kind[n++] = *text;
  char* rest = (char*)text;
  at = strtol(rest, &rest, 10);
  reason = (int)strtol(rest, &rest, 10);
  from_then_on = strstr(rest, "on") != NULL;
}

static int fails(const char* which) {
  if (at == 0 || strcmp(which, kind) != 0) return 0;
  const long call = __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED);
  if (call != at && !(from_then_on && call > at)) return 0;
  errno = reason;
  return 1;
}

#define REAL(name) static __typeof__(name)* real; if (real == NULL) real = (__typeof__(name)*)dlsym(RTLD_NEXT, #name)
#define FAILING(result, name, arguments, names, which, answer) \
  result name arguments {                                       \
    REAL(name);                                                 \
    return fails(which) ? answer : real names;                  \
  }

ssize_t write(int, const void*, size_t);
ssize_t pwrite(int, const void*, size_t, off_t);
ssize_t pwrite64(int, const void*, size_t, off_t);
ssize_t read(int, void*, size_t);
ssize_t pread(int, void*, size_t, off_t);
ssize_t pread64(int, void*, size_t, off_t);
int fsync(int);
int fdatasync(int);
int rename(const char*, const char*);
int ftruncate(int, off_t);
int ftruncate64(int, off_t);
int posix_fallocate(int, off_t, off_t);
int posix_fallocate64(int, off_t, off_t);
int close(int);

FAILING(ssize_t, pwrite, (int d, const void* b, size_t n, off_t o), (d, b, n, o), "pwrite", -1)
FAILING(ssize_t, pwrite64, (int d, const void* b, size_t n, off_t o), (d, b, n, o), "pwrite", -1)
FAILING(ssize_t, pread, (int d, void* b, size_t n, off_t o), (d, b, n, o), "pread", -1)
FAILING(ssize_t, pread64, (int d, void* b, size_t n, off_t o), (d, b, n, o), "pread", -1)
FAILING(ssize_t, read, (int d, void* b, size_t n), (d, b, n), "read", -1)
FAILING(int, fsync, (int d), (d), "fsync", -1)
FAILING(int, fdatasync, (int d), (d), "fsync", -1)
FAILING(int, rename, (const char* a, const char* b), (a, b), "rename", -1)
FAILING(int, ftruncate, (int d, off_t n), (d, n), "truncate", -1)
FAILING(int, ftruncate64, (int d, off_t n), (d, n), "truncate", -1)
FAILING(int, posix_fallocate, (int d, off_t o, off_t n), (d, o, n), "reserve", reason)
FAILING(int, posix_fallocate64, (int d, off_t o, off_t n), (d, o, n), "reserve", reason)
FAILING(int, close, (int d), (d), "close", -1)

ssize_t write(int d, const void* b, size_t n) {
  REAL(write);
  if (d > 2 && fails("write")) return -1;
  return real(d, b, d > 2 && n > 1 && fails("short") ? n / 2 : n);
}

/* Calls __libc_malloc, because dlsym itself allocates memory. */
extern void* __libc_malloc(size_t);
void* malloc(size_t n) { return fails("malloc") ? NULL : __libc_malloc(n); }
