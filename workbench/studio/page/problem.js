// The texts: editors, the language server, drafts, files.
import { ask, byId, isAlive, make, Refused, say, tab } from "./server.js";
import { Editor } from "./editor.js";

const pause = 150;  // milliseconds without a key before the texts are checked
let opened = null;   // what the program was started with
const documents = [];  // of which there are one or two
let current = 0;
let hasErrors = false;
let onChange = () => {};
const tell = (text, isBad) => say("edit-message", text, isBad);

// Browsers have "\n" alone in text areas. Files keep the ends of lines that they had.
const fileText = ({ editor, lineEnd }) => editor.text.replaceAll("\n", lineEnd);
export const texts = () => ({ domain: documents[0].editor.text, instance: documents[1]?.editor.text ?? "" });
export const isBroken = () => hasErrors;

// ---------------------------------------------------------------------------------- documents

function addDocument(name, text) {
  const editor = new Editor(name, {
    onInput: () => { changed(document); },
    onMove: () => moved(document),
    complete: (position) => complete(document, position),
  });
  const tabButton = make("button", { type: "button", textContent: name });
  const document = { name, uri: `studio:/${encodeURIComponent(name)}`, editor, tabButton, version: 1, sent: 0, diagnostics: [],
    lineEnd: text.includes("\r\n") ? "\r\n" : "\n" };
  tabButton.addEventListener("click", () => showDocument(documents.indexOf(document), true));
  editor.text = text;
  document.saved = editor.text;
  documents.push(document);
  byId("texts").append(tabButton);
  byId("editors").append(editor.root);
}

function showDocument(number, focus = false) {
  current = number;
  documents.forEach((document, k) => {
    document.editor.root.hidden = k !== number;
    document.tabButton.setAttribute("aria-pressed", String(k === number));
    document.editor.draw();
  });
  if (focus) documents[number].editor.area.focus();
  byId("about").textContent = "";
}

// ---------------------------------------------------------------------------- language server

let number = 0;
const message = (method, params) => ({ jsonrpc: "2.0", id: ++number, method, params });
const notice = (method, params) => ({ jsonrpc: "2.0", method, params });

// The messages that tell the server of texts that it does not have.
function changes() {
  const found = [];
  for (const document of documents) {
    if (document.sent === document.version) continue;
    const { uri, version, editor } = document;
    found.push(document.sent === 0
      ? notice("textDocument/didOpen", { textDocument: { uri, version, languageId: "rddl", text: editor.text } })
      : notice("textDocument/didChange", { textDocument: { uri, version }, contentChanges: [{ text: editor.text }] }));
    document.sent = version;
  }
  return found;
}

// Sends changes and other messages; the texts are not checked for it. One request follows the other,
// since two on their way at once may arrive in another order.
let lastSent = Promise.resolve();
function send(...others) {
  const answer = lastSent.then(async () => {
    const all = [...changes(), ...others];
    return all.length ? (await ask("language", { messages: all, checks: false })).messages : [];
  });
  lastSent = answer.catch(() => { forgetSent(); });
  return answer;
}

// A program that was started again knows nothing.
function forgetSent() {
  for (const document of documents) document.sent = 0;
}

// The result of one request about a document.
async function request(document, method, params = {}) {
  const asked = message(`textDocument/${method}`, { textDocument: { uri: document.uri }, ...params });
  const messages = await send(asked);
  return messages.find((each) => each.id === asked.id)?.result ?? null;
}

const complete = async (document, position) => (await request(document, "completion", { position }).catch(() => null)) ?? [];

let isChecking = false, isStale = false;
async function check() {
  isStale = true;
  if (isChecking) return;
  isChecking = true;
  const begin = performance.now();
  const clock = setInterval(() => {
    byId("state").textContent = `checking for ${Math.round((performance.now() - begin) / 1000)} s`;
  }, 1000);
  try {
    while (isStale) {
      isStale = false;
      await send();
      const { messages } = await ask("language", { messages: [] });
      for (const { method, params } of messages) {
        const document = documents.find((each) => each.uri === params?.uri);
        if (method !== "textDocument/publishDiagnostics" || !document) continue;
        document.diagnostics = params.diagnostics;
        if (params.version === document.version) document.editor.show(params.diagnostics);
      }
    }
    listProblems();
  } catch {
    forgetSent();
  } finally {
    clearInterval(clock);
    isChecking = false;
    showState();
  }
}
export { check };

// -------------------------------------------------------------------------------- diagnostics

const severities = ["", "error", "warning", "note"];
const allProblems = () => documents.flatMap((document) => document.diagnostics.map((diagnostic) => ({ document, diagnostic })));

