"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const state = { axis: null, groom: "", colour: "", light: "", time: "axis_ms", pick: null, row: 0, sort: "time", down: false };

const ABOUT = {
  opacity: "White hair under an even sky: brightness is coverage. Compared with 64 samples a pixel.",
  shadow: "What passes the hair between sun and visible hair, against rays through the strands themselves.",
  scattering: "Light scattered once, against the technique deon (energy-conserving, integrated in the shader), same frames otherwise.",
  multiple: "Light of a sun, against a path tracer that follows it as often as it scatters.",
  environment: "Light of the sky alone, against a path tracer.",
  frame: "Sun and sky, against a path tracer. One axis at a time differs from the base: the demo's defaults, but series_b and dual.",
};
const COLUMNS = [
  ["name", "technique", (p) => p.name],
  ["error", "error", (p) => percent(p.error)],
  ["l2", "L2", (p) => percent(p.l2)],
  ["flip", "FLIP", (p) => fixed(p.flip, 3)],
  ["bias", "bias", (p) => percent(p.bias)],
  ["flicker", "flicker", (p) => percent(p.flicker)],
  ["time", "ms, axis", (p) => milliseconds(p.axis_ms)],
  ["frame", "ms, frame", (p) => milliseconds(p.frame_ms)],
  ["transient", "MiB, transient", (p) => fixed(p.transient / 1048576, 2)],
  ["persistent", "MiB, persistent", (p) => fixed(p.persistent / 1048576, 2)],
];

function fixed(value, digits) { return Number.isFinite(value) ? value.toFixed(digits) : "–"; }
function percent(value) { return Number.isFinite(value) ? (100 * value).toFixed(Math.abs(value) < 0.1 ? 2 : 1) + " %" : "–"; }
function milliseconds(value) { return fixed(value, value < 10 ? 2 : 1); }
function element(name, attributes, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value); else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}
function drawn(name, attributes, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes || {})) node.setAttribute(key, value);
  node.append(...children);
  return node;
}
const mean = (values) => { const v = values.filter(Number.isFinite); return v.length ? v.reduce((a, b) => a + b, 0) / v.length : NaN; };
const unique = (values) => [...new Set(values)];

// Rows of the axis that the filters leave, one point for each technique at each setting.
function points() {
  const rows = data.rows.filter((r) => r.axis === state.axis && ["groom", "colour", "light"].every((k) => !state[k] || r[k] === state[k]));
  const groups = new Map();
  for (const row of rows) {
    const key = row.technique + (row.setting ? " " + row.setting : "");
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(row);
  }
  const all = [...groups].map(([name, group]) => {
    const over = (read) => mean(group.map(read));
    return {
      name, rows: group, error: over((r) => r.error), axis_ms: over((r) => r.axis_ms.median), frame_ms: over((r) => r.frame_ms.median),
      low: over((r) => r[state.time].p10), high: over((r) => r[state.time].p90),
      l2: over((r) => r.measures.l2), flip: over((r) => r.measures.flip), bias: over((r) => r.measures.bias), flicker: over((r) => r.measures.flicker),
      transient: over((r) => r.transient_bytes), persistent: over((r) => r.persistent_bytes),
    };
  });
  for (const p of all) p.x = p[state.time];
  // As pareto_front() of game_demo/src/accuracy.
  let best = Infinity;
  for (const p of [...all].sort((a, b) => a.x - b.x || a.error - b.error)) {
    p.front = p.error < best;
    if (p.front) best = p.error;
  }
  return all;
}

function ticks(low, high, logarithmic) {
  const result = [];
  if (logarithmic) {
    const few = Math.log10(high / low) > 2.2;
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e) {
      for (const m of few ? [1] : [1, 2, 5]) result.push(m * 10 ** e);
    }
  } else {
    const rough = (high - low) / 4;
    const power = 10 ** Math.floor(Math.log10(rough || 1));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) || 1;
    for (let t = Math.ceil(low / step) * step; t <= high + 1e-9; t += step) result.push(t);
  }
  return result.filter((t) => t >= low && t <= high);
}

