// Runs the extension with as much of an editor as it uses: run_extension.js EXTENSION_FOLDER RDDL
'use strict';

const assert = require('assert');
const fs = require('fs');
const Module = require('module');
const os = require('os');
const path = require('path');

const [folder, rddl] = process.argv.slice(2);
const settings = { path: rddl, standard: 'pyrddlgym' };
const providers = {};
const events = {};
const messages = [];
const collected = new Map();
const record = (...names) => class { constructor(...values) { names.forEach((name, index) => { this[name] = values[index]; }); } };
const on = (name) => (handler) => { events[name] = handler; return {}; };
const provide = (name) => (language, provider) => { providers[name] = provider; return {}; };

const vscode = {
  workspace: {
    getConfiguration: () => ({ get: (name) => settings[name] }),
    textDocuments: [],
    onDidOpenTextDocument: on('open'),
    onDidChangeTextDocument: on('change'),
    onDidCloseTextDocument: on('close'),
    onDidChangeConfiguration: on('configuration'),
    createFileSystemWatcher: () => ({ onDidChange: on('file'), onDidCreate: on('file'), onDidDelete: on('file') }),
  },
  languages: {
    createDiagnosticCollection: () => ({ set: (uri, found) => collected.set(uri.toString(), found), clear: () => collected.clear() }),
    registerHoverProvider: provide('hover'),
    registerDefinitionProvider: provide('definition'),
    registerReferenceProvider: provide('references'),
    registerDocumentHighlightProvider: provide('highlights'),
    registerCompletionItemProvider: provide('completion'),
    registerRenameProvider: provide('rename'),
    registerDocumentSymbolProvider: provide('symbols'),
    registerDocumentFormattingEditProvider: provide('formatting'),
    registerCodeActionsProvider: provide('actions'),
    registerInlayHintsProvider: provide('hints'),
  },
  tasks: { registerTaskProvider: (type, provider) => { providers.tasks = provider; } },
  window: { showErrorMessage: (message) => messages.push(message), activeTextEditor: undefined },
  Uri: { parse: (text) => ({ toString: () => text, fsPath: text.replace('file://', '') }) },
  Position: record('line', 'character'),
  Range: record('start', 'end'),
  Location: record('uri', 'range'),
  Diagnostic: record('range', 'message', 'severity'),
  DiagnosticRelatedInformation: record('location', 'message'),
  WorkspaceEdit: class { constructor() { this.edits = []; } replace(uri, range, text) { this.edits.push({ uri: uri.toString(), range, text }); } },
  CompletionItem: record('label', 'kind'),
  CompletionList: record('items', 'isIncomplete'),
  SnippetString: record('value'),
  MarkdownString: record('value'),
  Hover: record('contents', 'range'),
  DocumentHighlight: record('range'),
  DocumentSymbol: record('name', 'detail', 'kind', 'range', 'selectionRange'),
  CodeAction: record('title', 'kind'),
  CodeActionKind: { Empty: { append: (value) => ({ value }) } },
  InlayHint: record('position', 'label'),
  TextEdit: { replace: (range, text) => ({ range, text }) },
  ProcessExecution: record('process', 'args'),
  Task: record('definition', 'scope', 'name', 'source', 'execution', 'matcher'),
  TaskScope: { Workspace: 2 },
};
const load = Module._load;
Module._load = (name, ...rest) => (name === 'vscode' ? vscode : load(name, ...rest));

const problem = fs.mkdtempSync(path.join(os.tmpdir(), 'rddl-'));
function document(name, text) {
  const uri = vscode.Uri.parse(`file://${problem}/${name}`);
  return { languageId: 'rddl', uri, version: 1, getText: () => text };
}
const whole = new vscode.Range(new vscode.Position(0, 0), new vscode.Position(99, 0));
function place(text, words) {
  const before = text.slice(0, text.indexOf(words)).split('\n');
  return new vscode.Position(before.length - 1, before[before.length - 1].length);
}
async function until(what, condition) {
  for (let round = 0; round < 3000; ++round) {
    if (condition()) return;
    await new Promise((resolve) => { setTimeout(resolve, 20); });
  }
  throw new Error(`no ${what}`);
}

