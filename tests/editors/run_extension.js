// Runs the extension with as much of an editor as it uses: run_extension.js EXTENSION_FOLDER RDDL
'use strict';

const assert = require('assert');
const { execFileSync } = require('child_process');
const fs = require('fs');
const Module = require('module');
const os = require('os');
const path = require('path');

const [folder, rddl] = process.argv.slice(2);
const registered = {};
const messages = [];
const editor = {
  workspace: { getConfiguration: () => ({ get: (name) => ({ path: rddl, standard: 'pyrddlgym' })[name] }) },
  languages: { registerDocumentFormattingEditProvider: (language, provider) => { registered[language] = provider; } },
  tasks: { registerTaskProvider: (type, provider) => { registered.tasks = provider; } },
  window: { showErrorMessage: (message) => messages.push(message), activeTextEditor: undefined },
  Range: class { constructor(from, to) { Object.assign(this, { from, to }); } },
  TextEdit: { replace: (range, text) => ({ range, text }) },
  ProcessExecution: class { constructor(process, args) { Object.assign(this, { process, args }); } },
  Task: class { constructor(...parts) { [this.definition, this.scope, this.name, , this.execution, this.matcher] = parts; } },
  TaskScope: { Workspace: 2 },
};
const load = Module._load;
Module._load = (name, ...rest) => (name === 'vscode' ? editor : load(name, ...rest));

const document = (text) => ({ getText: () => text, positionAt: (offset) => offset });

async function main() {
  require(folder).activate({ subscriptions: [] });
  const untidy = 'non-fluents n {domain=d;}';
  const [edit] = await registered.rddl.provideDocumentFormattingEdits(document(untidy));
  assert.strictEqual(edit.text, execFileSync(rddl, ['fmt', '-'], { input: untidy }).toString());
  assert.notStrictEqual(edit.text, untidy);
  assert.deepStrictEqual({ ...edit.range }, { from: 0, to: untidy.length });

  assert.deepStrictEqual(await registered.rddl.provideDocumentFormattingEdits(document('domain {')), []);
  assert.match(messages[0], /^rddl fmt: <stdin>:1:8: error: /);

  assert.deepStrictEqual(registered.tasks.provideTasks(), []);
  const problem = fs.mkdtempSync(path.join(os.tmpdir(), 'rddl-'));
  editor.window.activeTextEditor = { document: { languageId: 'rddl', uri: { fsPath: path.join(problem, 'domain.rddl') } } };
  const [task] = registered.tasks.provideTasks();
  assert.deepStrictEqual(task.execution.args, ['check', '--verbose', '--std', 'pyrddlgym', problem]);
  assert.strictEqual(task.matcher, '$rddl');
  const resolved = registered.tasks.resolveTask({ definition: { type: 'rddl', problem: ['a.rddl', 'b.rddl'] } });
  assert.deepStrictEqual(resolved.execution.args.slice(4), ['a.rddl', 'b.rddl']);
  fs.rmdirSync(problem);
  console.log('ok');
}

main().catch((error) => { console.log(error); process.exit(1); });
