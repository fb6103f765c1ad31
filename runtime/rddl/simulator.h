/* The C interface of every simulator, compiled or interpreted, linked or loaded with dlopen.
 *
 * Solvers, renderers, the command line and Python use nothing else. A simulator describes itself
 * (rddl_problem) and steps batches of environments (rddl_batch). All functions work on arrays
 * that the caller owns. None throws or aborts; those that can fail return RDDL_OK or an error.
 *
 * Records. A state, an action and an observation are each one fixed-size record per environment:
 * a plain C struct of the fluents in declaration order, every fluent a row-major array over its
 * parameters' objects. Elements are uint8_t (bool), int64_t (int, and objects as their index) or
 * double (real). rddl_fluent tells the offset. An array of n records is n * record_size bytes.
 * A byte other than 0 is read as true; 1 is written for it. States and actions with an object that
 * does not exist are refused with RDDL_BAD_ARGUMENT, and nothing has changed then.
 */
#ifndef RDDL_SIMULATOR_H
#define RDDL_SIMULATOR_H

#include <rddl/export.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RDDL_ABI_VERSION 2

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
    int64_t offset;      /* bytes into its record; -1 for non-, interm- and derived-fluents */
    const double* lower; /* `count` bounds from the constraints (-inf: none), or NULL: */
    const double* upper; /* not numeric, or not a state- or action-fluent */
    rddl_source source;
} rddl_fluent;

/* A constraint, by its text as written. */
typedef struct {
    const char* text;
    rddl_source source;
} rddl_condition;

typedef struct {
    const char* domain;
    const char* instance;
    const rddl_type* types;
    int32_t type_count;
    const rddl_fluent* fluents; /* in declaration order */
    int32_t fluent_count;
    int64_t state_size; /* bytes of one record */
    int64_t action_size;
    int64_t observation_size; /* equals state_size when not partially observed */
    int32_t partially_observed;
    int32_t stochastic;         /* 1: something is drawn at random, in a step or at reset */
    const void* default_action; /* one action record */
    int64_t horizon;            /* steps; 0: none (pos-inf) */
    double discount;
    int64_t max_nondef_actions; /* how many action values may differ from the default; -1: all */
    const rddl_condition* preconditions;
    int32_t precondition_count;
    const rddl_condition* invariants;
    int32_t invariant_count;
    const rddl_condition* terminations;
    int32_t termination_count;
} rddl_problem;

/* The policy block: how to choose the action (docs/policies.md). */
typedef struct {
    const char* name;
    rddl_source source;
    int64_t memory_size; /* bytes that it remembers of each environment's episode */
    int32_t stochastic;  /* 1: it draws at random */
} rddl_policy;

/* ------------------------------------------------------------------------------ batches */

typedef enum { RDDL_OK = 0, RDDL_BAD_ARGUMENT = 1, RDDL_OUT_OF_MEMORY = 2 } rddl_error;

/* What happens to an environment whose episode has ended. */
typedef enum {
    RDDL_AUTORESET_DISABLED = 0,  /* it stays as it is; stepping it again changes nothing */
    RDDL_AUTORESET_NEXT_STEP = 1, /* the next step ignores its action and resets it (reward 0) */
    RDDL_AUTORESET_SAME_STEP = 2  /* the same step resets it; final_observations tells its end */
} rddl_autoreset;

typedef struct {
    int64_t environment_count;
    int64_t first_environment; /* identity of environment 0: its random numbers depend on the
                                  identity, never on batch size, place, threads or ranks */
    uint64_t seed;
    int32_t thread_count; /* 0: one per core */
    rddl_autoreset autoreset;
    int64_t horizon; /* -1: the instance's; 0: none; else this many steps */
    int32_t
        lane_count; /* environments stepped together in vector registers: 0: what suits the batch;
                       else 1 or the simulator's lane_count. Trajectories do not depend on it. */
} rddl_batch_options;

/* Why an episode ended; several may hold. */
enum {
    RDDL_RUNNING = 0,
    RDDL_TERMINATED = 1,          /* a termination condition holds in the new state */
    RDDL_TRUNCATED_HORIZON = 2,   /* the horizon is reached */
    RDDL_TRUNCATED_INVARIANT = 4, /* a state invariant is violated */
    RDDL_FAULTED = 8              /* a run-time fault (rddl_fault); counts as truncated */
};

/* Arrays of environment_count entries that a step fills; any may be NULL. */
typedef struct {
    void* observations; /* records */
    double* rewards;
    uint8_t* terminated;      /* 0 or 1 */
    uint8_t* truncated;       /* 0 or 1 */
    uint8_t* causes;          /* bits above */
    void* final_observations; /* records; written only where a same-step reset happened */
} rddl_transition;

