/* A system that starts no threads, for LD_PRELOAD into the program $NO_THREADS_OF. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

typedef int create_function(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) {
    const char* const program = getenv("NO_THREADS_OF");
    if (program != NULL && strcmp(program, program_invocation_short_name) == 0) return EAGAIN;
    return ((create_function*)dlsym(RTLD_NEXT, "pthread_create"))(thread, attributes, start,
                                                                  argument);
}
