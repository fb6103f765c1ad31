/* The C interface of every simulator, compiled or interpreted, linked or loaded with dlopen:
 * version 3. docs/c-interface.md shows complete clients, and the promises of a version.
 *
 * Solvers, renderers, the command line and Python use nothing else. A simulator describes itself
 * (rddl_problem) and steps batches of environments (rddl_batch). All functions work on arrays
 * that the caller owns. They do not throw or abort; those that can fail return RDDL_OK or an error,
 * and last_error returns the reason. A call that fails has changed nothing.
 *
 * Records. A state, an action and an observation are each one fixed-size record per environment:
 * a plain C struct of the fluents in declaration order, every fluent a row-major array over its
 * parameters' objects. Elements are uint8_t (bool), int64_t (int, and objects as their index) or
 * double (real). rddl_fluent has the offset. An array of n records is n * record_size bytes.
 * A byte other than 0 is read as true; 1 is written for it. States and actions with an object that
 * does not exist are refused with RDDL_BAD_ARGUMENT. Reals of actions must be finite, and so must
 * those of state-fluents that no step from an initial state makes inf or nan; otherwise results are
 * undefined, and this is not checked. There may be padding between fluents, which need not be
 * written: a buffer keeps its old bytes there. To compare or hash whole records, clear the buffer
 * once before it is first filled.
 *
 * Sizes. Structs grow at their ends only, and each holds its size. The caller sets struct_size of
 * every struct that it passes, also of those that a call fills, to the sizeof; 0 means as long as
 * in version 3.0, so that a struct of zeros is right, and a smaller size is an error of the
 * caller's. If rddl_batch_options or rddl_transition is longer than the simulator knows, the
 * unknown part must be zero, or the call fails with RDDL_UNSUPPORTED; a longer struct that a call
 * fills keeps its end as it is. Structs in arrays also grow: element k of an array lies k *
 * ..._size bytes behind its beginning (rddl_fluent_at and its like). A program that is compiled
 * with the simulator's own header may write array[k].
 *
 * Alignment. Arrays of numbers are aligned for their elements; records may lie anywhere, and those
 * that are aligned to 8 bytes are read quickest.
 *
 * Threads. A batch is used by one thread at a time, and steps its environments with threads of its
 * own (thread_count). Different batches, and all functions that take a simulator, may be used at
 * once.
 *
 * Lifetimes. Everything that a simulator points to, also its texts, stays as it is for as long as
 * its library is loaded. A batch needs its simulator. The text of last_error stays until the next
 * call that fails in the same thread.
 *
 * Over 400 lines: the whole interface is one file, which clients read from top to bottom. */
#ifndef RDDL_SIMULATOR_H
#define RDDL_SIMULATOR_H

#include <rddl/export.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RDDL_ABI_VERSION 3

/* ------------------------------------------------------------------------- description */

typedef enum { RDDL_BOOL = 0, RDDL_INT = 1, RDDL_REAL = 2 } rddl_scalar;

typedef enum {
    RDDL_NON_FLUENT = 0,
    RDDL_STATE = 1,
    RDDL_ACTION = 2,
    RDDL_INTERM = 3,
    RDDL_DERIVED = 4,
    RDDL_OBSERVATION = 5
} rddl_role;

/* A place in the RDDL source; line and column are 1-based. */
typedef struct {
    const char* file;
    int32_t line;
    int32_t column;
} rddl_source;

typedef struct {
    const char* name;
    const char* const* objects; /* names without '@'; an object's value is its index */
    int64_t object_count;
    int32_t enumerated; /* 1: members given by the domain, 0: by the instance */
} rddl_type;

typedef struct {
    const char* name;
    rddl_role role;
    rddl_scalar scalar;
    int32_t range_type;             /* index into types for object values; -1 for bool, int, real */
    int32_t rank;                   /* number of parameters */
    const int32_t* parameter_types; /* `rank` indices into types */
    int64_t count;                  /* number of groundings: product of the types' sizes */
    int64_t offset;      /* bytes into its record; -1 for non-fluents, and for interm- and
                            derived-fluents of a simulator without details */
    const double* lower; /* `count` bounds from the constraints (-inf: none), or NULL: */
    const double* upper; /* not numeric, or not a state- or action-fluent */
    rddl_source source;
} rddl_fluent;

