// What the editor asks of `rddl lsp`, in the words of both: VS Code's classes and the protocol's JSON.
'use strict';

const vscode = require('vscode');

const toPosition = (position) => new vscode.Position(position.line, position.character);
const toRange = (range) => new vscode.Range(toPosition(range.start), toPosition(range.end));
const toLocation = (location) => new vscode.Location(vscode.Uri.parse(location.uri), toRange(location.range));
const fromPosition = (position) => ({ line: position.line, character: position.character });
const fromRange = (range) => ({ start: fromPosition(range.start), end: fromPosition(range.end) });
const named = (document) => ({ textDocument: { uri: document.uri.toString() } });
const at = (document, position) => ({ ...named(document), position: fromPosition(position) });

// The protocol counts kinds from 1, the editor from 0.
const kind = (number) => number - 1;

function toDiagnostic(found) {
  const diagnostic = new vscode.Diagnostic(toRange(found.range), found.message, found.severity - 1);
  diagnostic.code = found.code;
  diagnostic.source = found.source;
  diagnostic.relatedInformation = (found.relatedInformation || []).map(
    (each) => new vscode.DiagnosticRelatedInformation(toLocation(each.location), each.message));
  return diagnostic;
}

function toWorkspaceEdit(edit) {
  const result = new vscode.WorkspaceEdit();
  for (const [uri, edits] of Object.entries(edit.changes)) {
    for (const each of edits) result.replace(vscode.Uri.parse(uri), toRange(each.range), each.newText);
  }
  return result;
}

function toCompletion(item) {
  const completion = new vscode.CompletionItem(item.label, kind(item.kind));
  const text = item.textEdit.newText;
  completion.insertText = item.insertTextFormat === 2 ? new vscode.SnippetString(text) : text;
  completion.range = toRange(item.textEdit.range);
  completion.detail = item.detail;
  if (item.documentation) completion.documentation = new vscode.MarkdownString(item.documentation.value);
  return completion;
}

function toSymbol(found) {
  const symbol = new vscode.DocumentSymbol(found.name, '', kind(found.kind), toRange(found.range), toRange(found.selectionRange));
  symbol.children = found.children.map(toSymbol);
  return symbol;
}

function toAction(found) {
  const action = new vscode.CodeAction(found.title, vscode.CodeActionKind.Empty.append(found.kind));
  action.edit = toWorkspaceEdit(found.edit);
  action.isPreferred = found.isPreferred;
  action.diagnostics = (found.diagnostics || []).map(toDiagnostic);
  return action;
}

// Registers all providers; `ask` sends a request and gives its result, or null if the server is gone.
function register(ask) {
  const { languages } = vscode;
  const list = (found, convert) => (found || []).map(convert);
  return [
    languages.registerHoverProvider('rddl', {
      async provideHover(document, position, token) {
        const found = await ask('textDocument/hover', at(document, position), token);
        return found && new vscode.Hover(new vscode.MarkdownString(found.contents.value), found.range && toRange(found.range));
      },
    }),
    languages.registerDefinitionProvider('rddl', {
      async provideDefinition(document, position, token) {
        return list(await ask('textDocument/definition', at(document, position), token), toLocation);
      },
    }),
    languages.registerReferenceProvider('rddl', {
      async provideReferences(document, position, context, token) {
        return list(await ask('textDocument/references', { ...at(document, position), context }, token), toLocation);
      },
    }),
    languages.registerDocumentHighlightProvider('rddl', {
      async provideDocumentHighlights(document, position, token) {
        return list(await ask('textDocument/documentHighlight', at(document, position), token),
          (each) => new vscode.DocumentHighlight(toRange(each.range)));
      },
    }),
    languages.registerCompletionItemProvider('rddl', {
      async provideCompletionItems(document, position, token) {
        const found = await ask('textDocument/completion', at(document, position), token);
        return found && new vscode.CompletionList(found.items.map(toCompletion), found.isIncomplete);
      },
    }, '?', '@', '('),
    languages.registerRenameProvider('rddl', {
      async prepareRename(document, position, token) {
        const found = await ask('textDocument/prepareRename', at(document, position), token);
        if (!found) throw new Error('only names can be renamed');
        return { range: toRange(found.range), placeholder: found.placeholder };
      },
      async provideRenameEdits(document, position, newName, token) {
        const found = await ask('textDocument/rename', { ...at(document, position), newName }, token, true);
        return found && toWorkspaceEdit(found);
      },
    }),
    languages.registerDocumentSymbolProvider('rddl', {
      async provideDocumentSymbols(document, token) {
        return list(await ask('textDocument/documentSymbol', named(document), token), toSymbol);
      },
    }),
    languages.registerDocumentFormattingEditProvider('rddl', {
      async provideDocumentFormattingEdits(document, options, token) {
        return list(await ask('textDocument/formatting', { ...named(document), options }, token),
          (each) => vscode.TextEdit.replace(toRange(each.range), each.newText));
      },
    }),
    languages.registerCodeActionsProvider('rddl', {
      async provideCodeActions(document, range, context, token) {
        const params = { ...named(document), range: fromRange(range), context: { diagnostics: [] } };
        return list(await ask('textDocument/codeAction', params, token), toAction);
      },
    }),
    languages.registerInlayHintsProvider('rddl', {
      async provideInlayHints(document, range, token) {
        return list(await ask('textDocument/inlayHint', { ...named(document), range: fromRange(range) }, token), (each) => {
          const hint = new vscode.InlayHint(toPosition(each.position), each.label);
          hint.paddingLeft = true;
          return hint;
        });
      },
    }),
  ];
}

module.exports = { register, toDiagnostic, fromRange };
