/* Of the few functions that a shared object shows, which is compiled with -fvisibility=hidden. */
#ifndef RDDL_EXPORT
#ifdef __GNUC__
#define RDDL_EXPORT __attribute__((visibility("default")))
#else
#define RDDL_EXPORT
#endif
#endif
