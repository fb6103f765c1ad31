// An episode as pictures, charts and values, and the controls that move in it. The moments are those
// of the program; what is shown is a place among them.
import { ask, make, poll, shown } from "./server.js";
import { Chart } from "./chart.js";

const mostRows = 300;  // of the table at once; the filter finds the others

const specialNumbers = new Map([["nan", NaN], ["inf", Infinity], ["-inf", -Infinity]]);

// For charts: bools are 0 and 1, objects their place in the order of first appearance.
function numberOf(value, words) {
  if (typeof value === "number") return value;
  if (typeof value === "boolean") return value ? 1 : 0;
  if (specialNumbers.has(value)) return specialNumbers.get(value);
  if (!words.includes(value)) words.push(value);
  return words.indexOf(value);
}

export class Episode {
  // `player`: the name of the episode in this tab.
  constructor(player, { title = "", onShow = () => {}, color = "--first" } = {}) {
    this.player = player;
    this.title = title;
    this.onShow = onShow;
    this.color = color;
    this.moments = [];
    this.dropped = [];  // the moments that others have replaced
    this.branch = 0;
    this.at = 0;
    this.words = new Map();  // for each value that is an object, the objects that it had
    this.charted = null;  // names of values with a chart; null: chosen by the page
    this.picture = make("img", { alt: "", width: 600, height: 400 });
    this.caption = make("figcaption");
    this.figure = make("figure", {}, this.picture, this.caption);
    this.filter = make("input", { type: "search", placeholder: "filter", hidden: true });
    this.filter.setAttribute("aria-label", "Filter values by name");
    this.rows = make("tbody");
    this.more = make("p", { className: "hint" });
    const table = make("div", { className: "table", tabIndex: 0 }, make("table", {},
      make("thead", {}, make("tr", {}, make("th", { textContent: "name" }), make("th", { textContent: "value" }))), this.rows));
    table.setAttribute("role", "region");
    table.setAttribute("aria-label", "Values of the state");
    this.values = make("div", { className: "values" }, this.filter, table, this.more);
    this.charts = make("div", { className: "charts" });
    this.root = make("div", { className: "episode", hidden: true }, this.figure, this.charts, this.values);
    this.filter.addEventListener("input", () => this.showValues());
    this.chartOf = new Map();
    new ResizeObserver(() => this.drawCharts()).observe(this.charts);
  }

  get isThere() {
    return this.moments.length > 0;
  }
  get last() {
    return this.moments.length - 1;
  }
  get isOver() {
    return this.isThere && this.moments[this.last].ended !== undefined;
  }
  get isRunning() {
    return this.run?.state === "running";
  }

  async load(request) {
    const { problem, updates } = await ask("load", { ...request, player: this.player });
    this.begin(problem);
    this.take(updates);
    this.show(0);
  }

  // After a reload of the page: whether there was an episode.
  async resume() {
    const { problem } = await ask("describe", { player: this.player });
    if (!problem) return false;
    this.begin(problem);
    await this.update();
    this.show(this.now);
    return true;
  }

  begin(problem) {
    this.problem = problem;
    Object.assign(this, { moments: [], dropped: [], branch: 0, at: 0, words: new Map(), run: null, charted: null, moving: null });
    this.visualizer = problem.visualizers[0] ?? "";
    this.figure.classList.toggle("without", problem.visualizers.length === 0);
    this.chartOf.clear();
    this.charts.replaceChildren();
  }

  take(updates) {
    if (updates.branch !== this.branch && this.isThere) this.dropped = this.moments;
    if (updates.branch !== this.branch) this.moments = [];
    this.branch = updates.branch;
    this.moments.splice(updates.first, this.moments.length, ...updates.moments);
    this.now = updates.now;
    this.run = updates.run;
    return this.moments.length < updates.count || this.isRunning;
  }

  // Gets what is new. Returns whether more is to come.
  async update() {
    return this.take(await ask("updates", { player: this.player, branch: this.branch, since: this.moments.length }));
  }

  // Waits until what runs has ended. Pictures follow at the speed of the player that calls.
  async follow(onUpdates = () => {}) {
    await poll(async () => {
      const goesOn = await this.update();
      onUpdates();
      return goesOn;
    }, 120);
    if (this.run?.state === "failed") throw new Error(this.run.error);
  }

  async runPolicy(policy, steps) {
    if (this.now !== this.at) await ask("go_to", { player: this.player, step: this.at });
    await ask("run", { player: this.player, policy, ...(steps ? { steps } : {}) });
  }

  // The sentence why the action is illegal, or "".
  async takeAction(action, force) {
    if (this.now !== this.at || this.isRunning) await ask("go_to", { player: this.player, step: this.at });
    const { violation } = await ask("step", { player: this.player, action, force });
    await this.update();
    if (violation) return violation;
    this.show(this.at + 1);
    return "";
  }

  stop() {
    return ask("stop", { player: this.player });
  }

  // ---- what is shown

