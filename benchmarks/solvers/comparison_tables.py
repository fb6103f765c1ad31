"""Tables of what `compare_all.py` has played, what they show, and whether that is enough."""

from sweep import interval_text

LEARNERS = ("ppo", "cgp", "drp")
PLANNERS = ("cem", "uct", "gradient", "rollout")
OURS = LEARNERS + PLANNERS
THEIRS = ("jaxplan", "prost")
FLOORS = ("noop", "random")
COLUMNS = {"noop": "no-op", "random": "random", "ppo": "PPO", "cgp": "CGP", "drp": "DRP", "cem": "`plan:cem`", "uct": "`plan:uct`",
           "gradient": "`plan:gradient`", "rollout": "`plan:rollout`", "optimum": "optimum", "jaxplan": "JaxPlan", "prost": "PROST"}
# Why a method has no return: what its message contains, and the word that stands in the table.
REASONS = (("longer than", "time"), ("memory", "memory"), ("not discrete", "reals"), ("joint actions", "actions"),
           ("outcomes of", "outcomes"), ("combinations of what it draws", "outcomes"), ("lead to a fault", "faults"),
           ("states can be reached", "states"), ("derivative", "derivatives"),
           ("no such actions", "objects"))
REQUIRED_SHARE = 0.9


def has_value(result):
    return result is not None and "failure" not in result and not result.get("illegal_steps") and all(
        isinstance(result[key], (int, float)) for key in ("mean", "half_width"))


def error_of_difference(a, b):
    """Half of the 95 % confidence interval of the difference of two returns."""
    return (a["half_width"] ** 2 + b["half_width"] ** 2) ** 0.5


def is_better(result, floor):
    """Better by more than a thousandth, and by more than chance."""
    return result["mean"] - floor["mean"] > max(1e-3 * abs(floor["mean"]), error_of_difference(result, floor))


def is_at_least(result, other):
    """As good within the errors, or a thousandth."""
    return other["mean"] - result["mean"] <= max(1e-3 * abs(other["mean"]), error_of_difference(result, other))


class Row:
    """The results of one instance, by method."""

    def __init__(self, problem, instance):
        self.problem, self.instance, self.results = problem, instance, {}

    @property
    def name(self):
        return f"{self.problem} {self.instance}"

    def best_of(self, methods):
        return max((self.results[method] for method in methods if has_value(self.results.get(method))),
                   key=lambda result: result["mean"], default=None)

    def exceeds_floors(self, result):
        floors = [self.results[name] for name in FLOORS if has_value(self.results.get(name))]
        return has_value(result) and bool(floors) and all(is_better(result, floor) for floor in floors)

    @property
    def optimum(self):
        """A return that no policy exceeds in the mean; none where it discounts, since the others do not."""
        result = self.results.get("optimum")
        return result if has_value(result) and result.get("discount", 1) == 1 else None

    @property
    def is_better_possible(self):
        return any(self.exceeds_floors(result) for result in (self.optimum, *map(self.results.get, OURS + THEIRS)))


def rows_of(results):
    rows = {}
    for result in results:
        key = result["problem"], int(result["instance"])
        rows.setdefault(key, Row(*key)).results[result["method"]] = result
    return [row for _, row in sorted(rows.items())]


def reason_text(failure):
    return next((word for part, word in REASONS if part in failure), "-")


def cell(row, method, best):
    result = row.results.get(method)
    if result is None:
        return ""
    if "failure" in result:
        return reason_text(result["failure"])
    text = interval_text(result["mean"], result["half_width"])
    if method == "optimum" and result.get("discount", 1) != 1:
        return text + " discounted"
    if result.get("illegal_steps"):
        return text + " illegal"
    return f"**{text}**" if best is not None and has_value(result) and method in OURS + THEIRS and \
        result["mean"] == best["mean"] else text


def effort(row, methods):
    """Seconds of learners, and milliseconds of a decision."""
    def text(method):
        result = row.results.get(method)
        if not has_value(result):
            return "-"
        return f"{result['training_seconds']:.0f} s" if method in LEARNERS else (
            f"{1000 * result['seconds'] / result['decisions']:.2g}")

    return ", ".join(text(method) for method in methods if method in OURS)


