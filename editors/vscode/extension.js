// Connects the editor to `rddl lsp`, and checks problems by `rddl check` as tasks. Highlighting needs no code: package.json.
'use strict';

const path = require('path');
const vscode = require('vscode');
const { Connection } = require('./connection');
const { register, toDiagnostic, fromRange } = require('./language');

const standard = () => vscode.workspace.getConfiguration('rddl').get('standard');
const program = () => vscode.workspace.getConfiguration('rddl').get('path');

// ------------------------------------------------------------------------------------- the server

let connection; // undefined while no server runs
let diagnostics;
const isRddl = (document) => document.languageId === 'rddl';

function heard(method, params) {
  if (method === 'textDocument/publishDiagnostics')
    diagnostics.set(vscode.Uri.parse(params.uri), params.diagnostics.map(toDiagnostic));
}

function start() {
  const ended = (error) => {
    if (connection !== self) return; // it was stopped
    connection = undefined;
    diagnostics.clear();
    vscode.window.showErrorMessage(`rddl lsp (${program()}): ${error.message}. The setting rddl.path names the program.`);
  };
  const self = new Connection(program(), ['lsp', '--std', standard()], heard, ended);
  connection = self;
  self.request('initialize', { processId: process.pid, rootUri: null, capabilities: {} }).then(() => {
    self.notify('initialized', {});
    vscode.workspace.textDocuments.forEach(open);
  }, () => {}); // the end is reported by `ended`
}

async function stop() {
  const last = connection;
  connection = undefined;
  if (last) await last.stop();
}

// Errors are shown for what the user asked for by hand alone.
async function ask(method, params, token, isByHand = false) {
  if (!connection) return null;
  try {
    return await connection.request(method, params, token);
  } catch (error) {
    if (isByHand) throw error;
    return null;
  }
}

const identified = (document) => ({ uri: document.uri.toString(), version: document.version });

function open(document) {
  if (!isRddl(document) || !connection) return;
  connection.notify('textDocument/didOpen', {
    textDocument: { ...identified(document), languageId: 'rddl', text: document.getText() },
  });
}

function change({ document, contentChanges }) {
  if (!isRddl(document) || !connection || contentChanges.length === 0) return;
  connection.notify('textDocument/didChange', {
    textDocument: identified(document),
    contentChanges: contentChanges.map((each) => ({ range: fromRange(each.range), text: each.text })),
  });
}

function close(document) {
  if (isRddl(document) && connection) connection.notify('textDocument/didClose', { textDocument: identified(document) });
}

function watch() {
  const watcher = vscode.workspace.createFileSystemWatcher('**/*.rddl');
  const tell = () => connection && connection.notify('workspace/didChangeWatchedFiles', { changes: [] });
  return [watcher, watcher.onDidChange(tell), watcher.onDidCreate(tell), watcher.onDidDelete(tell)];
}

async function restartIfNeeded(event) {
  if (!event.affectsConfiguration('rddl')) return;
  await stop();
  start();
}

// -------------------------------------------------------------------------------------- the tasks

function check(definition, scope) {
  const words = ['check', '--verbose', '--std', standard(), ...definition.problem]; // with warnings
  const execution = new vscode.ProcessExecution(program(), words);
  return new vscode.Task(definition, scope, `check ${definition.problem.join(' ')}`, 'rddl', execution, '$rddl');
}

const checks = {
  // One task: the folder of the file that is open, which holds a domain.rddl and its instances.
  provideTasks() {
    const editor = vscode.window.activeTextEditor;
    if (!editor || !isRddl(editor.document)) return [];
    const folder = path.dirname(editor.document.uri.fsPath);
    return [check({ type: 'rddl', problem: [folder] }, vscode.TaskScope.Workspace)];
  },
  // Tasks of tasks.json.
  resolveTask(task) {
    return check(task.definition, task.scope || vscode.TaskScope.Workspace);
  },
};

exports.activate = (context) => {
  diagnostics = vscode.languages.createDiagnosticCollection('rddl');
  const { workspace } = vscode;
  context.subscriptions.push(
    diagnostics,
    ...register(ask),
    workspace.onDidOpenTextDocument(open),
    workspace.onDidChangeTextDocument(change),
    workspace.onDidCloseTextDocument(close),
    workspace.onDidChangeConfiguration(restartIfNeeded),
    ...watch(),
    vscode.tasks.registerTaskProvider('rddl', checks));
  start();
};

exports.deactivate = stop;
