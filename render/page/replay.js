"use strict";
// The episode, or two of them side by side: runs[r].frames[k] is what is shown at place k of the
// scrubber. A run that is shorter stays at its end.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

const places = Math.max(...data.runs.map((run) => run.frames.length));
const frameOf = (run, place) => run.frames[Math.min(place, run.frames.length - 1)];
const mostRows = 500;  // of the table at once; the filter finds the others
let place = 0;
let timer = null;

// ---- numbers and texts

function shown(value) {
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value)) return String(value);
  return String(Number(value.toPrecision(5)));
}
// For charts: bools are 0 and 1, objects their place in the order of first appearance.
function numberOf(value, words) {
  if (typeof value === "number") return value;
  if (typeof value === "boolean") return value ? 1 : 0;
  if (value === "nan") return NaN;
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  if (!words.includes(value)) words.push(value);
  return words.indexOf(value);
}

// ---- the pictures

const figures = data.runs.map((run, r) => {
  const picture = make("img", { alt: "", width: data.width, height: data.height });
  const caption = make("figcaption");
  byId("runs").append(make("figure", { className: `run-${r}` }, picture, caption));
  return { run, picture, caption };
});

function showPictures() {
  for (const { run, picture, caption } of figures) {
    const frame = frameOf(run, place);
    picture.src = "data:image/png;base64," + frame.picture;
    picture.alt = `${run.name}, step ${frame.step}`;
    const end = frame.end ? `ended: ${frame.end}` : `action: ${frame.action}`;
    caption.replaceChildren(
      make("span", { className: "name", textContent: run.name }),
      ` · step ${frame.step} · return ${shown(frame.total)}` +
        (frame.acts ? ` · reward ${shown(frame.reward)}` : "") + " · ",
      make("span", { className: "action", textContent: end }));
  }
}

// ---- the table

const rows = data.names.map((name, v) => {
  const pick = make("button", { type: "button", textContent: name, title: "Show as a chart" });
  pick.addEventListener("click", () => toggleChart(v));
  const cells = data.runs.map(() => make("td"));
  return { name, pick, cells, line: make("tr", {}, make("th", { scope: "row" }, pick), ...cells) };
});
byId("heads").append(make("th", { textContent: "name" }),
  ...data.runs.map((run) => make("th", { textContent: data.runs.length > 1 ? run.name : "value" })));

function listRows() {
  const wanted = byId("filter").value.toLowerCase();
  const found = rows.filter((row) => row.name.toLowerCase().includes(wanted));
  byId("values").replaceChildren(...found.slice(0, mostRows).map((row) => row.line));
  byId("more").textContent = found.length > mostRows ? `and ${found.length - mostRows} more: filter by name` : "";
}

function showValues() {
  data.runs.forEach((run, r) => {
    const now = frameOf(run, place).values;
    const before = frameOf(run, Math.max(place - 1, 0)).values;
    rows.forEach((row, v) => {
      row.cells[r].textContent = shown(now[v]);
      row.cells[r].classList.toggle("changed", place < run.frames.length && now[v] !== before[v]);
    });
  });
}

// ---- the charts

// Each: a title, and the number of a run's frame.
const charts = [
  { title: "reward", number: (frame) => (frame.acts ? frame.reward : NaN) },
  { title: "return", number: (frame) => frame.total },
];

function toggleChart(v) {
  const at = charts.findIndex((chart) => chart.value === v);
  if (at >= 0) {
    charts.splice(at, 1)[0].box.remove();
  } else {
    const words = [];
    addChart({ title: data.names[v], value: v, number: (frame) => numberOf(frame.values[v], words), words });
  }
  rows[v].pick.setAttribute("aria-pressed", String(at < 0));
  drawCharts();
}