function listProblems() {
  const all = allProblems();
  hasErrors = all.some(({ diagnostic }) => diagnostic.severity === 1);
  byId("problems-title").textContent = all.length === 0 ? "No problems" : all.length === 1 ? "1 problem" : `${all.length} problems`;
  byId("problems").replaceChildren(...all.slice(0, 100).map(problemItem));
  for (const document of documents) {
    const count = document.diagnostics.length;
    document.tabButton.textContent = count ? `${document.name} (${count})` : document.name;
    document.tabButton.classList.toggle("bad", document.diagnostics.some(({ severity }) => severity === 1));
  }
}

function problemItem({ document, diagnostic }) {
  const { range, severity, code } = diagnostic;
  const [sentence, hint] = diagnostic.message.split("\nhint: ");
  const { line, character } = range.start;
  const go = make("button", { type: "button", className: "place", textContent: `${document.name}:${line + 1}:${character + 1}` });
  go.addEventListener("click", () => goTo(document, range.start));
  const text = document.editor.lines[line] ?? "";
  const width = range.end.line === line ? Math.max(range.end.character - character, 1) : Math.max(text.length - character, 1);
  // A tab before the caret is as wide as the one above it.
  const caret = text.slice(0, character).replace(/[^\t]/g, " ") + "^".repeat(width);
  const item = make("li", { className: severities[severity] },
    make("div", {}, go, ` ${severities[severity]}: ${sentence}${code ? ` [${code}]` : ""}`),
    make("pre", { textContent: `${text}\n${caret}` }));
  for (const { location, message: words } of diagnostic.relatedInformation ?? []) {
    const other = documents.find((each) => each.uri === location.uri);
    const there = make("button", { type: "button", className: "place", textContent: `${other?.name}:${location.range.start.line + 1}` });
    there.addEventListener("click", () => other && goTo(other, location.range.start));
    item.append(make("div", {}, there, ` ${words}`));
  }
  if (hint) item.append(make("div", { className: "advice", textContent: `hint: ${hint}` }));
  const fix = make("button", { type: "button", className: "fix", textContent: "Repair", hidden: true });
  item.append(fix);
  const { version } = document;
  fixesAt(document, range).then((fixes) => {
    const own = fixes.find((each) => each.kind === "quickfix" && each.diagnostics.some((one) => JSON.stringify(one) === JSON.stringify(diagnostic)));
    if (!own) return;
    fix.textContent = own.title;
    fix.hidden = false;
    fix.addEventListener("click", () => applyTo(document, version, own.edit.changes));
  }).catch(() => {});
  return item;
}

function goTo(document, position) {
  showDocument(documents.indexOf(document));
  document.editor.goTo(position);
  moved(document);
}

// Edits are those of the text that they were made for.
function applyTo(document, version, changes) {
  if (document.version === version) apply(changes);
  else tell("the text has changed: try again");
}

const fixesAt = async (document, range) => (await request(document, "codeAction", { range, context: { diagnostics: [] } })) ?? [];

// Edits of the protocol, the last one first, so that the places of the others hold.
function apply(edits) {
  for (const [uri, list] of Object.entries(edits)) {
    const document = documents.find((each) => each.uri === uri);
    if (!document) continue;
    showDocument(documents.indexOf(document));
    const places = list.map(({ range, newText }) => [document.editor.offsetOf(range.start), document.editor.offsetOf(range.end), newText]);
    places.sort((a, b) => b[0] - a[0]);
    for (const [begin, end, text] of places) document.editor.replace(begin, end, text);
  }
}

function nextProblem() {
  const all = allProblems();
  if (all.length === 0) return;
  const here = documents[current].editor.position();
  const after = all.find(({ document, diagnostic: { range } }) => document === documents[current] &&
    (range.start.line > here.line || (range.start.line === here.line && range.start.character > here.character)));
  const next = after ?? all.find(({ document }) => document !== documents[current]) ?? all[0];
  goTo(next.document, next.diagnostic.range.start);
}

async function repairHere() {
  const document = documents[current];
  const position = document.editor.position(), { version } = document;
  const fix = (await fixesAt(document, { start: position, end: position })).find(({ kind }) => kind === "quickfix");
  if (fix) applyTo(document, version, fix.edit.changes);
  else tell("no problem here has a certain repair");
}

// The name at the cursor, in words.
let aboutTimer = null;
function moved(document) {
  clearTimeout(aboutTimer);
  aboutTimer = setTimeout(async () => {
    const found = await request(document, "hover", { position: document.editor.position() }).catch(() => null);
    const text = found?.contents?.value ?? "";
    byId("about").textContent = text.replace(/```\w*\n?/g, "").replace(/\*\*|`/g, "").split("\n\n").slice(0, 2).join(" · ").slice(0, 400);
  }, 250);
}

// ------------------------------------------------------------------------------ drafts, files

const draftKey = (name) => `rddl-studio/draft/${opened.name}/${name}`;
const isEdited = () => documents.some(({ editor, saved }) => editor.text !== saved);
let draftIsKept = true;

