// The words of RDDL in colours. A line is enough: comments end with it.

const pieces = /(\/\/.*)|(\?[A-Za-z][\w-]*)|(@[A-Za-z][\w-]*|\$[A-Za-z][\w-]*)|(\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)|([A-Za-z](?:[\w-]*\w)?'?)/g;
const kinds = ["comment", "variable", "value", "number", "word"];
const types = new Set(["bool", "int", "real", "object", "true", "false"]);
const keywords = new Set(["if", "then", "else", "switch", "case", "default", "forall", "exists"]);

export function setWords(words) {
  for (const word of words) keywords.add(word);
}

// [{begin, end, kind}] of a line.
export function wordsOf(line) {
  const found = [];
  for (const match of line.matchAll(pieces)) {
    const text = match[0];
    let kind = kinds[match.slice(1).findIndex((part) => part !== undefined)];
    if (kind === "word") {
      const isReduction = /^(sum|prod|avg|min|max|forall|exists|argmin|argmax|det)_$/.test(text + line[match.index + text.length]);
      kind = types.has(text) ? "type" : keywords.has(text) || isReduction ? "keyword"
        : /^[A-Z][a-z]/.test(text) && line[match.index + text.length] === "(" ? "draw" : "";
    }
    if (kind) found.push({ begin: match.index, end: match.index + text.length, kind });
  }
  return found;
}
