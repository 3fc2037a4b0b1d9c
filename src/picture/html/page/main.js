// SPDX-License-Identifier: LGPL-3.0-or-later
// The page: the view, and its control by mouse, touch and keys.

let scene = null, shown = new Set(), all = [0, 1, 0, 1];
let hovered = null, kept = null;               // points
let moving = false, base = null, heavy = false; // while moving, a heavy map is its last picture, moved
let waiting = 0, resting = 0, dark = null;
const map = $("map"), marks = $("marks");

// ---- drawing, once a frame ----

function draw() {
  waiting = 0;
  const ctx = map.getContext("2d"), begun = performance.now();
  if (moving && heavy) {
    base ??= keepPicture();
    clear(ctx);
    drawKept(ctx);
    drawAxes(ctx, scene);
  } else {
    base = null;
    clear(ctx);
    fitMargin(ctx, scene);
    const things = drawMap(ctx, scene, shown);
    heavy = things > 12000 || performance.now() - begun > 10;
  }
  drawMarks();
}

// Sets the view, and again until the margin has room for its coordinates.
function see(set) {
  const ctx = map.getContext("2d");
  set();
  fitMargin(ctx, scene);
  for (let left = -1; left < plot.left;) {
    left = plot.left;
    set();
    fitMargin(ctx, scene, left);
  }
}

// Shows everything; a window that changes its size goes on to show it while nothing else was chosen.
let fitted = {};
function seeAll() {
  see(() => fitBox(all));
  fitted = {...view};
}

function redraw() {
  waiting ||= requestAnimationFrame(draw);
}

// After a move: the map as it is, and the place in the address.
function move() {
  moving = true;
  redraw();
  clearTimeout(resting);
  resting = setTimeout(() => { moving = false; redraw(); writeAddress(); }, 150);
}

function clear(ctx) {
  ctx.fillStyle = colours.paper;
  ctx.fillRect(0, 0, map.clientWidth, map.clientHeight);
}

function keepPicture() {
  const canvas = document.createElement("canvas");
  canvas.width = map.width;
  canvas.height = map.height;
  canvas.getContext("2d").drawImage(map, 0, 0);
  return {canvas, ...lastView};
}