/* A constraint, by its text as written, on one line and without comments. */
typedef struct {
    const char* text;
    rddl_source source;
} rddl_condition;

typedef struct {
    uint32_t struct_size;
    uint32_t type_size;      /* of an element of types, */
    uint32_t fluent_size;    /* of fluents, */
    uint32_t condition_size; /* and of preconditions, invariants and terminations */
    const char* domain;
    const char* instance;
    const rddl_type* types;
    int32_t type_count;
    const rddl_fluent* fluents; /* in declaration order */
    int32_t fluent_count;
    int64_t state_size; /* bytes of one record */
    int64_t action_size;
    int64_t observation_size; /* equals state_size when not partially observed */
    int64_t interm_size;      /* of get_interm; 0 without details (rddlc --details) */
    int32_t partially_observed;
    int32_t stochastic;         /* 1: something is drawn at random, in a step or at reset */
    const void* default_action; /* one action record */
    int64_t horizon;            /* steps; 0: no horizon (pos-inf) */
    double discount;
    int64_t max_nondef_actions; /* how many action values may differ from the default; -1: all */
    const rddl_condition* preconditions;
    int32_t precondition_count;
    const rddl_condition* invariants;
    int32_t invariant_count;
    const rddl_condition* terminations;
    int32_t termination_count;
    /* The fingerprint of everything that a trajectory depends on: CPFs, reward, conditions,
     * non-fluents, objects, initial state, horizon, discount. The same for each simulator of a
     * problem, whatever it was compiled with. The first simulators of version 3 lack it:
     * struct_size shows that. */
    uint64_t fingerprint;
} rddl_problem;

/* Elements of the arrays above, whatever their size. */
static inline const rddl_type* rddl_type_at(const rddl_problem* problem, int32_t index) {
    return (const rddl_type*)((const char*)problem->types + (size_t)index * problem->type_size);
}
static inline const rddl_fluent* rddl_fluent_at(const rddl_problem* problem, int32_t index) {
    return (const rddl_fluent*)((const char*)problem->fluents +
                                (size_t)index * problem->fluent_size);
}
static inline const rddl_condition* rddl_condition_at(const rddl_problem* problem,
                                                      const rddl_condition* conditions,
                                                      int32_t index) {
    return (const rddl_condition*)((const char*)conditions +
                                   (size_t)index * problem->condition_size);
}

/* The policy block: how to choose the action (docs/policies.md). */
typedef struct {
    uint32_t struct_size;
    const char* name;
    rddl_source source;
    int64_t memory_size; /* bytes that it remembers of each environment's episode */
    int32_t stochastic;  /* 1: it draws at random */
} rddl_policy;

/* ------------------------------------------------------------------------------ batches */

typedef enum {
    RDDL_OK = 0,
    RDDL_BAD_ARGUMENT = 1,
    RDDL_OUT_OF_MEMORY = 2,
    RDDL_UNSUPPORTED = 3 /* the simulator was made without it */
} rddl_error;

/* What happens to an environment whose episode has ended. */
typedef enum {
    RDDL_AUTORESET_DISABLED = 0,  /* it stays as it is; stepping it again changes nothing */
    RDDL_AUTORESET_NEXT_STEP = 1, /* the next step ignores its action and resets it (reward 0) */
    RDDL_AUTORESET_SAME_STEP = 2  /* the same step resets it; final_observations has its end */
} rddl_autoreset;

#define RDDL_NO_HORIZON (-1)

/* All zero: one environment as the instance describes it. */
typedef struct {
    uint32_t struct_size;
    int32_t thread_count;      /* 0: one per core, but not more than environments */
    int64_t environment_count; /* 0: 1 */
    int64_t first_environment; /* identity of environment 0, at least 0: its random numbers depend on
                                  the seed and the identity, never on batch size, place, threads or
                                  ranks */
    uint64_t seed;
    rddl_autoreset autoreset;
    int32_t lane_count;  /* environments stepped together in vector registers: 0: chosen for the
                            batch; else 1 or the simulator's lane_count. Trajectories do not depend
                            on it. */
    int64_t horizon;     /* steps; 0: the instance's; RDDL_NO_HORIZON: no horizon */
    int32_t keeps_steps; /* 1: the batch remembers the last step of each environment (get_interm) */
} rddl_batch_options;

