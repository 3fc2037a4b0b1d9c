// SPDX-License-Identifier: LGPL-3.0-or-later
// Which part of the plane is seen: centre, and pixels per unit. y goes up.

const view = {x: 0, y: 0, scale: 1};
const plot = {left: 0, right: 0, top: 0, bottom: 0}; // on the canvas; coordinates stand outside of it
const toX = (x) => (plot.left + plot.right) / 2 + (x - view.x) * view.scale;
const toY = (y) => (plot.top + plot.bottom) / 2 - (y - view.y) * view.scale;
const fromX = (px) => view.x + (px - (plot.left + plot.right) / 2) / view.scale;
const fromY = (py) => view.y - (py - (plot.top + plot.bottom) / 2) / view.scale;
const viewBox = () => [fromX(plot.left), fromX(plot.right), fromY(plot.bottom), fromY(plot.top)];

function fitBox(box, rim = 0.04) {
  const [x0, x1, y0, y1] = box, wide = x1 - x0, high = y1 - y0;
  const side = Math.max(wide, high) || Math.abs(x0) * 1e-3 || 1;
  const room = Math.min((plot.right - plot.left) / (wide || side), (plot.bottom - plot.top) / (high || side));
  view.x = x0 / 2 + x1 / 2;
  view.y = y0 / 2 + y1 / 2;
  view.scale = room / (1 + 2 * rim);
}

// Neighbouring doubles stay within a pixel, and everything within a few of them.
function limitScale(all) {
  const ulp = Math.max(Math.abs(view.x), Math.abs(view.y), 1e-300) * 2 ** -52, wide = Math.max(all[1] - all[0], all[3] - all[2], ulp);
  view.scale = Math.min(Math.max(view.scale, 20 / wide), 1 / ulp);
}

// The place at px, py stays there.
function zoomAt(px, py, factor, all) {
  const x = fromX(px), y = fromY(py);
  view.scale *= factor;
  limitScale(all);
  view.x += x - fromX(px);
  view.y += y - fromY(py);
}

// 1, 2 or 5 times a power of ten, at least `least`; of a globe 15, 30, 45 or 90 degrees, too.
function roundStep(least, globe) {
  if (globe && least > 10) return [15, 30, 45].find((step) => step >= least) ?? 90;
  const power = 10 ** Math.floor(Math.log10(least)), digit = [1, 2, 5, 10].find((d) => d * power >= least * (1 - 1e-9));
  return digit * power;
}

// Cuts a line to a box; NaN: nothing is left. Positions far outside do not fit what canvases count with.
const cut = new Float64Array(4);
function cutLine(x0, y0, x1, y1, box) {
  let from = 0, to = 1;
  const dx = x1 - x0, dy = y1 - y0;
  for (const [along, inside] of [[-dx, x0 - box[0]], [dx, box[1] - x0], [-dy, y0 - box[2]], [dy, box[3] - y0]]) {
    if (along === 0) { if (inside < 0) return false; continue; }
    const t = inside / along;
    if (along < 0) from = Math.max(from, t); else to = Math.min(to, t);
  }
  if (from > to) return false;
  cut[0] = x0 + from * dx; cut[1] = y0 + from * dy; cut[2] = x0 + to * dx; cut[3] = y0 + to * dy;
  return true;
}