def table(rows):
    methods = [method for method in COLUMNS if any(method in row.results for row in rows)]
    lines = ["| problem | | " + " | ".join(COLUMNS[method] for method in methods) + " | effort |",
             "|" + "---|" * (len(methods) + 3)]
    for row in rows:
        best = row.best_of(OURS + THEIRS)
        lines.append(f"| {row.problem} | {row.instance} | " + " | ".join(cell(row, method, best) for method in methods) +
                     f" | {effort(row, methods)} |")
    return "\n".join(lines)


def numbers_text(numbers):
    *most, last = (f"{number:,}" for number in sorted(set(numbers)))
    return f"{', '.join(most)} or {last}" if most else last


def options_text(results):
    """The options of a planner that are not its defaults, and where."""
    where = {}
    for result in results:
        if "options" in result:
            where.setdefault(result["options"], []).append(f"{result['problem']} {result['instance']}")
    return "".join(f"; `{options}` on {', '.join(names)}" for options, names in where.items())


def settings_text(rows):
    """Episodes of each method, and steps of a planner's decision."""
    parts = []
    for method, name in COLUMNS.items():
        results = [row.results[method] for row in rows if has_value(row.results.get(method))]
        if not results or method == "optimum":
            continue
        text = f"{name} {numbers_text(result['episodes'] for result in results)}"
        if method in PLANNERS:
            text += f" ({numbers_text(result['steps'] for result in results)} steps a decision{options_text(results)})"
        parts.append(text)
    return "Episodes: " + ", ".join(parts) + "."


def rows_beside_theirs(rows):
    """The rows that have a result of another program, and those of them on which ours is worse."""
    beside = [row for row in rows if row.best_of(THEIRS) and row.best_of(OURS)]
    return beside, [row for row in beside if not is_at_least(row.best_of(OURS), row.best_of(THEIRS))]


def rows_like_floors(rows):
    """The rows on which no method of ours is better than no-op and random."""
    return [row for row in rows if not any(row.exceeds_floors(row.results.get(method)) for method in OURS)]


def listed(rows):
    return ", ".join(row.name for row in rows)


def summary(rows):
    """What the table shows, as a list."""
    counts = {method: sum(row.exceeds_floors(row.results.get(method)) for row in rows) for method in OURS
              if any(method in row.results for row in rows)}
    like_floors = rows_like_floors(rows)
    lines = [f"* Better than no-op and random by more than chance, of {len(rows)}: " + ", ".join(
        f"{COLUMNS[method]} {count}" for method, count in counts.items()) +
        f"; at least one of them {len(rows) - len(like_floors)}."]
    if like_floors:
        lines.append(f"* No method of rddlc is better than no-op and random on: {listed(like_floors)}.")
    solved = [row for row in rows if row.optimum and row.best_of(OURS)]
    if solved:
        below = [row for row in solved if not is_at_least(row.best_of(OURS), row.optimum)]
        lines.append(f"* The optimum is known on {len(solved)}. The best of ours is below it, by more than the errors, on "
                     f"{len(below)}{': ' if below else ''}{listed(below)}.")
    for method in THEIRS:
        beside = [row for row in rows if has_value(row.results.get(method)) and row.best_of(OURS)]
        if beside:
            worse = [row for row in beside if not is_at_least(row.best_of(OURS), row.results[method])]
            lines.append(f"* The best of ours is at least as good as {COLUMNS[method]}, within errors, on "
                         f"{len(beside) - len(worse)} of {len(beside)}." +
                         (f" It is worse on: {listed(worse)}." if worse else ""))
    return "\n".join(lines)


def document(results):
    rows = rows_of(results)
    return "\n\n".join((table(rows), settings_text(rows), summary(rows)))


def shortfalls(results):
    """What keeps the results from the aims: ours as good as theirs on nine rows of ten, and better than no-op and random
    wherever some method is."""
    rows = rows_of(results)
    beside, worse = rows_beside_theirs(rows)
    missing = [f"{row.name}: some method is better than no-op and random, and no method of rddlc is"
               for row in rows_like_floors(rows) if row.is_better_possible]
    if beside and len(worse) > (1 - REQUIRED_SHARE) * len(beside):
        missing.append(f"ours is worse than theirs on {len(worse)} of {len(beside)}: {listed(worse)}")
    return missing
