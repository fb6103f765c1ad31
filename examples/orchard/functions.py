"""The external functions of domain.rddl for pyRDDLGym:

    pyRDDLGym.make(domain, instance, backend_kwargs={"python_functions": vars(functions)})
"""

import numpy as np


def evaporation(temperature):
    """Water that evaporates in a day, in mm, at a temperature in degrees Celsius."""
    pressure = 0.61094 * np.exp(17.625 * temperature / (temperature + 243.04))
    return 1.2 * pressure


def settle(supplied, capacity, runs_to):
    """The water of each plot once nothing overflows any more: plots in their order pass on what
    they cannot hold, `runs_to[from, to]` of it to each other plot."""
    settled = np.copy(supplied)
    for p in range(len(settled)):
        overflow = max(settled[p] - capacity[p], 0.0)
        settled[p] -= overflow
        settled += runs_to[p] * overflow
    return settled
