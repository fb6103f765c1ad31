// A text area that lies over the same text in colours. What one types, selects and undoes is the
// browser's own; the layers below draw only the lines that are seen.
import { make } from "./server.js";
import { wordsOf } from "./words.js";

const linesAround = 20;

export class Editor {
  // `onInput` is called after each change of the text, `onMove` where the cursor may have moved.
  constructor(label, { onInput, onMove, complete }) {
    this.complete = complete;
    this.onInput = onInput;
    this.diagnostics = [];
    this.gutter = make("div", { className: "gutter" });
    this.words = make("pre", { className: "layer words" });
    this.marks = make("pre", { className: "layer marks" });
    for (const layer of [this.gutter, this.words, this.marks]) layer.setAttribute("aria-hidden", "true");
    this.area = make("textarea", { spellcheck: false, autocapitalize: "off", autocomplete: "off", wrap: "off" });
    this.area.setAttribute("aria-label", label);
    this.list = make("ul", { className: "completions", hidden: true });
    this.list.setAttribute("role", "listbox");
    this.list.setAttribute("aria-label", "Completions");
    this.code = make("div", { className: "code" }, this.words, this.marks, this.area, this.list);
    this.root = make("div", { className: "editor" }, this.gutter, this.code);
    this.area.addEventListener("input", () => this.changed());
    this.area.addEventListener("scroll", () => this.draw());
    this.area.addEventListener("keydown", (event) => this.press(event));
    this.area.addEventListener("blur", () => setTimeout(() => this.close(), 200));
    for (const event of ["keyup", "click"]) this.area.addEventListener(event, onMove);
    new ResizeObserver(() => this.draw()).observe(this.area);
    this.lines = [""];
  }

  get text() {
    return this.area.value;
  }
  // Forgets what could be undone: for another text.
  set text(text) {
    this.area.value = text;
    this.changed(false);
  }

  // As if it was typed, so that it can be undone.
  replace(begin, end, text) {
    this.area.focus();
    this.area.setSelectionRange(begin, end);
    const isDone = text === "" ? begin === end || document.execCommand("delete")
      : document.execCommand("insertText", false, text);
    if (isDone) return;
    this.area.setRangeText(text, begin, end, "end");
    this.changed();
  }

  changed(byUser = true) {
    this.lines = this.area.value.split("\n");
    this.begins = null;
    this.draw();
    if (!byUser) return;
    this.onInput();
    this.offer();
  }

  show(diagnostics) {
    this.diagnostics = diagnostics;
    this.draw();
  }

  // Positions of the Language Server Protocol.
  offsetOf({ line, character }) {
    if (!this.begins) {
      let begin = 0;
      this.begins = this.lines.map((text) => { const here = begin; begin += text.length + 1; return here; });
    }
    if (line >= this.begins.length) return this.area.value.length;
    return this.begins[line] + Math.min(character, this.lines[line].length);
  }
  position(offset = this.area.selectionStart) {
    const before = this.area.value.slice(0, offset);
    const line = before.split("\n").length - 1;
    return { line, character: offset - before.lastIndexOf("\n") - 1 };
  }

  goTo(position) {
    const offset = this.offsetOf(position);
    this.area.focus();
    this.area.setSelectionRange(offset, offset);
    this.area.scrollTop = Math.max(0, position.line * this.lineHeight() - this.area.clientHeight / 3);
    const x = position.character * this.charWidth();
    this.area.scrollLeft = x < this.area.clientWidth * 0.7 ? 0 : x - this.area.clientWidth / 2;
    this.draw();
  }

  lineHeight() {
    return parseFloat(getComputedStyle(this.area).lineHeight);
  }

  // ---- the layers

  draw() {
    const height = this.lineHeight();
    if (!height || !this.area.clientHeight) return;
    const top = this.area.scrollTop, left = this.area.scrollLeft;
    const first = Math.max(0, Math.floor(top / height) - linesAround);
    const last = Math.min(this.lines.length, Math.ceil((top + this.area.clientHeight) / height) + linesAround);
    const words = document.createDocumentFragment(), marks = document.createDocumentFragment();
    const numbers = document.createDocumentFragment();
    for (let line = first; line < last; ++line) {
      const text = this.lines[line];
      spans(words, text, wordsOf(text));
      const found = this.marksOf(line);
      spans(marks, text || " ", found);
      const worst = found.some((mark) => mark.kind === "error") ? "error" : found.length ? "warning" : "";
      numbers.append(make("div", { textContent: line + 1, className: worst }));
    }
    this.words.replaceChildren(words);
    this.marks.replaceChildren(marks);
    this.gutter.replaceChildren(make("div", { className: "numbers" }, numbers));
    const y = first * height - top;
    // Styles set by script are no inline styles for the policy of the page.
    for (const layer of [this.words, this.marks]) layer.style.transform = `translate(${-left}px, ${y}px)`;
    this.gutter.firstChild.style.transform = `translateY(${y}px)`;
  }

