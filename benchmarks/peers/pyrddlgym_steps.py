"""Steps per second of pyRDDLGym: one environment in its quicker, vectorised form.

    python pyrddlgym_steps.py DOMAIN INSTANCE [--seconds S] [--cores N]

The last line of the output is JSON, which `rddl bench --against=pyrddlgym` reads.
"""

from common import measured_peer, timed_import

NAME = "pyRDDLGym"


def measure(options) -> dict:
    module, import_seconds = timed_import("vectorized_environment")
    peer = module.VectorizedEnvironment(options.domain, options.instance, options.seconds)
    return {
        "import_seconds": import_seconds,
        "first_step_seconds": peer.first_step_seconds,
        "measurements": [peer.measure(options.seconds)],
    }


if __name__ == "__main__":
    measured_peer(NAME, measure)