// Position on an axis of `length` pixels; errors of 0 lie on the axis itself.
function scale(values, length, zeros) {
  const positive = values.filter((v) => v > 0);
  let low = Math.min(...positive), high = Math.max(...positive);
  if (!positive.length) { low = 0.5; high = 1; }
  const logarithmic = high / low > 12;
  if (logarithmic) { low /= 1.4; high *= 1.4; } else { const room = 0.12 * (high - low || high); high += room; low = zeros ? 0 : Math.max(0, low - room); }
  const at = (v) => (logarithmic ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
  const gap = logarithmic && zeros && values.some((v) => !(v > 0)) ? 22 : 0;
  return { gap, ticks: ticks(low, high, logarithmic), at: (v) => (logarithmic && !(v > 0) ? 0 : gap + at(v) * (length - gap)) };
}

function chart(all) {
  const width = Math.max(280, $("chart").clientWidth - 18), height = Math.max(260, Math.min(420, 0.55 * width));
  const left = 56, right = 14, top = 12, bottom = 44;
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${height}`, role: "group" });
  const x = scale(all.flatMap((p) => [p.x, p.low, p.high]), width - left - right, false), y = scale(all.map((p) => p.error), height - top - bottom, true);
  const px = (v) => left + x.at(v), py = (v) => height - bottom - y.at(v);
  const text = (at, words, more) => drawn("text", { x: at[0], y: at[1], ...more }, words);
  for (const t of y.ticks) {
    svg.append(drawn("line", { class: "grid", x1: left, x2: width - right, y1: py(t), y2: py(t) }), text([left - 6, py(t) + 4], percentTick(t), { "text-anchor": "end" }));
  }
  if (y.gap) svg.append(text([left - 6, height - bottom + 4], "0", { "text-anchor": "end" }));
  svg.append(drawn("line", { class: "grid", x1: left, x2: width - right, y1: height - bottom, y2: height - bottom }));
  let lastTick = -99;
  for (const t of x.ticks) {
    if (px(t) - lastTick < 44) continue;
    lastTick = px(t);
    svg.append(drawn("line", { class: "grid", x1: px(t), x2: px(t), y1: top, y2: height - bottom }), text([px(t), height - bottom + 16], String(+t.toPrecision(3)), { "text-anchor": "middle" }));
  }
  svg.append(text([width - right, height - 8], state.time === "axis_ms" ? "ms a frame, passes of this axis" : "ms a frame, all passes", { "text-anchor": "end" }));
  svg.append(text([4, 11], "error"));
  const front = all.filter((p) => p.front).sort((a, b) => a.x - b.x);
  if (front.length > 1) {
    const steps = front.map((p, i) => (i ? `H${px(p.x)}V${py(p.error)}` : `M${px(p.x)} ${py(p.error)}`)).join("");
    svg.append(drawn("path", { class: "path", d: steps }));
  }
  const taken = all.map((p) => [px(p.x) - 8, py(p.error) - 8, px(p.x) + 8, py(p.error) + 8]);
  const order = [...all].sort((a, b) => (b.name === state.pick) - (a.name === state.pick) || b.front - a.front);
  for (const p of order) {
    const picked = p.name === state.pick;
    const group = drawn("g", { class: `point${p.front ? " front" : ""}${picked ? " picked" : ""}`, tabindex: 0, role: "button", "data-name": p.name, "aria-label": `${p.name}: error ${percent(p.error)}, ${milliseconds(p.x)} ms` });
    group.append(drawn("title", {}, `${p.name}: ${percent(p.error)}, ${milliseconds(p.x)} ms`));
    group.append(drawn("line", { class: "spread", x1: Math.max(left, px(p.low)), x2: Math.min(width - right, px(p.high)), y1: py(p.error), y2: py(p.error) }));
    group.append(drawn("circle", { cx: px(p.x), cy: py(p.error), r: 13, fill: "transparent" }), drawn("circle", { class: "mark", cx: px(p.x), cy: py(p.error), r: picked ? 7 : 5.5 }));
    const label = place(p, px(p.x), py(p.error), taken, width, height - bottom);
    if (label) group.append(text(label, p.name, { class: p.front || picked ? "label" : "" }));
    const choose = () => { state.pick = p.name; state.row = 0; show(); };
    group.addEventListener("click", choose);
    group.addEventListener("keydown", (e) => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); choose(); } });
    svg.append(group);
  }
  $("chart").replaceChildren(svg);
}
function percentTick(t) { return +(100 * t).toPrecision(2) + " %"; }

// Where a point's name has room beside it; null where it has none.
function place(p, x, y, taken, width, floor) {
  const long = 6.9 * p.name.length;
  for (const [lx, ly] of [[x + 11, y + 4], [x - 11 - long, y + 4], [x - long / 2, y - 12], [x - long / 2, y + 20]]) {
    const box = [lx, ly - 11, lx + long, ly + 3];
    if (box[0] < 58 || box[2] > width - 2 || box[1] < 14 || box[3] > floor) continue;
    if (taken.some((t) => box[0] < t[2] && box[2] > t[0] && box[1] < t[3] && box[3] > t[1])) continue;
    taken.push(box);
    return [lx, ly];
  }
  return null;
}

function subject(row) { return [row.groom, row.colour, row.light].join(", "); }

function detail(all) {
  const point = all.find((p) => p.name === state.pick);
  if (!point) { $("detail").replaceChildren(element("p", { class: "figures" }, "Choose a point to see its pictures.")); return; }
  const row = point.rows[Math.min(state.row, point.rows.length - 1)];
  const trio = element("div", { class: "trio" });
  const heat = row.axis === "opacity" || row.axis === "shadow" ? "difference" : "difference (FLIP)";
  ["picture", "reference", heat].forEach((name, i) => {
    const uri = data.files[row.pictures[i]];
    const shown = uri ? element("img", { src: uri, alt: `${name} of ${row.id}` }) : element("p", {}, "not kept");
    trio.append(element("figure", {}, shown, element("figcaption", {}, name)));
  });
  const chips = element("div", { class: "chips", role: "group", "aria-label": "Picture" });
  point.rows.forEach((r, i) => chips.append(element("button", { type: "button", "aria-pressed": r === row, onclick: () => { state.row = i; show(); } }, subject(r))));
  const figures = element("p", { class: "figures" });
  const say = (name, value) => figures.append(element("b", {}, value), ` ${name}   `);
  say(data.errors[row.axis], percent(row.error));
  if (Number.isFinite(row.measures.reference_noise)) say("to be expected from the reference's own noise", percent(row.measures.reference_noise));
  say("FLIP", fixed(row.measures.flip, 3));
  say("bias", percent(row.measures.bias));
  say("ms, axis", `${milliseconds(row.axis_ms.median)} (${milliseconds(row.axis_ms.p10)}–${milliseconds(row.axis_ms.p90)})`);
  say("ms, frame", `${milliseconds(row.frame_ms.median)} (${milliseconds(row.frame_ms.p10)}–${milliseconds(row.frame_ms.p90)})`);
  $("detail").replaceChildren(element("h2", {}, point.name), trio, figures, chips);
}

function table(all) {
  const key = { time: "axis_ms", frame: "frame_ms" }[state.sort] || state.sort;
  const sorted = [...all].sort((a, b) => {
    const order = key === "name" ? a.name.localeCompare(b.name) : (a[key] ?? Infinity) - (b[key] ?? Infinity);
    return state.down ? -order : order;
  });
  const head = element("tr", {});
  for (const [id, title] of COLUMNS) {
    const choose = () => { state.down = state.sort === id && !state.down; state.sort = id; show(); };
    const cell = element("th", { scope: "col" }, element("button", { type: "button", onclick: choose }, title));
    if (state.sort === id) cell.setAttribute("aria-sort", state.down ? "descending" : "ascending");
    head.append(cell);
  }
  const body = element("tbody", {});
  for (const p of sorted) {
    const row = element("tr", { class: `${p.front ? "front" : ""}${p.name === state.pick ? " picked" : ""}`, onclick: () => { state.pick = p.name; state.row = 0; show(); } });
    for (const [, , cell] of COLUMNS) row.append(element("td", {}, cell(p)));
    body.append(row);
  }
  const rows = all.reduce((n, p) => n + p.rows.length, 0);
  $("table").replaceChildren(element("h2", {}, `Means over ${rows} row${rows === 1 ? "" : "s"}`), element("div", { class: "scroll" }, element("table", {}, element("thead", {}, head), body)));
}

function filters() {
  const rows = data.rows.filter((r) => r.axis === state.axis);
  const select = (name, options, value, change) => {
    const node = element("select", { "aria-label": name, onchange: () => { change(node.value); show(); } });
    for (const [id, title] of options) node.append(element("option", { value: id, ...(id === value ? { selected: "" } : {}) }, title));
    return element("label", {}, name, node);
  };
  const nodes = [];
  for (const key of ["groom", "colour", "light"]) {
    const values = unique(rows.map((r) => r[key]));
    if (!values.includes(state[key])) state[key] = "";
    if (values.length > 1) nodes.push(select(key, [["", "all"], ...values.map((v) => [v, v])], state[key], (v) => { state[key] = v; }));
  }
  nodes.push(select("time", [["axis_ms", "passes of this axis"], ["frame_ms", "whole frame"]], state.time, (v) => { state.time = v; }));
  $("filters").replaceChildren(...nodes);
}

function show() {
  filters();
  for (const tab of $("axes").children) tab.setAttribute("aria-selected", tab.dataset.axis === state.axis);
  $("about").textContent = `${ABOUT[state.axis] || ""} Error: ${data.errors[state.axis]}.`;
  const all = points();
  if (!all.some((p) => p.name === state.pick)) { state.pick = (all.filter((p) => p.front && p.error > 0).pop() || all[0]).name; state.row = 0; }
  chart(all);
  detail(all);
  table(all);
}

const order = ["opacity", "shadow", "scattering", "multiple", "environment", "frame"];
const present = unique(data.rows.map((r) => r.axis)).sort((a, b) => order.indexOf(a) - order.indexOf(b));
for (const [name, value, wide] of [["Device", data.device], ["Driver", data.driver], ["Date", data.date], ["Seed, picture", `${data.seed}, ${data.size} × ${data.size}`], ["Rows", String(data.rows.length)], ["Command", data.command, true]]) {
  $("facts").append(element("div", wide ? { class: "wide" } : {}, element("dt", {}, name), element("dd", {}, wide ? element("code", {}, value) : value)));
}
for (const axis of present) {
  $("axes").append(element("button", { type: "button", role: "tab", "data-axis": axis, onclick: () => { state.axis = axis; state.pick = null; show(); } }, axis === "frame" ? "whole frame" : axis));
}
if (present.length) {
  state.axis = present[0];
  show();
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; show(); } });
} else {
  $("about").textContent = "There are no rows yet.";
}
