// SPDX-License-Identifier: LGPL-3.0-or-later
// The map: areas, lines, boxes, names, coordinates. Only what the grid says may be seen is drawn.

const DASHED = 3000; // more lines than that are drawn full: dashes take long, and are not seen
const NAMED = 600;   // more points than that get no names

let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  colours = new Proxy({}, {get: (kept, name) => (kept[name] ??= style.getPropertyValue("--" + name).trim())});
}

function makeGrids(scene) {
  const {box, ends, triangles} = scene;
  const span = (out, list) => {
    out[0] = out[2] = Infinity;
    out[1] = out[3] = -Infinity;
    for (const k of list)
      for (let e = 0; e < 4; e++) out[e] = e & 1 ? Math.max(out[e], box[4 * k + e]) : Math.min(out[e], box[4 * k + e]);
  };
  if (scene.globe && !scene.ways) makeWays(scene);
  scene.grid = {
    points: makeGrid(scene.n, (k, out) => span(out, [k])),
    pairs: makeGrid(scene.pairs, (p, out) => (scene.globe ? spanOf(scene.ways.pairs[p], out) : span(out, [ends[2 * p], ends[2 * p + 1]]))),
    triangles: makeGrid(triangles.length / 3, (t, out) => (scene.globe ? spanOf(scene.ways.rings[t], out) : span(out, triangles.subarray(3 * t, 3 * t + 3)))),
  };
}

// Numbers of the pairs in view, by status.
function pairsInView(scene, seen) {
  const out = [[], [], [], []];
  visitGrid(scene.grid.pairs, seen, (p) => out[scene.status[p]].push(p));
  return out;
}

function pathLine(ctx, scene, p, frame) {
  if (scene.globe) { pathWay(ctx, scene.ways.pairs[p], mapFrame(frame)); return; }
  const i = scene.ends[2 * p], j = scene.ends[2 * p + 1];
  const x0 = toX(middle(scene, i, 0)), y0 = toY(middle(scene, i, 1)), x1 = toX(middle(scene, j, 0)), y1 = toY(middle(scene, j, 1));
  if (!cutLine(x0, y0, x1, y1, frame)) return;
  ctx.moveTo(cut[0], cut[1]);
  ctx.lineTo(cut[2], cut[3]);
}

// About how far neighbours are apart on the screen: the median of some of the lines in view.
function spacing(scene, pairs) {
  const SOME = 300, list = pairs[LEGAL].length ? pairs[LEGAL] : pairs[INDETERMINATE].length ? pairs[INDETERMINATE] : pairs[TIE];
  const leap = Math.max(1, Math.floor(list.length / SOME)), length = [];
  for (let k = 0; k < list.length; k += leap) {
    const i = scene.ends[2 * list[k]], j = scene.ends[2 * list[k] + 1];
    length.push(Math.hypot(middle(scene, i, 0) - middle(scene, j, 0), middle(scene, i, 1) - middle(scene, j, 1)));
  }
  return length.length ? length.sort((a, b) => a - b)[length.length >> 1] * view.scale : 100;
}

// Those that a plan decides in the colour of their ranks.
function drawPlanned(ctx, scene, pairs, status, frame, apart) {
  if (!scene.rank || status === LEGAL) { drawLines(ctx, scene, pairs, status, frame, apart, STATUS[status]); return; }
  for (const c of [0, 4, 3, 2, 1]) {
    const own = pairs.filter((p) => planClass(scene, scene.rank[p]) === c);
    drawLines(ctx, scene, own, c ? LEGAL : TIE, frame, apart * (c ? 1.5 : 1), c ? "plan-" + c : "tie");
  }
}

function drawLines(ctx, scene, pairs, status, frame, apart, colour) {
  ctx.beginPath();
  for (const p of pairs) pathLine(ctx, scene, p, frame);
  const dashed = pairs.length <= DASHED;
  ctx.strokeStyle = colours[colour];
  ctx.lineWidth = Math.min(1.4, Math.max(0.35, apart / 12));
  ctx.setLineDash(!dashed || status === LEGAL ? [] : status === TIE ? [1.3, 3] : [6, 4]);
  ctx.stroke();
  ctx.setLineDash([]);
}