function keepDraft() {
  try {
    if (isEdited()) localStorage.setItem(draftKey(tab), JSON.stringify({ ...texts(), time: Date.now() }));
    else localStorage.removeItem(draftKey(tab));
    draftIsKept = true;
  } catch {  // the texts are larger than what a browser keeps
    draftIsKept = false;
  }
  showState();
}

function readDraft(key) {
  try {
    return JSON.parse(localStorage.getItem(key));
  } catch {
    return null;
  }
}

// The latest draft of a tab that is closed. One that is closed at this moment is alive a little longer.
async function offerEarlierDraft(triesLeft = 10) {
  const begin = draftKey("");
  const keys = Object.keys(localStorage).filter((key) => key.startsWith(begin) && key !== draftKey(tab));
  const found = [];
  let isHeld = false;
  for (const key of keys) {
    const draft = readDraft(key);
    if (!draft) continue;
    if (await isAlive(key.slice(begin.length))) isHeld = true;
    else if (draft.domain === texts().domain && draft.instance === texts().instance) localStorage.removeItem(key);
    else found.push({ key, draft });
  }
  if (found.length === 0) {
    if (isHeld && triesLeft > 0) setTimeout(() => offerEarlierDraft(triesLeft - 1), 500);
    return;
  }
  const { key, draft } = found.sort((a, b) => b.draft.time - a.draft.time)[0];
  byId("earlier-text").textContent = `Texts of ${new Date(draft.time).toLocaleString()} were not saved.`;
  byId("earlier").hidden = false;
  const close = () => { localStorage.removeItem(key); byId("earlier").hidden = true; };
  byId("earlier-take").onclick = () => { setTexts(draft); close(); };
  byId("earlier-drop").onclick = close;
}

function setTexts({ domain, instance }) {
  [domain, instance].forEach((text, k) => {
    if (documents[k] && documents[k].editor.text !== text) {
      documents[k].editor.text = text;
      changed(documents[k]);
    }
  });
}

let checkTimer = null;
function changed(document) {
  ++document.version;
  clearTimeout(checkTimer);
  checkTimer = setTimeout(() => { keepDraft(); check(); }, pause);
  tell("");
  showState();
  onChange();
}

function showState() {
  const words = [];
  if (isEdited()) words.push(opened.can_save ? "edited, not saved" : "edited");
  if (!draftIsKept) words.push("too large to be kept in the browser: save or download it");
  if (hasErrors) words.push("has errors");
  byId("state").textContent = words.join(" · ");
}

async function save(force = false) {
  if (!opened.can_save) return download();
  const written = texts();
  try {
    const [domain, instance] = documents.map(fileText);
    await ask("save", { domain, instance: instance ?? "", force });
    byId("save").textContent = "Save";
    documents.forEach((document, k) => { document.saved = k ? written.instance : written.domain; });
    keepDraft();
    tell("saved");
  } catch (error) {
    if (error instanceof Refused && /another program has/.test(error.message)) byId("save").textContent = "Save over it";
    tell(error.message, true);
  }
}

function download() {
  for (const document of documents) {
    const { name } = document;
    const link = make("a", { href: URL.createObjectURL(new Blob([fileText(document)], { type: "text/plain" })), download: name.split("/").pop() });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}

async function format() {
  const document = documents[current], { version } = document;
  const edits = await request(document, "formatting", { options: { tabSize: 4, insertSpaces: true } });
  if (edits?.length) applyTo(document, version, { [document.uri]: edits });
  else tell(document.diagnostics.length ? "a text with errors stays as it is" : "it is in this form already");
}

async function openFile(event) {
  const [file] = event.target.files;
  if (!file) return;
  const text = await file.text();
  const editor = documents[current].editor;
  editor.replace(0, editor.text.length, text);
  event.target.value = "";
}

// ------------------------------------------------------------------------------------ the page

export async function openProblem(information, changeSeen) {
  opened = information;
  onChange = changeSeen;
  byId("name").textContent = opened.name;
  document.title = `${opened.name}: rddl studio`;
  addDocument(opened.domain_name, opened.domain);
  if (opened.instance_name) addDocument(opened.instance_name, opened.instance);
  const own = readDraft(draftKey(tab));
  if (own) setTexts(own);
  else await offerEarlierDraft();
  showDocument(0);
  byId("save").hidden = !opened.can_save;
  byId("save").addEventListener("click", () => save(byId("save").textContent !== "Save"));
  byId("download").addEventListener("click", download);
  byId("format").addEventListener("click", () => format().catch((error) => tell(error.message, true)));
  byId("file").addEventListener("change", openFile);
  byId("edit").addEventListener("keydown", (event) => {
    const actions = { F8: nextProblem, ".": event.ctrlKey && repairHere };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key !== "s") return;
    event.preventDefault();
    save();
  });
  addEventListener("pagehide", keepDraft);
  addEventListener("beforeunload", (event) => { if (!draftIsKept) event.preventDefault(); });
  check();
}
