// Two policies with the same luck: episodes side by side, and the returns of many.
import { ask, byId, followJob, guardedBy, make, say, shown } from "./server.js";
import { Episode, Transport } from "./episode.js";
import { texts } from "./problem.js";
import { problemIsBroken, seedOf } from "./try.js";

const sides = [new Episode("left", { title: "first" }), new Episode("right", { title: "second", color: "--second" })];
const transport = new Transport(sides);
// The steps of an episode: those of the problem, unless the user gives a number.
const horizon = () => (byId("horizon").value ? { horizon: Math.round(Number(byId("horizon").value)) } : {});
const names = () => [byId("first").value.trim(), byId("second").value.trim()];
const tell = (text, isBad) => say("compare-message", text, isBad);
const guarded = guardedBy(tell);

async function playBoth() {
  if (problemIsBroken("compare-message")) return;
  transport.pause();
  tell("starting …");
  const policies = names();
  for (const [k, side] of sides.entries()) {
    await side.load({ ...texts(), ...horizon(), seed: seedOf("compare-seed"), policy: policies[k] });
    side.title = policies[k];
    side.isPending = true;
  }
  byId("both").hidden = false;
  byId("compare-stop").hidden = false;
  transport.show(0);
  tell("");
  try {
    for (const [k, side] of sides.entries()) await side.runPolicy(policies[k]);
    transport.play({ fromHere: false });
    await Promise.all(sides.map((side) => side.follow(() => transport.refresh()).finally(() => { side.isPending = false; })));
  } finally {
    for (const side of sides) side.isPending = false;
    byId("compare-stop").hidden = true;
  }
}

async function evaluate() {
  if (problemIsBroken("compare-message")) return;
  const [first, second] = names();
  await ask("compare", { ...texts(), ...horizon(), first, second, seed: seedOf("compare-seed"), episodes: Math.round(Number(byId("episodes").value)) });
  byId("outcome").replaceChildren();
  await follow();
}

function showProgress({ state, progress, seconds }) {
  const { policy, part } = progress ?? {};
  if (state === "running")
    tell(policy ? `${policy}: ${Math.round(100 * part)} % in ${Math.round(seconds)} s` : `compiling for ${Math.round(seconds)} s`);
}

async function follow() {
  const status = await followJob("compare", byId("compare-stop"), 250, showProgress);
  if (status.state === "failed") return tell(status.error, true);
  if (!status.result) return tell(status.state === "stopped" ? "stopped" : "");
  tell(status.state === "stopped" ? "stopped: this is what was finished" : "");
  byId("outcome").replaceChildren(...outcome(status.result));
}

const interval = ({ mean, half_width_95: half }) => (half > 0 ? `${shown(mean)} ± ${shown(Number(half.toPrecision(3)))}` : shown(mean));

function outcome({ policies, pairs, difference }) {
  const rows = [
    ["return", (one) => interval(one.return)], ["discounted", (one) => interval(one.discounted_return)],
    ["least", (one) => shown(one.return.min)], ["greatest", (one) => shown(one.return.max)],
    ["steps", (one) => shown(one.length.mean)], ["episodes", (one) => one.episodes],
    ["ended by a termination", (one) => one.terminated], ["illegal actions", (one) => one.illegal_actions],
    ["faults", (one) => one.faulted]];
  const head = make("tr", {}, make("td"), ...policies.map((one) => make("th", { textContent: one.policy, scope: "col" })));
  const table = make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows.map(([name, text]) =>
    make("tr", {}, make("th", { textContent: name, scope: "row" }), ...policies.map((one) => make("td", { textContent: text(one) }))))));
  const { mean, half_width_95: half } = difference;
  const isSure = Math.abs(mean) > half;
  const faulty = policies.filter((one) => one.faulted > 0)
    .map((one) => `Faults ended ${one.faulted} of ${one.episodes} episodes of “${one.policy}”, so its return is of fewer steps.`);
  const verdict = faulty.length ? faulty.join(" ") : pairs < 2 ? "" : !isSure ? "No difference can be told from so many episodes."
    : `“${policies[mean > 0 ? 1 : 0].policy}” has the greater return.`;
  return [make("div", { className: "table" }, table),
    make("p", { id: "verdict", textContent: `Difference of the same episodes, second minus first: ${interval(difference)} (${pairs} pairs, 95 % confidence). ${verdict}` })];
}

export function comparePolicy(name) {
  byId("second").value = name;
  byId("second").dispatchEvent(new Event("change"));
}

export async function startCompare() {
  byId("both").append(transport.root, make("div", { className: "sides" }, ...sides.map((side) => side.root)));
  byId("both").hidden = true;
  byId("beside").addEventListener("click", guarded(playBoth));
  byId("evaluate").addEventListener("click", guarded(evaluate));
  byId("compare-stop").addEventListener("click", guarded(async () => {
    transport.pause();
    await ask("stop", { job: "compare" });
    for (const side of sides) if (side.isThere) await side.stop();
  }));
  const { state } = await ask("job", { job: "compare" });
  if (state !== "absent") guarded(follow)();
  const there = await Promise.all(sides.map((side) => side.resume()));
  if (!there.every(Boolean)) return;
  names().forEach((name, k) => { sides[k].title = name; });
  byId("both").hidden = false;
  transport.show(sides[0].at);
}