// A polygon to be filled, cut to the frame by one side after the other. It is left open, as filling closes it: to close
// it takes browsers a look at all that is in the path before.
function pathPolygon(ctx, z, frame) {
  const outside = ([x, y]) => x < frame[0] || x > frame[1] || y < frame[2] || y > frame[3];
  for (let side = z.some(outside) ? 0 : 4; side < 4 && z.length; side++) {
    const axis = side >> 1, depth = (q) => (side & 1 ? frame[side] - q[axis] : q[axis] - frame[side]), kept = [];
    z.forEach((p, k) => {
      const q = z[k + 1 === z.length ? 0 : k + 1], a = depth(p), b = depth(q);
      if (a >= 0) kept.push(p);
      if (a < 0 !== b < 0) kept.push([p[0] + a / (a - b) * (q[0] - p[0]), p[1] + a / (a - b) * (q[1] - p[1])]);
    });
    z = kept;
  }
  z.forEach((p, k) => (k ? ctx.lineTo(p[0], p[1]) : ctx.moveTo(p[0], p[1])));
}

function corners(scene, k) {
  const [x0, x1, y0, y1] = scene.box.subarray(4 * k, 4 * k + 4);
  return [[toX(x0), toY(y0)], [toX(x1), toY(y0)], [toX(x1), toY(y1)], [toX(x0), toY(y1)]];
}

