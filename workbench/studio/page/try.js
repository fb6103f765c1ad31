// One episode: played by policies, or by hand.
import { ask, byId, guardedBy, make, say, shown } from "./server.js";
import { Episode, Transport } from "./episode.js";
import { isBroken, texts } from "./problem.js";

const episode = new Episode("hand", { onShow: () => showHand() });
const transport = new Transport([episode]);
let loaded = null;  // the texts of the episode, as JSON
let fields = [];    // of the action

export const seedOf = (id) => Math.max(0, Math.round(Number(byId(id).value) || 0));

const tell = (text, isBad) => say("try-message", text, isBad);
const guarded = guardedBy(tell);

export function problemIsBroken(id) {
  if (isBroken()) say(id, "The texts have errors: the view Edit shows them.", true);
  return isBroken();
}

async function begin() {
  if (problemIsBroken("try-message")) return false;
  tell("starting …");
  const begun = texts();
  await episode.load({ ...begun, seed: seedOf("seed"), policy: byId("policy").value.trim() });
  loaded = JSON.stringify(begun);
  tell("");
  buildHand();
  transport.show(0);
  return true;
}

// The policy block that an episode of the policy must have: a file, or "" for that of the texts; null: any.
function blockOf(policy) {
  if (policy === "rddl") return "";
  return policy.endsWith(".rddl") ? policy : null;
}

// Whether there is no episode yet, or it has another policy block.
function needsBegin() {
  const block = blockOf(byId("policy").value.trim());
  return !episode.isThere || (block !== null && block !== episode.problem.policy_block);
}

function policyName() {
  const name = byId("policy").value.trim();
  if (!name) throw new Error("name a policy");
  return name;
}

async function run(steps) {
  if (needsBegin() && !(await begin())) return;
  transport.pause();
  if (episode.moments[episode.at].ended) return tell("The episode is over here: go back, or begin another one.");
  await episode.runPolicy(policyName(), steps);
  byId("halt").hidden = false;
  let isPlaying = false;
  const seen = (steps ?? Infinity) === 1 ? () => {} : () => {
    transport.refresh();
    if (!isPlaying && episode.last > episode.at) {
      isPlaying = true;
      transport.play({ fromHere: false });
    }
  };
  episode.isPending = true;
  try {
    await episode.follow(seen);
  } finally {
    episode.isPending = false;
    byId("halt").hidden = true;
  }
  if (steps === 1) transport.show(episode.at + 1);
  else seen();
  tell(episode.run?.state === "stopped" ? "stopped" : "");
}

// ------------------------------------------------------------------------------------- by hand

function buildHand() {
  const { actions, action_count: count, max_nondef_actions: most } = episode.problem;
  fields = actions.map(field);
  byId("actions").replaceChildren(...fields.map(({ root }) => root));
  byId("action-filter-label").hidden = actions.length <= 12;
  byId("action-filter").value = "";
  byId("hand-hint").textContent = [
    actions.length === 0 ? "This problem has no actions." : "",
    most >= 0 && most < count ? `At most ${most} of ${count} values may differ from the default.` : "",
    count > actions.length ? `Only the first ${actions.length} of ${count} values are listed.` : ""].filter(Boolean).join(" ");
  showHand();
}

function field(value) {
  const { name, type, lower, upper } = value;
  let input;
  if (type === "bool") input = make("input", { type: "checkbox", checked: value.default });
  else if (type === "object") input = make("select", {}, ...value.objects.map((object) => make("option", { value: object, textContent: object })));
  else input = make("input", { type: "number", step: type === "int" ? 1 : "any" });
  if (type !== "bool") input.value = value.default;
  if (lower !== null) input.min = lower;
  if (upper !== null) input.max = upper;
  const range = type === "int" || type === "real"
    ? ` (${type}${lower !== null || upper !== null ? `, ${lower ?? "−∞"} to ${upper ?? "∞"}` : ""})` : "";
  const root = make("label", { className: `field ${type}` }, make("span", { textContent: name + range }), input);
  input.addEventListener("input", () => { byId("take-anyway").hidden = true; });
  return { value, input, root };
}

// The values that differ from their defaults.
function chosenAction() {
  const action = Object.create(null);  // names such as "constructor" are values too
  for (const { value, input } of fields) {
    let chosen = input.value;
    if (value.type === "bool") chosen = input.checked;
    if (value.type === "int" || value.type === "real") {
      if (input.value.trim() === "" || Number.isNaN(Number(input.value))) throw new Error(`${value.name} is not a number`);
      chosen = Number(input.value);
    }
    if (chosen !== value.default) action[value.name] = chosen;
  }
  return action;
}

function setAction(action) {
  for (const { value, input } of fields) {
    const chosen = Object.hasOwn(action, value.name) ? action[value.name] : value.default;
    if (value.type === "bool") input.checked = chosen;
    else input.value = chosen;
  }
  byId("take-anyway").hidden = true;
}

// Shows the action that was taken where one has gone back.
function showHand() {
  const moment = episode.moments[episode.at];
  byId("hand").hidden = !moment;
  if (!moment) return;
  if (moment.action) setAction(moment.action);
  const isOver = moment.ended !== undefined;
  for (const id of ["take", "ask"]) byId(id).disabled = isOver;
}

async function take(force) {
  transport.pause();
  const violation = await episode.takeAction(chosenAction(), force);
  byId("take-anyway").hidden = !violation;
  transport.show(episode.at);
  const before = episode.moments[episode.at - 1];
  tell(violation ? `This action is illegal: ${violation}` : `reward ${shown(before?.reward ?? 0)}`, Boolean(violation));
}

// The action that the policy would take here; the episode stays as it is.
async function askPolicy() {
  const isNew = needsBegin();
  if (isNew && !(await begin())) return;
  tell("asking …");
  const { action } = await ask("advice", { player: "hand", policy: policyName(), step: episode.at });
  setAction(action);
  tell(`${policyName()} would do this${isNew ? " in a new episode, which its policy block needs" : ""}`);
}

// -------------------------------------------------------------------------------------- the page

export function textsChanged() {
  if (!loaded) return;
  const isOld = loaded !== JSON.stringify(texts());
  if (isOld) tell("The texts have changed: “New episode” takes them.");
  else if (byId("try-message").textContent.startsWith("The texts have changed")) tell("");
}

export function usePolicy(name) {
  byId("policy").value = name;
  byId("policy").dispatchEvent(new Event("change"));
}

export async function startTry() {
  byId("hand-episode").append(transport.root, episode.root);
  byId("hand").hidden = true;
  byId("begin").addEventListener("click", guarded(begin));
  byId("run").addEventListener("click", guarded(() => run()));
  byId("once").addEventListener("click", guarded(() => run(1)));
  byId("halt").addEventListener("click", guarded(() => { transport.pause(); return episode.stop(); }));
  byId("hand").addEventListener("submit", guarded(() => take(false)));
  byId("take-anyway").addEventListener("click", guarded(() => take(true)));
  byId("defaults").addEventListener("click", () => setAction({}));
  byId("ask").addEventListener("click", guarded(askPolicy));
  byId("action-filter").addEventListener("input", () => {
    const wanted = byId("action-filter").value.toLowerCase();
    for (const { value, root } of fields) root.hidden = !value.name.toLowerCase().includes(wanted);
  });
  if (!(await episode.resume())) return;
  loaded = JSON.stringify(texts());
  buildHand();
  transport.show(episode.at);
  if (episode.isRunning) guarded(() => episode.follow(() => transport.refresh()))();
}