/* The causes of an episode's end; several may hold. */
enum {
    RDDL_RUNNING = 0,
    RDDL_TERMINATED = 1,          /* a termination condition holds in the new state */
    RDDL_TRUNCATED_HORIZON = 2,   /* the horizon is reached */
    RDDL_TRUNCATED_INVARIANT = 4, /* a state invariant is violated */
    RDDL_FAULTED = 8              /* a run-time fault (rddl_fault); counts as truncated */
};

/* Arrays of environment_count entries that a step fills; any may be NULL. */
typedef struct {
    uint32_t struct_size;
    void* observations; /* records */
    double* rewards;
    uint8_t* terminated; /* 0 or 1 */
    uint8_t* truncated;  /* 0 or 1 */
    uint8_t* causes;     /* bits above */
    /* The end of the episode, only for environments that the step has reset
     * (RDDL_AUTORESET_SAME_STEP). */
    void* final_observations; /* records */
    void* final_states;       /* records */
    /* The same as a matrix, only filled by step_values. */
    void* final_observation_values;
} rddl_transition;

/* The first fault of an environment's current (or just ended) episode. */
typedef struct {
    uint32_t struct_size;
    int32_t faulty; /* 0: no fault; the rest is unset then */
    int64_t step;   /* steps made in the episode before it */
    rddl_source source;
    char message[512]; /* names the cause, the ground objects and the value */
} rddl_fault;

/* The precondition that an action violates. */
typedef struct {
    uint32_t struct_size;
    int32_t precondition; /* the first one; -1: no violation, and the rest is unset then */
    rddl_source source;
    char message[512]; /* names the condition and, with details, the first objects that violate
                          it: those of the foralls that it begins with, unless they are too many */
} rddl_violation;

/* The change of a choice (action_choice). */
typedef struct {
    uint32_t struct_size;
    int32_t fluent; /* index into fluents; -1: choice 0, which changes nothing */
    int64_t grounding;
    int64_t value; /* 0 or 1; the index of an object; an int */
} rddl_choice;

/* A column of a matrix of numbers. */
typedef struct {
    uint32_t struct_size;
    int32_t fluent; /* index into fluents; grounding_name has its name */
    int64_t grounding;
    rddl_scalar scalar;   /* type of its numbers; objects are RDDL_INT, and */
    int32_t object_count; /* number of objects of its type; else 0 */
    double lower;         /* bools 0 and 1; objects 0 and object_count - 1; numbers their bounds */
    double upper;         /* from the constraints, or -inf and +inf */
} rddl_column;

/* Ints with more values than this between their bounds have no choices (action_choice_count). */
#define RDDL_MOST_INT_CHOICES 1024

/* Elements of matrices. */
typedef enum { RDDL_FLOAT = 0, RDDL_DOUBLE = 1 } rddl_number;

typedef struct rddl_batch rddl_batch;
typedef struct rddl_simulator rddl_simulator;

struct rddl_simulator {
    uint32_t abi_version; /* RDDL_ABI_VERSION */
    uint32_t struct_size; /* sizeof(rddl_simulator) of its maker */
    const rddl_problem* problem;
    const void* self; /* the maker's own; pass the simulator itself to the functions below */

    /* ---- batches */

    /* All environments start an episode. NULL options are all zero. NULL when out of memory or on
     * bad options. */
    rddl_batch* (*create)(const rddl_simulator*, const rddl_batch_options*);
    void (*destroy)(rddl_batch*);
    /* The reason of the last failed call in this thread, in a sentence; "" before. */
    const char* (*last_error)(const rddl_simulator*);

    /* Starts a new episode where mask is non-zero (NULL: everywhere); observations (records, may
     * be NULL) are written for all environments. In a partially observed problem nothing is
     * observed before the first step: its records are zero then. An environment whose initial
     * state terminates has its episode over at once. */
    rddl_error (*reset)(rddl_batch*, const uint8_t* mask, void* observations);
    /* One action record for each environment; `actions` may be NULL only where these are empty.
     * `out` may not be NULL: a struct of zeros asks for no output. */
    rddl_error (*step)(rddl_batch*, const void* actions, const rddl_transition* out);

    /* ---- states, also for planning */

