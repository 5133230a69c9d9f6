// Makes the nth call of a program that writes a file fail. Loaded with LD_PRELOAD; reads FAULT_KIND (enospc, eio, eintr,
// short) and FAULT_CALL (n, from 1). enospc fails that call and all later writes, the other kinds fail that call alone.
// Writes "reached" to the file FAULT_REACHED when the call comes. Standard streams are left alone. With FAULT_LOCKS every
// lock fails with that error number, as on a disk without locks. With FAULT_CLOCK every second look at the time of day is
// that many seconds off.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static atomic_long num_calls;

static int is_file(int fd) {
    struct stat found;
    return fd > 2 && fstat(fd, &found) == 0 && S_ISREG(found.st_mode);
}

// 1 for the chosen call, 2 for later ones, 0 for earlier ones.
static int turn(void) {
    const char *wanted = getenv("FAULT_CALL");
    if (!wanted) return 0;
    long call = atomic_fetch_add(&num_calls, 1) + 1, chosen = atol(wanted);
    if (call == chosen) {
        const char *reached = getenv("FAULT_REACHED");
        if (reached) close(open(reached, O_CREAT | O_WRONLY, 0666));
    }
    return call < chosen ? 0 : call == chosen ? 1 : 2;
}

static int is_kind(const char *kind) {
    const char *wanted = getenv("FAULT_KIND");
    return wanted && strcmp(wanted, kind) == 0;
}

ssize_t write(int fd, const void *bytes, size_t num) {
    ssize_t (*real)(int, const void *, size_t) = dlsym(RTLD_NEXT, "write");
    if (!is_file(fd)) return real(fd, bytes, num);
    int when = turn();
    if (when == 0 || (when == 2 && !is_kind("enospc"))) return real(fd, bytes, num);
    if (is_kind("short")) return real(fd, bytes, num > 1 ? num / 2 : num);
    errno = is_kind("enospc") ? ENOSPC : is_kind("eintr") ? EINTR : EIO;
    return -1;
}

static int fails(int fd) {
    return is_file(fd) && turn() == 1 && (is_kind("eio") || is_kind("enospc"));
}

int fsync(int fd) {
    int (*real)(int) = dlsym(RTLD_NEXT, "fsync");
    if (fails(fd)) { errno = is_kind("eio") ? EIO : ENOSPC; return -1; }
    return real(fd);
}

int fdatasync(int fd) {
    int (*real)(int) = dlsym(RTLD_NEXT, "fdatasync");
    if (fails(fd)) { errno = is_kind("eio") ? EIO : ENOSPC; return -1; }
    return real(fd);
}

int rename(const char *from, const char *to) {
    int (*real)(const char *, const char *) = dlsym(RTLD_NEXT, "rename");
    if (turn() == 1 && (is_kind("eio") || is_kind("enospc"))) { errno = is_kind("eio") ? EIO : ENOSPC; return -1; }
    return real(from, to);
}

// A file that was written to is closed, and the disk says only then that it lost something.
int close(int fd) {
    int (*real)(int) = dlsym(RTLD_NEXT, "close");
    int flags = fcntl(fd, F_GETFL);
    int is_failing = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && fails(fd);
    int closed = real(fd);
    if (!is_failing) return closed;
    errno = is_kind("eio") ? EIO : ENOSPC;
    return -1;
}

int clock_gettime(clockid_t clock, struct timespec *now) {
    static atomic_long num_looks;
    int (*real)(clockid_t, struct timespec *) = dlsym(RTLD_NEXT, "clock_gettime");
    int looked = real(clock, now);
    const char *jump = getenv("FAULT_CLOCK");
    if (jump && clock == CLOCK_REALTIME && atomic_fetch_add(&num_looks, 1) % 2 == 1) now->tv_sec += atol(jump);
    return looked;
}

int flock(int fd, int operation) {
    int (*real)(int, int) = dlsym(RTLD_NEXT, "flock");
    const char *number = getenv("FAULT_LOCKS");
    if (!number) return real(fd, operation);
    errno = atoi(number);
    return -1;
}