function hull(points) {
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list) => {
    const out = [];
    for (const p of list) {
      for (let k = out.length; k > 1; k = out.length) {
        const [a, b] = [out[k - 2], out[k - 1]];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return chain(points).concat(chain(points.reverse()));
}

const boxPixels = (scene, k) => Math.max(scene.box[4 * k + 1] - scene.box[4 * k], scene.box[4 * k + 3] - scene.box[4 * k + 2]) * view.scale;

// Where an edge may be: the hull of two boxes, where these can be seen.
function drawAreas(ctx, scene, pairs, status, frame) {
  if (pairs.length > DASHED) return;
  ctx.beginPath();
  for (const p of pairs) {
    const i = scene.ends[2 * p], j = scene.ends[2 * p + 1];
    if (Math.max(boxPixels(scene, i), boxPixels(scene, j)) > 6) pathPolygon(ctx, hull([...corners(scene, i), ...corners(scene, j)]), frame);
  }
  ctx.fillStyle = colours[STATUS[status] + "-area"];
  ctx.fill();
}

function drawTriangles(ctx, scene, seen, frame) {
  ctx.beginPath();
  visitGrid(scene.grid.triangles, seen, (t) => {
    if (scene.globe) { pathRing(ctx, scene.ways.rings[t], mapFrame(frame)); return; }
    if (!triangleIsSure(scene, 3 * t)) return;
    const z = [0, 1, 2].map((c) => scene.triangles[3 * t + c]).map((k) => [toX(middle(scene, k, 0)), toY(middle(scene, k, 1))]);
    pathPolygon(ctx, z, frame);
  });
  ctx.fillStyle = colours.triangle;
  ctx.fill();
}

function pathBox(ctx, scene, k, frame) {
  const x0 = Math.max(toX(scene.box[4 * k]), frame[0]), x1 = Math.min(toX(scene.box[4 * k + 1]), frame[1]);
  const y0 = Math.max(toY(scene.box[4 * k + 3]), frame[2]), y1 = Math.min(toY(scene.box[4 * k + 2]), frame[3]);
  if (!scene.data.discs) { ctx.rect(x0, y0, x1 - x0, y1 - y0); return; }
  const radius = boxPixels(scene, k) / 2, x = toX(middle(scene, k, 0)), y = toY(middle(scene, k, 1));
  ctx.moveTo(x + radius, y);
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
}

// Boxes that can be seen as such; the others are dots.
function drawPoints(ctx, scene, seen, frame, apart) {
  const wide = [], small = [];
  visitGrid(scene.grid.points, seen, (k) => (boxPixels(scene, k) > 3.5 ? wide : small).push(k));
  for (const c of scene.place ? [0, 4, 3, 2, 1] : [0]) {
    ctx.beginPath();
    for (const k of wide) if (!scene.place || planClass(scene, scene.place[k]) === c) pathBox(ctx, scene, k, frame);
    ctx.fillStyle = colours[c ? "plan-" + c : scene.place ? "grid" : "box"];
    ctx.fill();
    ctx.strokeStyle = colours["box-edge"];
    ctx.lineWidth = 1;
    ctx.stroke();
  }
  const size = Math.min(5, Math.max(0.8, apart / 5));
  ctx.fillStyle = colours.dot;
  ctx.beginPath();
  for (const k of small) {
    const x = toX(middle(scene, k, 0)), y = toY(middle(scene, k, 1));
    if (size > 3) { ctx.moveTo(x + size / 2, y); ctx.arc(x, y, size / 2, 0, 2 * Math.PI); }
    else ctx.rect(x - size / 2, y - size / 2, size, size);
  }
  ctx.fill();
  return wide.concat(small);
}

// Names beside their points, on no other name and within the map.
function drawNames(ctx, scene, points) {
  if (scene.place) points = points.filter((k) => scene.place[k]).sort((a, b) => scene.place[a] - scene.place[b]).slice(0, NAMED);
  if (points.length > NAMED) return;
  const taken = new Set(), HIGH = 14;
  ctx.font = "12px system-ui, sans-serif";
  ctx.textBaseline = "middle";
  ctx.lineWidth = 3;
  ctx.strokeStyle = colours.paper;
  ctx.fillStyle = colours.ink;
  ctx.lineJoin = "round";
  for (const k of points) {
    const text = (scene.place ? scene.place[k] + ": " : "") + nameOf(scene, k), half = (scene.box[4 * k + 1] - scene.box[4 * k]) * view.scale / 2, squares = [];
    const wide = ctx.measureText(text).width, right = toX(middle(scene, k, 0)) + Math.min(half, 60) + 5;
    const y = Math.max(toY(middle(scene, k, 1)) - Math.min(half + 5, 9), plot.top + 7);
    const x = right + wide > plot.right ? 2 * toX(middle(scene, k, 0)) - right - wide : right;
    for (let s = Math.floor(x / HIGH); s <= Math.floor((x + wide) / HIGH); s++)
      for (const r of [Math.floor((y - 6) / HIGH), Math.floor((y + 6) / HIGH)]) squares.push(s + ":" + r);
    if (squares.some((s) => taken.has(s))) continue;
    squares.forEach((s) => taken.add(s));
    ctx.strokeText(text, x, y);
    ctx.fillText(text, x, y);
  }
}

// The ticks along an axis, "x" or "y", at least `apart` pixels from each other: numbers and texts. A globe ends at its poles.
function ticks(scene, axis, apart) {
  const box = viewBox(), limit = scene.globe ? [180, 90][axis] : Infinity, out = [];
  const step = roundStep(apart / view.scale, scene.globe), digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const text = (v) => (digits > 12 || Math.abs(v) >= 1e15 ? v.toPrecision(12) : v.toFixed(Math.min(digits, 100)));
  const first = Math.ceil(Math.max(box[2 * axis], -limit) / step), last = Math.floor(Math.min(box[2 * axis + 1], limit) / step);
  for (let n = first; n <= last && n < first + 50; n++) out.push({at: n * step, text: text(n * step)});
  return out;
}

const AXIS_FONT = "11px system-ui, sans-serif";
const widest = (ctx, list) => list.reduce((most, {text}) => Math.max(most, ctx.measureText(text).width), 0);

// The left margin grows with the texts along it, from `least` on; what is seen stays where it is.
function fitMargin(ctx, scene, least = plot.narrow ? 46 : 64) {
  ctx.font = AXIS_FONT;
  const left = Math.max(least, Math.ceil(widest(ctx, ticks(scene, 1, 90))) + 10), more = left - plot.left;
  plot.left = left;
  view.x += more / 2 / view.scale;
}

// Round numbers along the left and the lower side.
function drawAxes(ctx, scene) {
  ctx.font = AXIS_FONT;
  ctx.fillStyle = colours.faint;
  ctx.strokeStyle = colours.rule;
  ctx.lineWidth = 1;
  ctx.strokeRect(plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  ctx.beginPath();
  for (const {at, text} of ticks(scene, 0, Math.max(90, widest(ctx, ticks(scene, 0, 90)) + 16))) {
    const half = ctx.measureText(text).width / 2;
    ctx.moveTo(toX(at), plot.bottom);
    ctx.lineTo(toX(at), plot.bottom + 4);
    ctx.fillText(text, Math.min(toX(at), plot.right + 8 - half), plot.bottom + 6);
  }
  ctx.textAlign = "right";
  ctx.textBaseline = "middle";
  for (const {at, text} of ticks(scene, 1, 90)) {
    ctx.moveTo(plot.left - 4, toY(at));
    ctx.lineTo(plot.left, toY(at));
    ctx.fillText(text, plot.left - 6, toY(at));
  }
  ctx.stroke();
  ctx.textAlign = "left";
}

// Draws everything; returns the number of things drawn. on: the layers switched on. Where a diagram is not known, its
// pairs are shown.
function drawMap(ctx, scene, on) {
  const shown = scene.cells.length && !isLast(scene) ? new Set([...on, ...STATUS]) : on;
  const seen = viewBox(), frame = [plot.left - 20, plot.right + 20, plot.top - 20, plot.bottom + 20];
  const pairs = pairsInView(scene, seen), apart = spacing(scene, pairs), order = [TIE, INDETERMINATE, LEGAL].filter((s) => shown.has(STATUS[s]));
  ctx.save();
  ctx.beginPath();
  ctx.rect(plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
  ctx.clip();
  drawCells(ctx, scene, shown, seen, frame);
  if (shown.has("triangles")) drawTriangles(ctx, scene, seen, frame);
  if (shown.has("areas")) for (const s of order) drawAreas(ctx, scene, pairs[s], s, frame);
  for (const s of order) drawPlanned(ctx, scene, pairs[s], s, frame, apart);
  drawVertices(ctx, scene, shown, seen, frame);
  const points = shown.has("boxes") ? drawPoints(ctx, scene, seen, frame, apart) : [];
  if (shown.has("names") && apart > 12) drawNames(ctx, scene, points);
  ctx.restore();
  drawAxes(ctx, scene);
  return points.length + order.reduce((sum, s) => sum + pairs[s].length, 0);
}

// Draws the marked point and its partners, over the map.
function drawMark(ctx, scene, k, shown) {
  const frame = [plot.left - 20, plot.right + 20, plot.top - 20, plot.bottom + 20], own = partners(scene, k);
  ctx.save();
  ctx.beginPath();
  ctx.rect(plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
  ctx.clip();
  drawCellMark(ctx, scene, k, frame);
  for (const s of [TIE, INDETERMINATE, LEGAL]) {
    if (scene.cells.length && !shown.has(STATUS[s])) continue;
    ctx.beginPath();
    for (const p of own[s]) pathLine(ctx, scene, p, frame);
    ctx.strokeStyle = colours[STATUS[s]];
    ctx.lineWidth = 3;
    ctx.setLineDash(s === LEGAL ? [] : s === TIE ? [2, 4] : [8, 4]);
    ctx.stroke();
  }
  ctx.setLineDash([]);
  ctx.strokeStyle = colours.mark;
  ctx.lineWidth = 2;
  ctx.beginPath();
  pathBox(ctx, scene, k, frame);
  const x = toX(middle(scene, k, 0)), y = toY(middle(scene, k, 1)), radius = 8;
  if (boxPixels(scene, k) < 2 * radius) { ctx.moveTo(x + radius, y); ctx.arc(x, y, radius, 0, 2 * Math.PI); }
  ctx.stroke();
  ctx.restore();
}