    /* Records of environments [begin, begin + count). */
    rddl_error (*get_state)(const rddl_batch*, int64_t begin, int64_t count, void* states);
    rddl_error (*get_observation)(const rddl_batch*, int64_t begin, int64_t count, void* records);
    /* The episodes continue from these states, after so many steps (NULL: as many as before), which
     * are not negative. An ended episode runs again, unless the new state terminates or these steps
     * reach the horizon; without steps it makes one more even there. The observation, the policy's
     * memory and the last step (get_interm) stay as they are. */
    rddl_error (*set_state)(rddl_batch*, int64_t begin, int64_t count, const void* states,
                            const int64_t* steps);

    /* Steps made in the current episode, and episodes ended before it (since the batch was created,
     * or since seeds were set, when a running one is not counted); either may be NULL. */
    rddl_error (*get_progress)(const rddl_batch*, int64_t begin, int64_t count, int64_t* steps,
                               int64_t* episodes);
    /* The causes of the current episode's end (RDDL_RUNNING while it runs). */
    rddl_error (*get_causes)(const rddl_batch*, int64_t begin, int64_t count, uint8_t* causes);
    rddl_error (*get_fault)(const rddl_batch*, int64_t environment, rddl_fault* fault);

    /* An independent copy, episodes and random numbers included: the future is the same in both
     * as long as the actions are. NULL when out of memory. */
    rddl_batch* (*copy)(const rddl_batch*);
    /* Makes environments [begin, begin + count) such copies of environments sources[0 .. count) of
     * `from` (NULL: of the first ones), one after the other. `from` is a batch of the same
     * simulator, and may be the same batch. Horizon and autoreset stay those of `to`; the next step
     * checks them. The last step is also copied if both batches keep steps. */
    rddl_error (*copy_environments)(rddl_batch* to, int64_t begin, int64_t count,
                                    const rddl_batch* from, const int64_t* sources);

    /* New random numbers, for the running episodes from their next step on, and for those that
     * follow. Environment k of [begin, begin + count) draws those of the only environment of a new
     * batch whose options have the seed seeds[k]: after set_seeds and reset, its episodes are the
     * same. */
    rddl_error (*set_seeds)(rddl_batch*, int64_t begin, int64_t count, const uint64_t* seeds);
    /* The same for all environments at once: they draw those of a new batch with this seed. */
    rddl_error (*set_seed)(rddl_batch*, uint64_t seed);

    /* ---- actions */

    /* The first violated precondition of each environment's action in its current state, or
     * -1. Steps never check preconditions by themselves. */
    rddl_error (*violated_preconditions)(rddl_batch*, const void* actions, int32_t* first_violated);

    /* The same for one environment and action, in words. */
    rddl_error (*explain_violation)(rddl_batch*, int64_t environment, const void* action,
                                    rddl_violation* out);

    /* Choices, for solvers that change one action value at a time. Choice 0 is the default action
     * (no-op). Then come, action-fluent by action-fluent in declaration order and grounding by
     * grounding in row-major order, the default action with one value changed: a bool to its other
     * value; an object, or an int with two bounds, to each of its values except the default, in
     * ascending order. Reals, ints without two bounds and ints of more than RDDL_MOST_INT_CHOICES
     * values are not part of it and stay at their default. */
    int64_t (*action_choice_count)(const rddl_simulator*); /* at least 1 */
    /* Writes the action record of a choice and its change; either may be NULL. */
    rddl_error (*action_choice)(const rddl_simulator*, int64_t choice, void* action,
                                rddl_choice* out);
    /* Writes action_choice_count bytes for each environment. Without actions (NULL): 1 if the
     * choice satisfies all preconditions in the current state, else 0; also 0 for all but choice 0
     * if max_nondef_actions is 0. With actions, one record for each environment, for solvers that
     * change several values one after the other: 1 if the action satisfies all preconditions and
     * max_nondef_actions as it stands (choice 0), or with the choice's value set in it; also 0 if
     * it has that value already. Choices never lead back to the default. */
    rddl_error (*action_mask)(rddl_batch*, const void* actions, uint8_t* masks);

    /* The policy block; NULL, as policy_act is, if the problem has no such block. */
    const rddl_policy* policy;
    /* Writes for each environment the action record that the policy chooses upon its state or, if
     * partially observed, upon its last observation; the default action if the episode is over.
     * The policy's memory belongs to the batch: an episode starts with the defaults, and each call
     * updates it, so call this once before each step. A fault of the policy ends the episode
     * at once, and so does an action that violates max_nondef_actions. The policy's random numbers
     * are its own: those of the steps do not depend on it. */
    rddl_error (*policy_act)(rddl_batch*, void* actions);