function addChart(chart) {
  if (!charts.includes(chart)) charts.push(chart);
  chart.canvas = make("canvas");
  chart.box = make("div", {}, make("p", { className: "key", textContent: chart.title }), chart.canvas);
  chart.canvas.setAttribute("role", "img");
  byId("charts").append(chart.box);
  const go = (event) => {
    const box = chart.canvas.getBoundingClientRect();
    const part = (event.clientX - box.left - chart.left) / (box.width - chart.left - 6);
    moveTo(Math.round(part * (places - 1)));
  };
  chart.canvas.addEventListener("pointerdown", (event) => {
    stop();
    chart.canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  chart.canvas.addEventListener("pointermove", (event) => event.buttons && go(event));
  measureChart(chart);
}

const chartFont = "11px system-ui, sans-serif";

// Its numbers, their limits, and the room that the names of these take: none of it changes.
function measureChart(chart) {
  chart.lines = data.runs.map((run) => run.frames.map(chart.number));
  const finite = chart.lines.flat().filter(Number.isFinite);
  let low = Math.min(...finite), high = Math.max(...finite);
  if (finite.length === 0) [low, high] = [0, 1];
  if (low === high) [low, high] = [low - 0.5, high + 0.5];
  const name = (number) => (chart.words && chart.words.length ? chart.words[Math.round(number)] ?? "" : shown(number));
  chart.limits = [low, high].map((number) => ({ number, name: name(number) }));
  const pen = chart.canvas.getContext("2d");
  pen.font = chartFont;
  chart.room = Math.max(20, ...chart.limits.map((limit) => pen.measureText(limit.name).width)) + 8;
}

// One below the other, so a step is at the same place in all.
function drawCharts() {
  const room = Math.max(...charts.map((chart) => chart.room));
  for (const chart of charts) drawChart(chart, room);
}

function drawChart(chart, room) {
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(name).trim();
  const width = chart.canvas.clientWidth || 300, height = 96, ratio = window.devicePixelRatio || 1;
  chart.canvas.width = width * ratio;
  chart.canvas.height = height * ratio;
  chart.canvas.style.height = height + "px";
  const pen = chart.canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = chartFont;
  const [low, high] = chart.limits.map((limit) => limit.number);
  chart.left = Math.min(room, width / 3);
  const x = (k) => chart.left + ((width - chart.left - 6) * k) / Math.max(places - 1, 1);
  const y = (number) => height - 8 - ((height - 18) * (number - low)) / (high - low);
  pen.strokeStyle = color("--rule");
  pen.fillStyle = color("--muted");
  for (const { number, name } of chart.limits) {
    pen.beginPath();
    pen.moveTo(chart.left, y(number));
    pen.lineTo(width - 6, y(number));
    pen.stroke();
    pen.fillText(name, 0, y(number) + 4, chart.left - 4);
  }
  chart.lines.forEach((line, r) => {
    pen.strokeStyle = color(r ? "--second" : "--first");
    pen.lineWidth = 1.8;
    pen.setLineDash(r ? [6, 3] : []);
    pen.beginPath();
    let drawn = false;
    line.forEach((number, k) => {
      if (!Number.isFinite(number)) drawn = false;
      else if (drawn) pen.lineTo(x(k), y(number));
      else { pen.moveTo(x(k), y(number)); drawn = true; }
    });
    pen.stroke();
  });
  pen.setLineDash([]);
  pen.strokeStyle = color("--ink");
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(x(place), 4);
  pen.lineTo(x(place), height - 4);
  pen.stroke();
  const told = data.runs.map((run) => shown(chart.number(frameOf(run, place)))).join(" and ");
  chart.canvas.setAttribute("aria-label", `${chart.title}: ${told} at step ${frameOf(data.runs[0], place).step}`);
}

// ---- moving

function show() {
  const longest = data.runs.find((run) => run.frames.length === places);
  byId("scrubber").value = place;
  const step = frameOf(longest, place).step;
  byId("step").textContent = `step ${step} of ${frameOf(longest, places - 1).step}`;
  byId("scrubber").setAttribute("aria-valuetext", `step ${step}`);
  showPictures();
  showValues();
  drawCharts();
}

function moveTo(wanted) {
  place = Math.min(Math.max(wanted, 0), places - 1);
  show();
}

function stop() {
  clearInterval(timer);
  timer = null;
  byId("play").textContent = "▶ play";
  byId("play").setAttribute("aria-label", "Play");
  byId("play").setAttribute("aria-pressed", "false");
}

function play() {
  if (place === places - 1) place = 0;
  clearInterval(timer);
  timer = setInterval(() => {
    if (place === places - 1) stop();
    else moveTo(place + 1);
  }, 1000 / data.framesPerSecond / Number(byId("speed").value));
  byId("play").textContent = "❚❚ stop";
  byId("play").setAttribute("aria-label", "Stop");
  byId("play").setAttribute("aria-pressed", "true");
}

const moves = {
  ArrowLeft: () => moveTo(place - 1), ArrowRight: () => moveTo(place + 1),
  PageUp: () => moveTo(place - 10), PageDown: () => moveTo(place + 10),
  Home: () => moveTo(0), End: () => moveTo(places - 1),
};

function press(event) {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const target = event.target;
  if (target.tagName === "SELECT" || target.type === "search") return;
  // The table scrolls by these keys, and a button is pressed by the space bar.
  if (target.classList?.contains("table") && /Page|Home|End/.test(event.key)) return;
  if (event.key === " " && target.tagName !== "BUTTON") {
    timer ? stop() : play();
  } else if (moves[event.key]) {
    stop();
    moves[event.key]();
  } else {
    return;
  }
  event.preventDefault();
}

byId("scrubber").max = places - 1;
byId("scrubber").addEventListener("input", (event) => { stop(); moveTo(Number(event.target.value)); });
for (const [id, key] of [["first", "Home"], ["back", "ArrowLeft"], ["on", "ArrowRight"], ["last", "End"]])
  byId(id).addEventListener("click", () => { stop(); moves[key](); });
byId("play").addEventListener("click", () => (timer ? stop() : play()));
byId("speed").addEventListener("change", () => timer && play());
byId("filter").addEventListener("input", listRows);
byId("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const isDark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = isDark ? "light" : "dark";
  drawCharts();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawCharts());
document.addEventListener("keydown", press);
addEventListener("resize", () => drawCharts());

byId("about").textContent = data.about;
listRows();
charts.slice().forEach(addChart);
// Two of the first numbers that move, so that there is something to see.
data.names.map((name, v) => v)
  .filter((v) => data.runs[0].frames.some((frame) => frame.values[v] !== data.runs[0].frames[0].values[v]))
  .slice(0, 2).forEach(toggleChart);
show();
