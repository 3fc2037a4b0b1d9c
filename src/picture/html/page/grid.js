// SPDX-License-Identifier: LGPL-3.0-or-later
// A grid over the plane: finds the things visible in a part of it, without a search of the rest.

// boxOf(k, out) gives the box of thing k. Things across many squares are kept apart, and tested each time. The squares are
// filled when a part of the plane is first visible.
function makeGrid(count, boxOf) {
  const box = new Float64Array(4 * count), all = [Infinity, -Infinity, Infinity, -Infinity], out = [0, 0, 0, 0];
  for (let k = 0; k < count; k++) {
    boxOf(k, out);
    for (let e = 0; e < 4; e++) {
      box[4 * k + e] = out[e];
      if (Math.abs(out[e]) < 1e299) all[e] = e & 1 ? Math.max(all[e], out[e]) : Math.min(all[e], out[e]);
    }
  }
  const side = Math.max(1, Math.min(512, Math.ceil(Math.sqrt(count / 2))));
  const step = [(all[1] - all[0]) / side || 1, (all[3] - all[2]) / side || 1];
  const square = (value, axis) => Math.max(0, Math.min(side - 1, Math.floor((value - all[2 * axis]) / step[axis])));
  const range = (b, at) => [square(b[at], 0), square(b[at + 1], 0), square(b[at + 2], 1), square(b[at + 3], 1)];
  return {count, box, range, side, first: null, item: null, wide: [], seen: new Uint32Array(count), turn: 0};
}

function fillGrid(grid) {
  const {count, box, range, side, wide} = grid, MANY = 64;
  const first = new Uint32Array(side * side + 1);
  const each = (k, visit) => {
    const [x0, x1, y0, y1] = range(box, 4 * k);
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > MANY) return false;
    for (let y = y0; y <= y1; y++) for (let x = x0; x <= x1; x++) visit(y * side + x);
    return true;
  };
  for (let k = 0; k < count; k++) if (!each(k, (s) => first[s + 1]++)) wide.push(k);
  for (let s = 0; s < side * side; s++) first[s + 1] += first[s];
  const item = new Uint32Array(first[side * side]), next = first.slice();
  for (let k = 0; k < count; k++) each(k, (s) => { item[next[s]++] = k; });
  Object.assign(grid, {first, item});
}

// Calls visit(k) once for each thing whose box meets the view.
function visitGrid(grid, view, visit) {
  const {box, seen, side} = grid, turn = ++grid.turn, [x0, x1, y0, y1] = grid.range(view, 0);
  const look = (k) => {
    const b = 4 * k;
    if (seen[k] === turn || box[b] > view[1] || box[b + 1] < view[0] || box[b + 2] > view[3] || box[b + 3] < view[2]) return;
    seen[k] = turn;
    visit(k);
  };
  if (2 * (x1 - x0 + 1) * (y1 - y0 + 1) > side * side) {
    for (let k = 0; k < grid.count; k++) look(k);
    return;
  }
  if (!grid.first) fillGrid(grid);
  const {first, item, wide} = grid;
  wide.forEach(look);
  for (let y = y0; y <= y1; y++)
    for (let s = first[y * side + x0]; s < first[y * side + x1 + 1]; s++) look(item[s]);
}