    /* ---- matrices of numbers, for solvers */

    /* The number of environments that a batch steps together in vector registers, and the names of
     * these ("AVX-512", "AVX2", "SSE2", "portable"). 1: the simulator was made without packs. */
    int32_t lane_count;
    const char* instruction_set;

    /* A row for each environment, row-major, a number for each value of the record. Bools are 0 and
     * 1 (an action above 0.5 is true), objects their index, ints are rounded. Counts of numbers in
     * a row: */
    int64_t (*action_value_count)(const rddl_simulator*);
    int64_t (*observation_value_count)(const rddl_simulator*);
    /* The meaning of a number of the row. */
    rddl_error (*action_column)(const rddl_simulator*, int64_t column, rddl_column* out);
    rddl_error (*observation_column)(const rddl_simulator*, int64_t column, rddl_column* out);
    /* `observations` may be NULL. out->observations and the final records are written as usual, and
     * so is the matrix out->final_observation_values. An action that is nan, an index without an
     * object, or a number beyond the ints for an int, is refused. */
    rddl_error (*step_values)(rddl_batch*, rddl_number, const void* actions, void* observations,
                              const rddl_transition* out);
    rddl_error (*get_observation_values)(const rddl_batch*, rddl_number, void* observations);

    /* ---- intermediate values of a step */

    /* Records of the interm- and derived-fluents of the last step of environments [begin, begin +
     * count), whether or not a new episode has begun since. They are computed again, in double:
     * only for batches that keep steps, and by simulators with details; else RDDL_UNSUPPORTED. An
     * environment that has made no step is refused. A step that faulted counts; its values
     * that depend on the draw or operator at fault mean nothing. Neither reset nor set_state is a
     * step. */
    rddl_error (*get_interm)(const rddl_batch*, int64_t begin, int64_t count, void* records);

    /* ---- constants of the instance */

    /* The values [begin, begin + count) of a fluent, row-major, as uint8_t, int64_t or double: of a
     * non-fluent; of a state-fluent in the initial state; of an action-fluent its defaults. */
    rddl_error (*get_constants)(const rddl_simulator*, int32_t fluent, int64_t begin, int64_t count,
                                void* values);
    /* The state in which episodes start; if the start is random, as it is before the draws. */
    rddl_error (*initial_state)(const rddl_simulator*, void* state);
    /* Writes the name of a grounding as traces have it, "rlevel___t1", and its end, as far as they
     * fit into `size` bytes. Returns its length without the end, however long; -1 if it does not
     * exist. */
    int64_t (*grounding_name)(const rddl_simulator*, int32_t fluent, int64_t grounding, char* text,
                              size_t size);

    /* ---- snapshots, which the first simulators of version 3 lack: struct_size shows that */

    /* Bytes of the snapshot of an environment. */
    int64_t (*snapshot_size)(const rddl_simulator*);
    /* Writes environments [begin, begin + count) with their episodes and random numbers, a snapshot
     * for each. */
    rddl_error (*get_snapshots)(const rddl_batch*, int64_t begin, int64_t count, void* snapshots);
    /* Makes environments [begin, begin + count) copies of those of the snapshots, as
     * copy_environments does. They may come from a batch of any simulator of the problem (with the
     * same fingerprint) on the same kind of machine, made by the same version of rddlc, in whatever
     * engine; others are refused, except that bytes which are no snapshots at all are not
     * recognised for sure. */
    rddl_error (*set_snapshots)(rddl_batch*, int64_t begin, int64_t count, const void* snapshots);

    /* ---- the problem without luck, for planners; also lacking in the first of version 3 */

    /* From their next step on, and until set_seeds or set_seed, environments [begin, begin + count)
     * draw no random numbers: each uniform number is 1/2. So each draw that one number decides is
     * the median of its distribution: a Bernoulli draw is its likelier value (false where both are
     * alike), a normal one its mean, up to rounding. */
    rddl_error (*draw_medians)(rddl_batch*, int64_t begin, int64_t count);
};

/* What a shared object exports under the name "rddl_simulator_entry". */
typedef const rddl_simulator* (*rddl_simulator_entry_function)(void);

#ifdef __cplusplus
}
#endif

#endif
