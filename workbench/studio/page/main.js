// The page begins here.
import { ask, byId, Gone, make, say, watch } from "./server.js";
import { setWords } from "./words.js";
import { check, openProblem } from "./problem.js";
import { startTry, textsChanged, usePolicy } from "./try.js";
import { comparePolicy, startCompare } from "./compare.js";
import { startTrain } from "./train.js";

// ---- views: wide pages show the editor beside the others

function show(view) {
  document.body.dataset.view = view;
  sessionStorage.setItem("rddl-view", view);
  for (const button of document.querySelectorAll("[data-shows]"))
    button.setAttribute("aria-pressed", String(button.dataset.shows === view));
  dispatchEvent(new Event("resize"));
}

// ---- forms outlive a reload

function keepForms() {
  for (const input of document.querySelectorAll("[data-keep]")) {
    const kept = sessionStorage.getItem(`rddl-form-${input.id}`);
    if (kept !== null) input.value = kept;
    for (const event of ["input", "change"])
      input.addEventListener(event, () => sessionStorage.setItem(`rddl-form-${input.id}`, input.value));
  }
}

// ---- a program that has ended

const sentences = {
  gone: "‘rddl studio’ does not answer: it has ended, or the machine sleeps. Your texts are kept in this browser; start it again and open the address that it prints.",
  unknown: "This page belongs to an earlier run of ‘rddl studio’: open the address that the new one has printed. Your texts are kept in this browser, and that page offers them.",
};
let health = "alive";
watch((state) => {
  if (state === health) return;
  const comesBack = health === "gone" && state === "alive";
  health = state;
  byId("gone").hidden = state === "alive";
  byId("gone").textContent = sentences[state] ?? "";
  if (comesBack) check();
});

// What was wrong with the texts before may be repaired now.
function changed() {
  for (const id of ["try-message", "compare-message", "train-message"])
    if (byId(id).classList.contains("bad")) say(id, "");
  textsChanged();
}

function fillPolicies(planners) {
  const names = ["random", "noop", "rddl", ...planners.map(({ name }) => name)];
  const summaries = Object.fromEntries(planners.map(({ name, summary }) => [name, summary]));
  byId("policies").append(...names.map((name) => make("option", { value: name, label: summaries[name] ?? "" })));
}

async function start() {
  let information;
  try {
    information = await ask("open");
  } catch (error) {
    if (!(error instanceof Gone)) byId("gone").textContent = error.message;
    byId("gone").hidden = false;
    return;
  }
  setWords(information.words);
  fillPolicies(information.planners);
  keepForms();
  for (const button of document.querySelectorAll("[data-shows]")) button.addEventListener("click", () => show(button.dataset.shows));
  show(sessionStorage.getItem("rddl-view") ?? "edit");
  await openProblem(information, changed);
  await startTry();
  await startCompare();
  await startTrain({
    tryPolicy: (name) => { usePolicy(name); show("try"); },
    comparePolicy: (name) => { comparePolicy(name); show("compare"); },
  });
  setInterval(() => ask("ping").catch(() => {}), 3000);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => dispatchEvent(new Event("resize")));
  document.body.dataset.ready = "yes";
}

start();
