/* External functions of RDDL, $f[...](...), in a shared object: what `rddl --extern f.so` calls.
 *
 * The function $f is the exported C function rddl_extern_f. <rddl/external.hpp> makes it of a C++
 * function; any other language that has a C interface will do, too. It must be pure: the result
 * depends on the arguments only. It may be called by several threads at once.
 */
#ifndef RDDL_EXTERNAL_H
#define RDDL_EXTERNAL_H

#include <rddl/simulator.h>

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A value (rank 0) or a table of values, row-major: uint8_t (bool, 0 or 1), int64_t or double. */
typedef struct {
    rddl_scalar scalar;
    int32_t rank;
    const int64_t* shape; /* `rank` sizes */
    void* data;
} rddl_array;

/* Writes the result and returns 1; returns 0 if it does not take arrays of these types and shapes.
 * Where the data is NULL it writes nothing and only answers: the interpreter asks once for each
 * call of the program, before it makes any. */
typedef int32_t (*rddl_external_function)(const rddl_array* arguments, int32_t count,
                                          const rddl_array* result);

#ifdef __cplusplus
}
#endif
#endif
