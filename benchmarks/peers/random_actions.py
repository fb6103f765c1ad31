"""Random legal actions for an environment of pyRDDLGym in its vectorised form.

As `rddl run --policy random` draws them: values within their bounds, as many of which differ from
their default as max-nondef-actions allows; an action that violates a precondition is repaired by
letting values chosen at random fall back to their default until it is legal.
"""

import time

import numpy as np

MOST_STEPS = 2000
FRESH_ACTIONS = 64  # drawn before the search for a legal one is given up


class RandomActions:
    def __init__(self, env):
        self.env = env
        self.defaults = env.sampler.noop_actions
        self.shapes = {name: np.shape(value) for name, value in self.defaults.items()}
        self.most_changes = int(env.max_allowed_actions)
        self.random = np.random.default_rng(1)
        env.action_space.seed(1)

    def draw(self) -> dict:
        """Legal in the present state if one is found, else the default action."""
        for _ in range(FRESH_ACTIONS):
            action = self._sample()
            changed = self._changed(action)
            self._restore(action, changed, len(changed) - self.most_changes)
            while not self._is_legal(action) and changed:
                self._restore(action, changed, max(1, len(changed) // 8))
            if changed or self._is_legal(action):
                return action
        return dict(self.defaults)

    def _sample(self) -> dict:
        # A parameterless real is sampled with shape (1,), which step() refuses.
        sample = self.env.action_space.sample()
        return {name: np.array(value).reshape(self.shapes[name]) for name, value in sample.items()}

    def _changed(self, action: dict) -> list[tuple]:
        """Places of the values that are not the default, in random order."""
        places = [
            (name, index)
            for name, value in action.items()
            for index in zip(*np.nonzero(np.atleast_1d(value != self.defaults[name])))
        ]
        self.random.shuffle(places)
        return places

    def _restore(self, action: dict, changed: list[tuple], count: int) -> None:
        for _ in range(count):
            name, index = changed.pop()
            index = index if self.shapes[name] else ()
            action[name][index] = np.asarray(self.defaults[name])[index]

    def _is_legal(self, action: dict) -> bool:
        sampler = self.env.sampler
        return sampler.check_action_preconditions(sampler.prepare_actions_for_sim(action), silent=True)


def draw_course(env, seconds: float) -> list[dict]:
    """The actions of a run from `env.reset(seed=0)` on, through as many episodes as fit; it ends
    early before a step that faults. Playing them again from there gives the same run."""
    actions = RandomActions(env)
    env.reset(seed=0)
    course, deadline = [], time.perf_counter() + seconds
    while len(course) < MOST_STEPS and (not course or time.perf_counter() < deadline):
        action = actions.draw()
        try:
            _, _, terminated, truncated, _ = env.step(action)
        except Exception:
            if course:
                break
            raise
        course.append(action)
        if terminated or truncated:
            env.reset()
    return course