  show(place) {
    if (!this.isThere) return;
    this.root.hidden = false;
    this.at = Math.min(Math.max(place, 0), this.last);
    this.showCaption();
    this.showPicture();
    this.showValues();
    this.drawCharts();
    this.onShow();
  }

  showCaption() {
    const moment = this.moments[this.at];
    const parts = [this.title, `step ${moment.step}`, `return ${shown(moment.total)}`];
    if (moment.action) parts.push(`reward ${shown(moment.reward)}`, `${moment.by}: ${actionText(moment.action)}`);
    if (moment.ended) parts.push(`ended: ${moment.ended.join(", ")}`);
    this.caption.textContent = parts.filter(Boolean).join(" · ");
    if (moment.warning) this.caption.append(make("div", { className: "warning", textContent: moment.warning }));
    if (moment.fault) this.caption.append(make("div", { className: "error", textContent: moment.fault }));
    this.picture.alt = this.caption.textContent;
  }

  // One request at a time, and the last one wins.
  async showPicture() {
    if (!this.visualizer) return;
    this.wantsPicture = true;
    if (this.getsPicture) return;
    this.getsPicture = true;
    try {
      while (this.wantsPicture) {
        this.wantsPicture = false;
        const at = this.at;
        const wide = Math.min(Math.max(Math.round(this.figure.clientWidth * (devicePixelRatio || 1)), 400), 1200);
        const blob = await ask("picture", { player: this.player, step: at, visualizer: this.visualizer,
          width: wide, height: Math.round((wide * 2) / 3) }, { binary: true });
        const before = this.picture.src;
        this.picture.src = URL.createObjectURL(blob);
        await this.picture.decode().catch(() => {});
        this.picture.dataset.step = at;  // that is seen now
        if (before.startsWith("blob:")) URL.revokeObjectURL(before);
      }
    } catch {  // a moment that was dropped meanwhile, or the program has ended, which is told elsewhere
    } finally {
      this.getsPicture = false;
    }
  }

  showValues() {
    const { state, observation } = this.moments[this.at];
    const before = this.moments[Math.max(this.at - 1, 0)];
    const all = [...entries(state, before.state, ""), ...entries(observation ?? {}, before.observation ?? {}, " (observed)")];
    this.filter.hidden = all.length <= 12;
    const wanted = this.filter.value.toLowerCase();
    const found = wanted ? all.filter(({ name }) => name.toLowerCase().includes(wanted)) : all;
    const shownRows = found.slice(0, mostRows);
    if (this.rowNames?.join() !== shownRows.map(({ name }) => name).join()) {
      this.rowNames = shownRows.map(({ name }) => name);
      this.rows.replaceChildren(...shownRows.map(({ name, key }) => this.row(name, key)));
    }
    shownRows.forEach(({ key, value, isChanged }, k) => {
      const row = this.rows.children[k];
      row.lastChild.textContent = shown(value);
      row.lastChild.classList.toggle("changed", isChanged);
      row.firstChild.firstChild.setAttribute("aria-pressed", String(this.chartedNames().includes(key)));
    });
    const unsent = this.problem.state_count - Object.keys(state).length;
    this.more.textContent = [found.length > mostRows ? `and ${found.length - mostRows} more: filter by name` : "",
      unsent > 0 ? `${unsent} more values of the state are in the picture alone` : ""].filter(Boolean).join("; ");
  }

  row(name, key) {
    const pick = make("button", { type: "button", textContent: name, title: "Show as a chart" });
    pick.addEventListener("click", () => {
      const names = this.chartedNames();
      this.charted = names.includes(key) ? names.filter((each) => each !== key) : [...names, key];
      this.showValues();
      this.drawCharts();
    });
    const head = make("th", {}, pick);
    head.scope = "row";
    return make("tr", {}, head, make("td"));
  }

  // Two of the first values that move, unless the user has chosen.
  chartedNames() {
    if (this.charted) return this.charted;
    if (this.moving && this.last < this.movingUntil) return this.moving;
    this.movingUntil = 2 * this.last + 1;  // a long episode is not searched at each step
    const first = this.moments[0].state;
    const moves = (key) => this.moments.some(({ state }) => state[key] !== first[key]);
    const names = Object.keys(first).slice(0, mostRows);
    const moving = names.filter(moves).slice(0, 2);
    this.moving = moving.length ? moving : names.slice(0, 1);
    return this.moving;
  }

  drawCharts() {
    if (!this.isThere || !this.charts.clientWidth) return;
    const wanted = ["reward", "return", ...this.chartedNames().map((key) => `value ${key}`)];
    for (const [name, chart] of this.chartOf)
      if (!wanted.includes(name)) {
        chart.root.remove();
        this.chartOf.delete(name);
      }
    for (const name of wanted) {
      if (!this.chartOf.has(name)) {
        const chart = new Chart(name.replace("value ", ""), (x) => this.onPick(Math.round(x)));
        this.chartOf.set(name, chart);
        this.charts.append(chart.root);
      }
      this.drawChart(name, this.chartOf.get(name));
    }
  }
  onPick(place) {
    this.show(place);
  }

