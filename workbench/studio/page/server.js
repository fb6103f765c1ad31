// Requests to the program behind the page.

// The secret of the address. It is only sent in a header, which other pages cannot set.
const token = location.hash.slice(1);

// The program refuses a request, and says why.
export class Refused extends Error {
  constructor(message, hint) {
    super(hint ? `${message}; ${hint}` : message);
  }
}
// The program does not answer: it has ended.
export class Gone extends Error {}

// Tabs have episodes and drafts of their own. The name outlives a reload. A tab that was duplicated
// has the name of another one that is alive, and takes a new one.
const nameOfLock = (name) => `rddl-studio/${name}`;

// Whether the lock is there within so many milliseconds.
function hold(name, patience) {
  if (!navigator.locks) return Promise.resolve(true);
  return new Promise((tell) => {
    navigator.locks.request(nameOfLock(name), { signal: AbortSignal.timeout(patience) }, () => {
      tell(true);
      return new Promise(() => {});  // for as long as the tab lives
    }).catch(() => tell(false));
  });
}

// The page before a reload holds its lock until it is gone, which takes long on a busy machine.
async function chooseName() {
  const before = sessionStorage.getItem("rddl-tab");
  const isReload = performance.getEntriesByType("navigation")[0]?.type === "reload";
  if (before && await hold(before, isReload ? 10000 : 1000)) return before;
  const name = Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(16).padStart(2, "0")).join("");
  sessionStorage.setItem("rddl-tab", name);
  await hold(name, 1000);
  return name;
}
export const tab = await chooseName();

export async function isAlive(name) {
  if (!navigator.locks) return false;
  const { held } = await navigator.locks.query();
  return held.some((lock) => lock.name === nameOfLock(name));
}

// Called with whether the program answers, and whether it knows this page.
let watcher = () => {};
export function watch(callback) {
  watcher = callback;
}

export async function ask(request, members = {}, { binary = false } = {}) {
  let response;
  try {
    response = await fetch(`/api/${request}`, {
      method: "POST",
      cache: "no-store",
      headers: { "Content-Type": "application/json", "X-Rddl-Token": token },
      body: JSON.stringify({ ...members, tab }),
    });
  } catch {
    watcher("gone");
    throw new Gone("'rddl studio' does not answer");
  }
  watcher(response.status === 403 ? "unknown" : "alive");
  if (!response.ok) {
    const { error, hint } = await response.json().catch(() => ({ error: `the answer is ${response.status}` }));
    throw new Refused(error, hint);
  }
  return binary ? response.blob() : response.json();
}

// Calls `step` again and again, `pause` milliseconds apart, until it returns false.
export async function poll(step, pause) {
  for (;;) {
    let goesOn = true;
    try {
      goesOn = await step();
    } catch (error) {
      if (!(error instanceof Gone)) throw error;  // else it may come back
    }
    if (!goesOn) return;
    await new Promise((resolve) => setTimeout(resolve, pause));
  }
}

// Follows a job of this tab to its end, and returns its last status. Its button stops it meanwhile.
export async function followJob(job, stopButton, pause, show) {
  stopButton.hidden = false;
  let status;
  try {
    await poll(async () => {
      status = await ask("job", { job });
      show(status);
      return status.state === "running";
    }, pause);
  } finally {
    stopButton.hidden = true;
  }
  return status;
}

// Makes listeners whose errors are told.
export const guardedBy = (tell) => (act) => async (event) => {
  event?.preventDefault?.();
  try {
    await act();
  } catch (error) {
    tell(error.message, true);
  }
};

export const byId = (id) => document.getElementById(id);
export function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// Shows a sentence at the place for messages of a view.
export function say(id, text, isBad = false) {
  byId(id).textContent = text;
  byId(id).classList.toggle("bad", isBad);
}

// A number in about five digits.
export function shown(value) {
  if (typeof value !== "number" || Number.isInteger(value)) return String(value);
  return String(Number(value.toPrecision(5)));
}