function drawKept(ctx) {
  const factor = view.scale / base.scale, wide = map.clientWidth, high = map.clientHeight;
  const [cx, cy] = [(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2];
  ctx.save();
  ctx.beginPath();
  ctx.rect(plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
  ctx.clip();
  ctx.translate(toX(base.x), toY(base.y));
  ctx.scale(factor, factor);
  ctx.beginPath();
  ctx.rect(plot.left - cx, plot.top - cy, plot.right - plot.left, plot.bottom - plot.top);
  ctx.clip();
  ctx.drawImage(base.canvas, -cx, -cy, wide, high);
  ctx.restore();
}

function drawMarks() {
  const ctx = marks.getContext("2d"), k = hovered ?? kept;
  ctx.clearRect(0, 0, marks.clientWidth, marks.clientHeight);
  if (k !== null) drawMark(ctx, scene, k, shown);
  lastView = {...view};
}
let lastView = {...view};

function resize(factor = window.devicePixelRatio || 1) {
  const wide = map.clientWidth, high = map.clientHeight;
  for (const canvas of [map, marks]) {
    canvas.width = Math.round(wide * factor);
    canvas.height = Math.round(high * factor);
    canvas.getContext("2d").setTransform(factor, 0, 0, factor, 0, 0);
  }
  Object.assign(plot, {narrow: wide < 500, left: wide < 500 ? 46 : 64, right: wide - 10, top: 10, bottom: high - 24});
  base = null;
}

// ---- stage, point, theme ----

function goStage(stage) {
  setStage(scene, Math.min(Math.max(stage, 1), scene.stages.length));
  makeGrids(scene);
  showCounts(scene);
  showStage(scene);
  tellPoint();
  base = null;
  redraw();
  writeAddressSoon();
}

function tellPoint() {
  showPoint(scene, hovered ?? kept, kept !== null && (hovered === null || hovered === kept), choosePoint);
}

function pinPoint(k) {
  kept = k;
  hovered = null;
  $("found").hidden = true;
  tellPoint();
  redraw();
  writeAddressSoon();
}

// Pins a point, and brings it into view.
function choosePoint(k) {
  const box = viewBox(), x = middle(scene, k, 0), y = middle(scene, k, 1);
  if (x < box[0] || x > box[1] || y < box[2] || y > box[3]) {
    view.x = x;
    view.y = y;
  }
  pinPoint(k);
}

// The box of points as they are at this stage.
function boxAround(points) {
  const out = [Infinity, -Infinity, Infinity, -Infinity];
  for (const k of points)
    for (let e = 0; e < 4; e++) out[e] = e & 1 ? Math.max(out[e], scene.box[4 * k + e]) : Math.min(out[e], scene.box[4 * k + e]);
  return out;
}

// Pins a point that was searched for, and zooms to it and its neighbours.
function goToPoint(k) {
  const own = partners(scene, k), near = own[LEGAL].length ? own[LEGAL] : [...own[INDETERMINATE], ...own[TIE]];
  const box = boxAround([k, ...near.map((p) => otherEnd(scene, p, k))]);
  if (box.every((v) => Math.abs(v) < 1e299) && (near.length || scene.n === 1)) {
    see(() => { fitBox(box, 0.25); limitScale(all); });
  }
  choosePoint(k);
}

function fitOthers(far) {
  const rest = boxAround([...scene.data.points.keys()].filter((k) => !far.includes(k)));
  see(() => fitBox(rest));
  move();
}

// Pins the next point in a direction from the one that is pinned; (0, 0): the one nearest to the middle of the map.
function stepPoint(dx, dy) {
  const from = kept === null || !(dx || dy) ? [view.x, view.y] : [middle(scene, kept, 0), middle(scene, kept, 1)];
  let best = null, least = Infinity;
  for (let k = 0; k < scene.n; k++) {
    const x = middle(scene, k, 0) - from[0], y = middle(scene, k, 1) - from[1], along = x * dx + y * dy, across = Math.abs(x * dy - y * dx);
    const away = dx || dy ? along + 2 * across : Math.hypot(x, y);
    if (k !== kept && (dx || dy ? along > 0 && across <= along : true) && away < least) { least = away; best = k; }
  }
  if (best !== null) choosePoint(best);
}

function setTheme(name) {
  dark = name;
  const night = name ? name === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.classList.toggle("dark", night);
  readColours();
  if (scene) redraw();
}

// ---- the place in the address ----

function writeAddress() {
  const round = (v) => Number(v.toPrecision(12)), parts = new URLSearchParams();
  parts.set("at", [round(view.x), round(view.y), round((plot.right - plot.left) / view.scale)].join(","));
  if (scene.stages.length > 1) parts.set("stage", scene.stage);
  if (kept !== null) parts.set("point", scene.data.points[kept].i);
  parts.set("show", [...shown].join(","));
  if (dark) parts.set("theme", dark);
  try { history.replaceState(null, "", "#" + decodeURIComponent(parts)); } catch { /* a frame without an address */ }
}

let addressWaits = 0;
function writeAddressSoon() {
  clearTimeout(addressWaits);
  addressWaits = setTimeout(writeAddress, 200);
}

function readAddress() {
  const parts = new URLSearchParams(location.hash.slice(1)), at = (parts.get("at") ?? "").split(",").map(Number);
  if (parts.has("show")) {
    shown = new Set(parts.get("show").split(","));
    for (const [name] of [...CELLS, ...PAIRS]) if ($("show-" + name)) $("show-" + name).checked = shown.has(name);
  }
  if (parts.has("theme")) setTheme(parts.get("theme") === "dark" ? "dark" : "light");
  kept = scene.numberOf.get(Number(parts.get("point") ?? -1)) ?? null;
  goStage(Number(parts.get("stage")) || scene.stages.length);
  if (at.length === 3 && at.every(Number.isFinite) && at[2] > 0) see(() => {
    [view.x, view.y] = at;
    view.scale = (plot.right - plot.left) / at[2];
    limitScale(all);
  });
}

// ---- the hand ----

// The point at px, py: the smallest box that holds it, else the nearest one within `reach`.
function pick(px, py, reach) {
  const [x0, x1, y1, y0] = [fromX(px - reach), fromX(px + reach), fromY(py - reach), fromY(py + reach)];
  let best = null, least = Infinity;
  visitGrid(scene.grid.points, [x0, x1, y0, y1], (k) => {
    const b = 4 * k, dx = Math.max(toX(scene.box[b]) - px, px - toX(scene.box[b + 1]), 0), dy = Math.max(toY(scene.box[b + 3]) - py, py - toY(scene.box[b + 2]), 0);
    const away = Math.hypot(dx, dy), size = away > 0 ? away : -1 / (1 + boxPixels(scene, k));
    if (away <= reach && size < least) { least = size; best = k; }
  });
  return best;
}

function hover(k) {
  if (k === hovered) return;
  hovered = k;
  tellPoint();
  drawMarks();
}

const pointers = new Map(); // pressed pointers: their places
let travelled = 0;

function pointerDown(event) {
  map.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
  if (pointers.size === 1) travelled = 0;
}

function pointerMove(event) {
  const last = pointers.get(event.pointerId), now = [event.offsetX, event.offsetY];
  if (!last) { hover(pick(...now, 9)); return; }
  const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
  travelled += Math.hypot(now[0] - last[0], now[1] - last[1]);
  pointers.set(event.pointerId, now);
  if (others.length) {
    const before = Math.hypot(last[0] - others[0][0], last[1] - others[0][1]), after = Math.hypot(now[0] - others[0][0], now[1] - others[0][1]);
    if (before > 0) zoomAt((now[0] + others[0][0]) / 2, (now[1] + others[0][1]) / 2, after / before, all);
  }
  view.x -= (now[0] - last[0]) / view.scale / (others.length + 1);
  view.y += (now[1] - last[1]) / view.scale / (others.length + 1);
  move();
}

function pointerUp(event) {
  if (!pointers.delete(event.pointerId) || travelled > 5 || event.type === "pointercancel") return;
  pinPoint(pick(event.offsetX, event.offsetY, event.pointerType === "mouse" ? 9 : 22));
}

function step(dx, dy) {
  view.x += dx * (plot.right - plot.left) / 8 / view.scale;
  view.y += dy * (plot.bottom - plot.top) / 8 / view.scale;
  move();
}

// Zooms at the pinned point if it is in view.
function zoomMiddle(factor) {
  const x = kept === null ? NaN : toX(middle(scene, kept, 0)), y = kept === null ? NaN : toY(middle(scene, kept, 1));
  const seen = x >= plot.left && x <= plot.right && y >= plot.top && y <= plot.bottom;
  zoomAt(seen ? x : (plot.left + plot.right) / 2, seen ? y : (plot.top + plot.bottom) / 2, factor, all);
  move();
}

function showAll() {
  seeAll();
  move();
}

// With Shift.
const POINT_KEYS = {
  ArrowLeft: () => stepPoint(-1, 0), ArrowRight: () => stepPoint(1, 0), ArrowUp: () => stepPoint(0, 1), ArrowDown: () => stepPoint(0, -1),
};
const KEYS = {
  ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowUp: () => step(0, 1), ArrowDown: () => step(0, -1),
  "+": () => zoomMiddle(1.5), "=": () => zoomMiddle(1.5), "-": () => zoomMiddle(1 / 1.5), 0: showAll,
  "[": () => goStage(scene.stage - 1), "]": () => goStage(scene.stage + 1),
  "/": () => $("query").focus(), d: () => $("theme").click(),
  Escape: () => pinPoint(null),
};

function keyDown(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.target.tagName === "INPUT" && event.target.type !== "checkbox" && event.key !== "Escape") return;
  const entry = document.querySelectorAll("#legend input")[Number(event.key) - 1];
  const act = (event.shiftKey ? POINT_KEYS[event.key] : event.target === map && event.key === "Enter" ? () => stepPoint(0, 0) : null) ??
    KEYS[event.key] ?? (entry && (() => entry.click()));
  if (!act) return;
  event.preventDefault();
  act();
}

function listen() {
  map.addEventListener("pointerdown", pointerDown);
  map.addEventListener("pointermove", pointerMove);
  map.addEventListener("pointerup", pointerUp);
  map.addEventListener("pointercancel", pointerUp);
  map.addEventListener("pointerleave", () => { if (!pointers.size) hover(null); });
  map.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomAt(event.offsetX, event.offsetY, Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), all);
    move();
  }, {passive: false});
  addEventListener("keydown", keyDown);
  addEventListener("hashchange", () => { readAddress(); redraw(); });
  addEventListener("beforeprint", () => { document.documentElement.classList.remove("dark"); readColours(); resize(3); draw(); });
  addEventListener("afterprint", () => { setTheme(dark); resize(); redraw(); });
  new ResizeObserver(() => {
    const whole = view.x === fitted.x && view.y === fitted.y && view.scale === fitted.scale;
    resize();
    if (whole) seeAll();
    draw();
  }).observe(map);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => setTheme(dark));
  $("closer").addEventListener("click", () => zoomMiddle(1.5));
  $("farther").addEventListener("click", () => zoomMiddle(1 / 1.5));
  $("all").addEventListener("click", showAll);
  $("theme").addEventListener("click", () => {
    setTheme(document.documentElement.classList.contains("dark") ? "light" : "dark");
    writeAddressSoon();
  });
  $("query").addEventListener("input", () => showFound(scene, goToPoint));
  $("search").addEventListener("submit", (event) => {
    event.preventDefault();
    const found = showFound(scene, goToPoint);
    if (found.length) goToPoint(found[0]);
  });
}

