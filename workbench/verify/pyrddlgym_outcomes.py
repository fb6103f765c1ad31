"""Steps of the real pyRDDLGym from given states under given actions: a part of `rddl verify`.

    python pyrddlgym_outcomes.py DOMAIN INSTANCE QUESTIONS ANSWERS SECONDS

A line of QUESTIONS is {"state": {...}, "action": {...}}, with all values by their grounded names. The
first line of ANSWERS is {"version": ..., "random": [fluents whose value draws take part in], ...}, or
{"missing": ...} or {"error": ...}. Each other line is {"state": {...}, "observation": {...} or null,
"reward": ..., "terminated": ..., "truncated": ..., "legal": ...} or {"refused": ...}. Lines that are not
answered after SECONDS are left out.
"""

import json
import logging
import sys
import time
import warnings

DETERMINISTIC_DISTRIBUTIONS = {"KronDelta", "DiracDelta"}


def main(domain, instance, questions, answers, seconds):
    with open(answers, "w") as out:

        def say(line):
            out.write(json.dumps(line) + "\n")
            out.flush()

        try:
            import numpy
            import pyRDDLGym
        except ImportError as error:
            return say({"missing": str(error)})
        warnings.simplefilter("ignore")
        numpy.seterr(all="ignore")
        logging.disable(logging.WARNING)
        try:
            simulator = Simulator(pyRDDLGym, numpy, domain, instance)
        except Exception as error:
            return say({"error": f"{type(error).__name__}: {error}"})
        say(simulator.header())
        end = time.monotonic() + float(seconds)
        with open(questions) as lines:
            for line in lines:
                if time.monotonic() > end:
                    break
                say(simulator.answer(json.loads(line)))


class Simulator:
    def __init__(self, module, numpy, domain, instance):
        self.numpy = numpy
        self.version = getattr(module, "__version__", "")
        # States and actions are set as arrays, so that nothing is converted in between.
        settings = {"objects_as_strings": False}
        environment = module.make(domain, instance, vectorized=True, backend_kwargs=settings)
        self.model, self.simulator = environment.model, environment.sampler
        self.simulator.seed(0)
        self.initial = dict(self.simulator.init_values)
        self.random = random_names(self.model)

    def header(self):
        model = self.model
        changed = {name for name, cpf in model.next_state.items() if cpf in self.random}
        seen = {name for name in model.observ_fluents if name in self.random}
        endings = [*model.terminations, *model.invariants]
        return {
            "version": self.version or installed_version(),
            "random": sorted(changed | seen),
            "random_reward": is_random(model.reward, self.random),
            "random_ending": any(is_random(condition, changed) for condition in endings),
        }

    def answer(self, question):
        try:
            return self.step(question["state"], question["action"])
        except Exception as error:
            return {"refused": f"{type(error).__name__}: {error}"}

    def step(self, state, action):
        model, simulator = self.model, self.simulator
        actions = {name: self.array(name, action) for name in model.action_fluents}
        simulator.subs = self.table(state)
        legal = simulator.check_action_preconditions(actions, silent=True)
        simulator.subs = table = self.table(state)
        _, reward, terminated = simulator.step(actions)
        return {
            "legal": bool(legal),
            "state": self.values(model.state_fluents, table),
            "observation": self.values(model.observ_fluents, table) or None,
            "reward": plain_real(float(reward)),
            "terminated": bool(terminated),
            "truncated": not simulator.check_state_invariants(silent=True),
        }

    def table(self, state):
        """A step rebinds entries of the table, but writes into no array."""
        return {**self.initial, **{name: self.array(name, state) for name in self.model.state_fluents}}

    def objects_of(self, name):
        objects = self.model.type_to_objects.get(self.model.variable_ranges[name], ())
        return [word.removeprefix("@") for word in objects]

    def array(self, name, values):
        plain = [values[grounded] for grounded in self.model.variable_groundings[name]]
        if objects := self.objects_of(name):
            plain = [objects.index(value) for value in plain]
        elif self.model.variable_ranges[name] == "real":
            plain = [float(value) for value in plain]
        array = self.numpy.array(plain, dtype=self.dtype(name))
        types = self.model.variable_params[name]
        shape = tuple(len(self.model.type_to_objects[kind]) for kind in types)
        return array.reshape(shape) if shape else array[0]

    def values(self, names, table):
        values = {}
        for name in names:
            plain = self.numpy.asarray(table[name]).astype(self.dtype(name)).reshape(-1).tolist()
            if objects := self.objects_of(name):
                plain = [objects[index] for index in plain]
            elif self.model.variable_ranges[name] == "real":
                plain = [plain_real(value) for value in plain]
            values.update(zip(self.model.variable_groundings[name], plain))
        return values

    def dtype(self, name):
        numpy = self.numpy
        kinds = {"bool": numpy.bool_, "real": numpy.float64}
        return kinds.get(self.model.variable_ranges[name], numpy.int64)


def plain_real(value):
    """JSON has no words for nan and the infinities."""
    return value if abs(value) < float("inf") else str(value)


def installed_version():
    from importlib.metadata import version

    return version("pyRDDLGym")


def random_names(model):
    """The CPFs whose value depends, within the step, on a random draw."""
    random = set()
    while True:
        found = {name for name, (_, body) in model.cpfs.items() if is_random(body, random)}
        if found <= random:
            return random
        random |= found


def is_random(expression, random):
    """Does the expression draw, or mention one of the given names?"""
    if hasattr(expression, "etype"):
        kind, name = expression.etype
        if kind == "randomvector" or (kind == "randomvar" and name not in DETERMINISTIC_DISTRIBUTIONS):
            return True
        if kind == "pvar" and name in random:
            return True
        return is_random(expression.args, random)
    if isinstance(expression, dict):
        return any(is_random(part, random) for part in expression.values())
    if isinstance(expression, (tuple, list)):
        return any(is_random(part, random) for part in expression)
    return False


if __name__ == "__main__":
    main(*sys.argv[1:])
