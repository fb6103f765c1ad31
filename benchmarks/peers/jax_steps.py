"""Steps per second of pyRDDLGym-jax: its compiled, vmapped rollouts, after their compilation.

    python jax_steps.py DOMAIN INSTANCE [--seconds S] [--cores N]

Batches grow until a larger one brings no more, or would take too long. The actions are drawn beforehand by pyRDDLGym and are
the same in every environment of a batch, which costs JAX least; reals have its default of 32 bits, and
it checks neither preconditions nor ends of episodes. The last line of the output is JSON, which
`rddl bench --against=jax` reads.
"""

import time

from common import measured_peer, timed_import

NAME = "pyRDDLGym-jax"
BATCHES = (1, *(4**k for k in range(2, 9)))
WORSE_BATCHES = 2  # so many after the best one, and no larger one is tried
LARGEST_BATCH_BYTES = 4 << 30
MOST_SECONDS = 30  # for all batches: a larger one is not tried if it might end later


def measure(options) -> dict:
    module, import_seconds = timed_import("jax_rollouts")
    peer = module.Rollouts(options.domain, options.instance, options.seconds)
    measurements, best, worse = [], 0.0, 0
    end = time.perf_counter() + MOST_SECONDS
    for batch in BATCHES:
        if batch > 1 and batch * peer.bytes_per_environment() * 8 > LARGEST_BATCH_BYTES:
            break
        # It is compiled, run once, and run again to be measured.
        if best and time.perf_counter() + 2 * batch * peer.horizon / best > end:
            break
        measurements.append(peer.measure(batch, options.seconds, options.cores))
        rate = measurements[-1]["steps"] / measurements[-1]["seconds"]
        worse = 0 if rate > best else worse + 1
        best = max(best, rate)
        if worse >= WORSE_BATCHES:
            break
    return {
        "import_seconds": import_seconds,
        "first_step_seconds": peer.first_step_seconds,
        "measurements": measurements,
    }


if __name__ == "__main__":
    measured_peer(NAME, measure)