  marksOf(line) {
    const length = this.lines[line].length;
    return this.diagnostics.filter(({ range }) => range.start.line <= line && line <= range.end.line)
      .map(({ range, severity }) => {
        const begin = Math.min(range.start.line === line ? range.start.character : 0, Math.max(length - 1, 0));
        const end = range.end.line === line ? range.end.character : length;
        return { begin, end: Math.max(end, begin + 1), kind: severity === 1 ? "error" : "warning" };
      })
      .sort((a, b) => a.begin - b.begin);
  }

  // ---- completion

  async offer(always = false) {
    const before = this.lines[this.position().line].slice(0, this.position().character);
    if (!always && !/[\w?@$(-]$/.test(before)) return this.close();
    if (/\/\//.test(before)) return this.close();
    const number = this.offered = (this.offered ?? 0) + 1;
    const answer = await this.complete(this.position());
    const items = answer.items ?? answer;
    if (number !== this.offered || document.activeElement !== this.area) return;
    const typed = before.match(/[\w?@$-]*$/)[0];
    const wanted = typed.replace(/^[?@$]/, "").toLowerCase();
    this.items = items.filter((item) => item.label.replace(/^[?@$]/, "").toLowerCase().startsWith(wanted)).slice(0, 50);
    const isWhole = this.items.length === 1 && this.items[0].label === typed;
    if (this.items.length === 0 || isWhole || (!always && typed === "")) return this.close();
    this.choose(0);
  }

  choose(number) {
    this.chosen = (number + this.items.length) % this.items.length;
    this.list.replaceChildren(...this.items.map((item, k) => {
      const row = make("li", {}, make("span", { textContent: item.label }),
        make("small", { textContent: item.detail ?? "" }));
      row.setAttribute("role", "option");
      row.setAttribute("aria-selected", String(k === this.chosen));
      row.addEventListener("mousedown", (event) => { event.preventDefault(); this.chosen = k; this.accept(); });
      return row;
    }));
    this.list.hidden = false;
    const { line, character } = this.position();
    const width = this.charWidth();
    const x = character * width - this.area.scrollLeft, y = (line + 1) * this.lineHeight() - this.area.scrollTop;
    this.list.style.left = `${Math.max(0, Math.min(x, this.code.clientWidth - this.list.offsetWidth))}px`;
    this.list.style.top = `${y + 6}px`;
    this.list.children[this.chosen].scrollIntoView({ block: "nearest" });
  }

  charWidth() {
    const pen = document.createElement("canvas").getContext("2d");
    pen.font = getComputedStyle(this.area).font;
    return pen.measureText("m").width;
  }

  close() {
    this.list.hidden = true;
    this.offered = (this.offered ?? 0) + 1;
  }

  accept() {
    const item = this.items[this.chosen];
    this.close();
    const { range, newText } = item.textEdit;
    // Places to fill in are marked by "$1" and "${1:word}".
    const mark = newText.search(/\$(\d|\{)/);
    const plain = newText.replace(/\$\{\d+:?([^}]*)\}/g, "$1").replace(/\$\d/g, "");
    const begin = this.offsetOf(range.start);
    this.replace(begin, Math.max(this.offsetOf(range.end), this.area.selectionStart), plain);
    const cursor = begin + (mark < 0 || item.insertTextFormat !== 2 ? plain.length : mark);
    this.area.setSelectionRange(cursor, cursor);
    this.close();
  }

  press(event) {
    if (!this.list.hidden) {
      const moves = { ArrowDown: 1, ArrowUp: -1 };
      if (moves[event.key]) this.choose(this.chosen + moves[event.key]);
      else if (event.key === "Enter" || event.key === "Tab") this.accept();
      else if (event.key === "Escape") this.close();
      else return;
      event.preventDefault();
      event.stopPropagation();
    } else if (event.key === " " && event.ctrlKey) {
      event.preventDefault();
      this.offer(true);
    } else if (event.key === "Enter" && !event.ctrlKey && !event.metaKey) {
      // The next line begins as this one.
      const { line, character } = this.position();
      const blanks = this.lines[line].match(/^[ \t]*/)[0].slice(0, character);
      const opens = /\{\s*$/.test(this.lines[line].slice(0, character)) ? "    " : "";
      event.preventDefault();
      this.replace(this.area.selectionStart, this.area.selectionEnd, `\n${blanks}${opens}`);
    }
  }
}

// Appends the text of a line with its spans, which may overlap: the first one counts then.
function spans(to, text, found) {
  let at = 0;
  for (const { begin, end, kind } of found) {
    if (begin < at) continue;
    to.append(text.slice(at, begin), make("span", { className: kind, textContent: text.slice(begin, end) }));
    at = end;
  }
  to.append(text.slice(at), "\n");
}
