/* A disk that fills up, for LD_PRELOAD: of the calls of the program $FULL_DISK_OF that need room,
 * number $FULL_DISK_AT and all later ones fail. A write that fails first writes a half. What the C
 * library writes for streams does not pass here; files are not written by streams. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void* real(const char* name) {
    return dlsym(RTLD_NEXT, name);
}

/* Whether this call comes too late. */
static int is_full(void) {
    static int calls = 0;
    const char* const program = getenv("FULL_DISK_OF");
    const char* const first = getenv("FULL_DISK_AT");
    if (program == NULL || first == NULL || strcmp(program, program_invocation_short_name) != 0)
        return 0;
    if (__atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED) < atoi(first)) return 0;
    errno = ENOSPC;
    return 1;
}

static int is_file(int descriptor) {
    struct stat status;
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
    ssize_t (*const real_write)(int, const void*, size_t) =
        (ssize_t(*)(int, const void*, size_t))real("write");
    if (!is_file(descriptor) || !is_full()) return real_write(descriptor, bytes, count);
    if (count > 1) return real_write(descriptor, bytes, count / 2);
    errno = ENOSPC;
    return -1;
}

static int makes_file(int flags) {
    return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
}

static int open_by(const char* name, const char* path, int flags, mode_t mode) {
    if (makes_file(flags) && is_full()) return -1;
    return ((int (*)(const char*, int, mode_t))real(name))(path, flags, mode);
}

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = makes_file(flags) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_by("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = makes_file(flags) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_by("open64", path, flags, mode);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    if (is_full()) return -1;
    return ((int (*)(int, const char*, int, const char*, int))real("linkat"))(from_folder, from,
                                                                             to_folder, to, flags);
}

int rename(const char* from, const char* to) {
    if (is_full()) return -1;
    return ((int (*)(const char*, const char*))real("rename"))(from, to);
}

int mkdir(const char* path, mode_t mode) {
    if (is_full()) return -1;
    return ((int (*)(const char*, mode_t))real("mkdir"))(path, mode);
}

char* mkdtemp(char* pattern) {
    if (is_full()) return NULL;
    return ((char* (*)(char*))real("mkdtemp"))(pattern);
}