  drawChart(name, chart) {
    const numbers = {
      reward: (moment) => numberOf(moment.reward ?? "nan", []),
      return: (moment) => numberOf(moment.total, []),
    };
    const key = name.replace("value ", "");
    if (!this.words.has(key)) this.words.set(key, []);
    const words = this.words.get(key);
    const number = numbers[name] ?? ((moment) => numberOf(moment.state[key], words));
    const points = (moments) => moments.map((moment) => [moment.step, number(moment)]);
    const lines = [{ name: "", color: this.color, points: points(this.moments) }];
    if (this.dropped.length) lines.unshift({ name: "before", color: "--muted", dash: 2, faint: true, points: points(this.dropped) });
    chart.draw(lines, this.at, { xTitle: "steps", most: Math.max(this.last, 1) });
  }
}

function entries(values, before, suffix) {
  return Object.entries(values).map(([name, value]) => ({
    name: name + suffix, key: name, value, isChanged: Object.hasOwn(before, name) && before[name] !== value }));
}

function actionText(action) {
  const parts = Object.entries(action).map(([name, value]) => (value === true ? name : `${name} = ${shown(value)}`));
  return parts.length === 0 ? "default action" : parts.slice(0, 6).join(", ") + (parts.length > 6 ? ", …" : "");
}

// Buttons and a slider that move one or more episodes, which are shown at the same step.
export class Transport {
  constructor(episodes) {
    this.episodes = episodes;
    const button = (name, label, act) => {
      const made = make("button", { type: "button", textContent: name, title: label });
      made.setAttribute("aria-label", label);
      made.addEventListener("click", act);
      return made;
    };
    this.slider = make("input", { type: "range", min: 0, max: 0, value: 0 });
    this.slider.setAttribute("aria-label", "Step");
    this.playButton = button("▶", "Play", () => (this.timer ? this.pause() : this.play()));
    this.speed = make("select", {}, ...[2, 5, 10, 25].map((speed) => make("option", { value: speed, textContent: `${speed} steps/s`, selected: speed === 10 })));
    this.speed.setAttribute("aria-label", "Speed");
    this.step = make("output");
    this.pictures = make("select");
    this.pictures.setAttribute("aria-label", "Picture");
    this.root = make("div", { className: "bar transport", hidden: true },
      button("|◀", "First step", () => this.move(0)), button("◀", "Back", () => this.move(this.at - 1)),
      this.playButton, button("▷", "Forward", () => this.move(this.at + 1)), button("▶|", "Last step", () => this.move(this.last)),
      this.slider, this.step, this.speed, this.pictures);
    this.slider.addEventListener("input", () => this.move(Number(this.slider.value)));
    this.speed.addEventListener("change", () => this.timer && this.play());
    this.pictures.addEventListener("change", () => {
      for (const episode of episodes) {
        episode.visualizer = this.pictures.value;
        episode.showPicture();
      }
    });
    for (const episode of episodes) episode.onPick = (place) => this.move(place);
  }

  get last() {
    return Math.max(...this.episodes.map((episode) => episode.last));
  }
  get at() {
    return Number(this.slider.value);
  }

  move(place) {
    this.pause();
    this.show(place);
  }

  show(place) {
    const at = Math.min(Math.max(place, 0), Math.max(this.last, 0));
    this.refresh();
    this.slider.value = at;
    for (const episode of this.episodes) if (episode.isThere) episode.show(Math.min(at, episode.last));
    this.tell();
  }

  tell() {
    this.step.textContent = `step ${this.at} of ${Math.max(this.last, 0)}`;
    this.slider.setAttribute("aria-valuetext", this.step.textContent);
  }

  // The controls as the episodes are now.
  refresh() {
    const first = this.episodes.find((episode) => episode.isThere);
    this.root.hidden = !first;
    if (!first) return;
    this.slider.max = Math.max(this.last, 0);
    const names = first.problem.visualizers;
    if ([...this.pictures.options].map((option) => option.value).join() !== names.join())
      this.pictures.replaceChildren(...names.map((name) => make("option", { value: name, textContent: name })));
    this.pictures.hidden = names.length < 2;
    this.pictures.value = first.visualizer;
    // An episode whose moments came late.
    for (const episode of this.episodes) {
      const place = Math.min(this.at, episode.last);
      if (episode.isThere && episode.at < place) episode.show(place);
    }
    this.tell();
  }

  pause() {
    clearInterval(this.timer);
    this.timer = null;
    this.playButton.textContent = "▶";
    this.playButton.setAttribute("aria-label", "Play");
  }

  // Goes on to the end, and waits there while an episode still runs.
  play({ fromHere = true } = {}) {
    clearInterval(this.timer);
    if (fromHere && this.at === this.last && !this.episodes.some((episode) => episode.isRunning)) this.show(0);
    this.timer = setInterval(() => {
      if (this.at < this.last) this.show(this.at + 1);
      else if (!this.episodes.some((episode) => episode.isRunning || episode.isPending)) this.pause();
    }, 1000 / Number(this.speed.value));
    this.playButton.textContent = "❚❚";
    this.playButton.setAttribute("aria-label", "Pause");
  }
}
