// Formats RDDL by `rddl fmt` and checks problems by `rddl check`. Highlighting needs no code: package.json.
'use strict';

const { execFile } = require('child_process');
const path = require('path');
const vscode = require('vscode');

const standard = () => vscode.workspace.getConfiguration('rddl').get('standard');
const program = () => vscode.workspace.getConfiguration('rddl').get('path');

// The text as `rddl fmt` lays it out; rejects with what rddl says about a text that is no RDDL.
function formatted(text) {
  return new Promise((resolve, reject) => {
    const child = execFile(program(), ['fmt', '--std', standard(), '-'], { maxBuffer: 1 << 28 },
      (error, output, complaint) => (error ? reject(new Error(complaint || error.message)) : resolve(output)));
    child.stdin.on('error', () => {}); // it ended before it read all: the callback tells why
    child.stdin.end(text);
  });
}

const formatter = {
  async provideDocumentFormattingEdits(document) {
    const text = document.getText();
    try {
      const whole = new vscode.Range(document.positionAt(0), document.positionAt(text.length));
      return [vscode.TextEdit.replace(whole, await formatted(text))];
    } catch (error) {
      vscode.window.showErrorMessage(`rddl fmt: ${error.message.split('\n')[0]}`);
      return [];
    }
  },
};

function check(definition, scope) {
  const words = ['check', '--verbose', '--std', standard(), ...definition.problem]; // warnings, too
  const execution = new vscode.ProcessExecution(program(), words);
  return new vscode.Task(definition, scope, `check ${definition.problem.join(' ')}`, 'rddl', execution, '$rddl');
}

const checks = {
  // One task: the folder of the file that is open, which holds a domain.rddl and its instances.
  provideTasks() {
    const editor = vscode.window.activeTextEditor;
    if (!editor || editor.document.languageId !== 'rddl') return [];
    const folder = path.dirname(editor.document.uri.fsPath);
    return [check({ type: 'rddl', problem: [folder] }, vscode.TaskScope.Workspace)];
  },
  // Tasks of tasks.json.
  resolveTask(task) {
    return check(task.definition, task.scope || vscode.TaskScope.Workspace);
  },
};

exports.activate = (context) => {
  context.subscriptions.push(
    vscode.languages.registerDocumentFormattingEditProvider('rddl', formatter),
    vscode.tasks.registerTaskProvider('rddl', checks));
};