const text = `domain d {
    types { t : object; };
    pvariables { p(t) : { state-fluent, bool, default = false }; a(t) : { action-fluent, bool, default = false }; };
    cpfs { p'(?x) = p(?x) | aa(?x); };
    reward = sum_{?x : t} p(?x);
}
non-fluents n { domain = d; objects { t : {o1, o2}; }; }
instance i { domain = d; non-fluents = n; horizon = 1; discount = 1.0; }
`;

async function main() {
  const file = document('both.rddl', text);
  vscode.workspace.textDocuments = [file];
  const extension = require(folder);
  extension.activate({ subscriptions: [] });
  const shown = () => collected.get(file.uri.toString());
  await until('diagnostics', () => shown() && shown().length > 0);
  assert.deepStrictEqual(shown().map((each) => [each.code, each.severity, each.range.start.line]), [['E0201', 0, 3]]);

  const [action] = await providers.actions.provideCodeActions(file, shown()[0].range);
  assert.strictEqual(action.title, "Replace 'aa' by 'a'");
  const [edit] = action.edit.edits;
  assert.strictEqual(edit.text, 'a');
  file.version = 2;
  events.change({ document: file, contentChanges: [{ range: edit.range, text: edit.text }] });
  await until('repair', () => shown().length === 0);

  const repaired = text.replace('aa(', 'a(');
  const hover = await providers.hover.provideHover(file, place(repaired, 'p(?x) |'));
  assert.match(hover.contents.value, /state-fluent[^]*2 groundings/);
  const [definition] = await providers.definition.provideDefinition(file, place(repaired, 'p(?x) |'));
  assert.strictEqual(definition.range.start.line, 2);
  assert.strictEqual((await providers.references.provideReferences(file, place(repaired, 'p(?x) |'), { includeDeclaration: true })).length, 4);
  assert.strictEqual((await providers.highlights.provideDocumentHighlights(file, place(repaired, '?x) |'))).length, 3);
  const completion = await providers.completion.provideCompletionItems(file, place(repaired, 'p(?x) |'));
  assert(completion.items.some((each) => each.label === "p'" && each.insertText.value === "p'(${1:?x})"));
  const rename = await providers.rename.provideRenameEdits(file, place(repaired, 'o1'), 'first');
  assert.deepStrictEqual(rename.edits.map((each) => each.text), ['first']);
  await assert.rejects(providers.rename.provideRenameEdits(file, place(repaired, 'o1'), 'if'), /reserved/);
  assert.deepStrictEqual((await providers.symbols.provideDocumentSymbols(file)).map((each) => each.name), ['domain d', 'non-fluents n', 'instance i']);
  assert.strictEqual((await providers.formatting.provideDocumentFormattingEdits(file, {})).length, 1);
  assert.deepStrictEqual((await providers.hints.provideInlayHints(file, whole)).map((each) => each.label), ['2 objects', '2 groundings', '2 groundings']);

  assert.deepStrictEqual(providers.tasks.provideTasks(), []);
  vscode.window.activeTextEditor = { document: file };
  const [task] = providers.tasks.provideTasks();
  assert.deepStrictEqual(task.execution.args, ['check', '--verbose', '--std', 'pyrddlgym', problem]);
  assert.strictEqual(task.matcher, '$rddl');
  const resolved = providers.tasks.resolveTask({ definition: { type: 'rddl', problem: ['a.rddl', 'b.rddl'] } });
  assert.deepStrictEqual(resolved.execution.args.slice(4), ['a.rddl', 'b.rddl']);

  events.close(file);
  settings.path = '/nowhere/rddl';
  await events.configuration({ affectsConfiguration: () => true });
  await until('complaint', () => messages.length > 0);
  assert.match(messages[0], /^rddl lsp \(\/nowhere\/rddl\): .*rddl.path/);
  assert.strictEqual(await providers.hover.provideHover(file, whole.start), null);
  await extension.deactivate();
  fs.rmdirSync(problem);
  console.log('ok');
}

main().catch((error) => { console.log(error); process.exit(1); });