// ---- the beginning ----

// The first view: the window, or all points.
function wholeBox() {
  if (scene.data.window) return scene.data.window.map(toDouble);
  const out = [Infinity, -Infinity, Infinity, -Infinity];
  scene.final.forEach((v, k) => { out[k & 3] = k & 1 ? Math.max(out[k & 3], v) : Math.min(out[k & 3], v); });
  if (scene.globe && !(out[1] - out[0] < 180)) return [...MAP, -90, 90];
  return scene.n ? out : [0, 1, 0, 1];
}

async function start() {
  setTheme(null);
  scene = makeScene(await unpack($("data").textContent));
  makeCells(scene);
  all = wholeBox();
  shown = new Set(LAYERS[scene.data.layer].filter((name) => !scene.rank || name !== "areas"));
  showSummary(scene);
  showOutliers(scene, goToPoint, fitOthers);
  showPlan(scene, goToPoint);
  buildLegend(scene, shown, () => { base = null; redraw(); writeAddressSoon(); });
  buildStages(scene, goStage);
  $("message").textContent = scene.n ? "" : "there are no points";
  resize();
  seeAll();
  readAddress();
  draw();
  performance.mark("first picture");
  listen();
}

start().catch((problem) => {
  const old = typeof DecompressionStream === "undefined";
  $("message").textContent = old ? "This browser is too old to unpack the data (it lacks DecompressionStream)." : `The page cannot be shown: ${problem.message}`;
  if (!old) throw problem;
});