/* The first fault of an environment's current (or just ended) episode. */
typedef struct {
    int32_t faulty; /* 0: none; the rest is unset then */
    int32_t step;   /* steps made in the episode before it */
    rddl_source source;
    char message[512]; /* names the cause, the ground objects and the value */
} rddl_fault;

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

    /* All environments start an episode. NULL when out of memory or on bad options. */
    rddl_batch* (*create)(const rddl_simulator*, const rddl_batch_options*);
    void (*destroy)(rddl_batch*);

    /* Starts a new episode where mask is non-zero (NULL: everywhere); observations (records, may
     * be NULL) are written for all environments. In a partially observed problem nothing is
     * observed before the first step: its records are zero then. An environment whose initial
     * state terminates has its episode over at once. */
    rddl_error (*reset)(rddl_batch*, const uint8_t* mask, void* observations);
    rddl_error (*step)(rddl_batch*, const void* actions, const rddl_transition* out);

    /* Records of environments [begin, begin + count). set_state keeps step counter and episode
     * and makes an ended environment run again unless the new state terminates; it refuses object
     * indices out of range. */
    rddl_error (*get_state)(const rddl_batch*, int64_t begin, int64_t count, void* states);
    rddl_error (*set_state)(rddl_batch*, int64_t begin, int64_t count, const void* states);
    rddl_error (*get_observation)(const rddl_batch*, int64_t begin, int64_t count, void* records);

    /* Steps made in the current episode, and episodes ended before it; either may be NULL. */
    rddl_error (*get_progress)(const rddl_batch*, int64_t begin, int64_t count, int64_t* steps,
                               int64_t* episodes);
    /* The causes of the current episode's end (RDDL_RUNNING while it runs). */
    rddl_error (*get_causes)(const rddl_batch*, int64_t begin, int64_t count, uint8_t* causes);
    rddl_error (*get_fault)(const rddl_batch*, int64_t environment, rddl_fault* fault);

    /* For each environment the first violated precondition of its action in its current state, or
     * -1. Steps never check preconditions by themselves. */
    rddl_error (*violated_preconditions)(rddl_batch*, const void* actions, int32_t* first_violated);

    /* An independent copy, episodes and random streams included. NULL when out of memory. */
    rddl_batch* (*copy)(const rddl_batch*);

    /* Choices, for solvers that change one action value at a time. Choice 0 is the default action
     * (no-op). Then come, action-fluent by action-fluent in declaration order and grounding by
     * grounding in row-major order, the default action with one value changed: a bool to its other
     * value; an object, or an int with two bounds, to each of its values but the default, in
     * ascending order. Reals, ints without two bounds and ints of more than RDDL_MOST_INT_CHOICES
     * values are no part of it and stay at their default. */
    int64_t (*action_choice_count)(const rddl_simulator*); /* at least 1 */
    /* Writes the action record of a choice. */
    rddl_error (*action_choice)(const rddl_simulator*, int64_t choice, void* action);
    /* For each environment action_choice_count bytes: 1 where the choice satisfies all
     * preconditions in the current state, else 0; also 0 for all but choice 0 where
     * max_nondef_actions is 0. */
    rddl_error (*action_mask)(rddl_batch*, uint8_t* masks);

    /* The policy block; NULL, as policy_act is, if the problem has none. */
    const rddl_policy* policy;
    /* For each environment writes the action record that the policy chooses upon its state or, if
     * partially observed, upon its last observation; the default action where the episode is over.
     * What the policy remembers belongs to the batch: an episode starts with the defaults, and each
     * call moves it on, so call this once before each step. A fault of the policy ends the episode
     * at once, and so does an action that violates max_nondef_actions. The policy's random numbers
     * are its own: those of the steps do not depend on it. */
    rddl_error (*policy_act)(rddl_batch*, void* actions);

    /* How many environments a batch steps together in vector registers, and which registers these
     * are ("AVX-512", "AVX2", "SSE2", "portable"). 1: the simulator was made without. */
    int32_t lane_count;
    const char* instruction_set;

    /* The same with matrices, for solvers: a row for each environment, row-major, a number for each
     * value of the record. Bools are 0 and 1 (an action above 0.5 is true), objects their index,
     * ints are rounded. Counts of numbers in a row: */
    int64_t (*action_value_count)(const rddl_simulator*);
    int64_t (*observation_value_count)(const rddl_simulator*);
    /* `observations` may be NULL; out->observations and out->final_observations are records as
     * ever. An action that is nan, or an index without an object, is refused. */
    rddl_error (*step_values)(rddl_batch*, rddl_number, const void* actions, void* observations,
                              const rddl_transition* out);
    rddl_error (*get_observation_values)(const rddl_batch*, rddl_number, void* observations);
};

/* What a shared object exports under the name "rddl_simulator_entry". */
typedef const rddl_simulator* (*rddl_simulator_entry_function)(void);

#ifdef __cplusplus
}
#endif

#endif
