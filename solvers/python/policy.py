"""Reads a policy of `rddl train ppo` or `rddl train drp` (policy.json) and acts by it, with nothing but the standard library.

    policy = Policy("runs/a/policy.json")
    action = policy.act({"pos": -0.5, "vel": 0.0}, step=0)      # {"action": 0.87}

Step 0 begins an episode. Names are those of the policy file: "rlevel(t1)". Masks are not known here, so that policies which need them
(`action["masked"]`) may choose what a precondition forbids; `allowed` says which logits may be chosen.
"""

import json
import math

ACTIVATIONS = {"tanh": math.tanh, "relu": lambda x: max(0.0, x)}


class Policy:
    def __init__(self, path):
        with open(path) as file:
            self.file = json.load(file)
        if self.file.get("format") != "rddl-policy" or self.file.get("solver") not in ("ppo", "drp"):
            raise ValueError(f"{path} is not a policy of PPO or DRP")
        if self.file["version"] > 6:
            raise ValueError(f"{path} is of version {self.file['version']}, and this reads versions up to 6")
        name = self.file.get("activation", "tanh")
        if name not in ACTIVATIONS:
            raise ValueError(f"the activation of {path} is unknown: '{name}'")
        self.activation = ACTIVATIONS[name]
        self.frames = []
        self.memory = []

    def features(self, observation, step):
        """The row that the network sees, before it is normalised. Values are numbers; objects their index."""
        space = self.file["observation"]["space"]
        frame = []
        for column in space["columns"]:
            value = float(observation[column["name"]])
            if column["objects"] > 0:
                frame += [1.0 if k == value else 0.0 for k in range(column["objects"])]
            else:
                frame.append(value)
        if step == 0:
            self.memory = [0.0] * self.file.get("recurrent", {"units": 0})["units"]
            self.frames = [[0.0] * len(frame) for _ in range(space["stack"])]
        self.frames = [frame] + self.frames[:space["stack"] - 1]
        row = [value for each in self.frames for value in each]
        return row + ([step / space["horizon"]] if space["time"] else [])

    def _remember(self, row):
        """A step of the gated recurrent units."""
        its = self.file["recurrent"]
        times = lambda weights, x: [sum(w * each for w, each in zip(of_unit, x)) for of_unit in weights]
        sums = {name: ([a + b for a, b in zip(its[name]["bias"], times(its[name]["input"], row))],
                       times(its[name]["state"], self.memory)) for name in ("candidate", "reset", "update")}
        gate = lambda name: [(math.tanh((a + b) / 2) + 1) / 2 for a, b in zip(*sums[name])]
        candidate = [math.tanh(a + r * (b + bias))
                     for a, b, bias, r in zip(*sums["candidate"], its["state_bias"], gate("reset"))]
        self.memory = [n + z * (old - n) for n, z, old in zip(candidate, gate("update"), self.memory)]

    def outputs(self, features):
        """Means of reals, then logits. A recurrent policy remembers these features: ask once in each step."""
        seen = self.file["observation"]
        row = [max(-10.0, min(10.0, (x - mean) * factor))
               for x, mean, factor in zip(features, seen["means"], seen["factors"])]
        if self.memory:
            self._remember(row)
            row += self.memory
        layers = self.file["policy"]
        for number, layer in enumerate(layers):
            row = [bias + sum(w * x for w, x in zip(weights, row))
                   for weights, bias in zip(layer["weights"], layer["bias"])]
            if number + 1 < len(layers):
                row = [self.activation(x) for x in row]
        return row

    @staticmethod
    def _real(head, x):
        softplus = max(x, 0.0) + math.log1p(math.exp(-abs(x)))
        lower = -math.inf if head["lower"] is None else head["lower"]
        upper = math.inf if head["upper"] is None else head["upper"]
        value = {"squashed": lambda: lower + (math.tanh(x) + 1) / 2 * (upper - lower),
                 "bounded": lambda: lower + (max(-1.0, min(1.0, x)) + 1) / 2 * (upper - lower),
                 "above lower": lambda: lower + head["scale"] * softplus,
                 "below upper": lambda: upper - head["scale"] * softplus,
                 "free": lambda: head["centre"] + head["scale"] * x}[head["range"]]()
        return max(lower, min(upper, round(value) if head["rounds"] else value))

    def act(self, observation, step, allowed=lambda logit: True):
        """The likeliest action, a value for each name."""
        action = self.file["action"]
        outputs = self.outputs(self.features(observation, step))
        reals, logits = outputs[:len(action["reals"])], outputs[len(action["reals"]):]
        values = list(action["defaults"])
        likeliest = lambda places: max((p for p in places if allowed(p)), key=lambda p: (logits[p], -p))
        sub_actions = action.get("max_sub_actions", action.get("picks"))  # older files: picks
        if sub_actions == 0:
            for head, x in zip(action["reals"], reals):
                values[head["column"]] = self._real(head, x)
            for head in action["categories"]:
                first = head["first_logit"]
                value = likeliest(range(first, first + head["count"])) - first + head["first_value"]
                if "group" not in head:
                    values[head["column"]] = value
                elif value > 0:  # it says which bool of the group changes
                    changed = head["group"][value - 1]
                    values[changed] = 1 - values[changed]
        changed = set()
        for _ in range(sub_actions):
            chosen = likeliest([c for c, choice in enumerate(action["choices"])
                              if c == 0 or choice["column"] not in changed])
            if chosen == 0:
                break
            choice = action["choices"][chosen]
            changed.add(choice["column"])
            values[choice["column"]] = (self._real(action["reals"][choice["real"]], reals[choice["real"]])
                                        if choice["real"] >= 0 else choice["value"])
        return dict(zip(action["columns"], values))
