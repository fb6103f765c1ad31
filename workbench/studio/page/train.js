// Learning a policy, with the curve as it grows.
import { ask, byId, followJob, guardedBy, make, say, shown } from "./server.js";
import { Chart } from "./chart.js";
import { texts } from "./problem.js";
import { problemIsBroken, seedOf } from "./try.js";

const chart = new Chart("return");
const tell = (text, isBad) => say("train-message", text, isBad);
const guarded = guardedBy(tell);
let folder = "";

async function learn() {
  if (problemIsBroken("train-message")) return;
  const options = byId("options").value.trim().split(/\s+/).filter(Boolean);
  await ask("train", { ...texts(), solver: byId("learner").value, seconds: Number(byId("seconds").value),
    seed: seedOf("train-seed"), options });
  await follow();
}

const unit = () => (byId("learner").value === "cgp" ? "generations" : "steps");

function draw({ steps, learning, evaluation }) {
  const line = (values) => steps.map((step, k) => [step, values[k] ?? NaN]);
  chart.draw([{ name: "while it learns", color: "--first", points: line(learning) },
    { name: "evaluations", color: "--second", dash: 1, points: line(evaluation) }], null, { xTitle: unit() });
}

function showProgress({ state, progress: curve, seconds }) {
  if (curve?.steps?.length) draw(curve);
  if (state === "running")
    tell(curve ? `learning for ${Math.round(seconds)} s in ${curve.folder}, ${shown(curve.steps.at(-1) ?? 0)} ${unit()}` : `compiling for ${Math.round(seconds)} s`);
}

async function follow() {
  byId("use-policy").hidden = byId("compare-policy").hidden = true;
  const status = await followJob("train", byId("train-stop"), 400, showProgress);
  if (status.state === "failed") return tell(status.error, true);
  if (!status.result) return tell(status.state === "stopped" ? "stopped before there was a policy" : "");
  const { folder: where, has_policy: isLearned, best_return: best, warning, summary } = status.result;
  folder = where;
  byId("use-policy").hidden = byId("compare-policy").hidden = !isLearned;
  tell([isLearned ? `best return ${shown(best)} in ${where}` : `stopped; the run is in ${where}`, warning, summary].filter(Boolean).join("\n"));
  offerPolicy(where);
}

function offerPolicy(name) {
  if (![...byId("policies").options].some((option) => option.value === name)) byId("policies").append(make("option", { value: name }));
}

export async function startTrain({ tryPolicy, comparePolicy }) {
  byId("curve").append(chart.root);
  byId("train-form").addEventListener("submit", guarded(learn));
  byId("train-stop").addEventListener("click", guarded(() => ask("stop", { job: "train" })));
  byId("use-policy").addEventListener("click", () => tryPolicy(folder));
  byId("compare-policy").addEventListener("click", () => comparePolicy(folder));
  const { state } = await ask("job", { job: "train" });
  if (state !== "absent") guarded(follow)();
}
