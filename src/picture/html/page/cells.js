// SPDX-License-Identifier: LGPL-3.0-or-later
// The Voronoi diagram: certain and possible cells of the points, as of the last stage.

function readPolygon({origin, unit}, list) {
  const out = new Float64Array(list.length), at = [0, 0];
  list.forEach((step, k) => { out[k] = origin[k & 1] + (at[k & 1] += step) * 2 ** unit; });
  return out;
}

// cells: tint, inner and outer polygons, and those that are filled: of tiles the rings, holes turning back. cellOf: of points of the page.
function makeCells(scene) {
  const {data} = scene;
  scene.cellOf = new Map();
  scene.cells = (data.cells ?? []).map((cell, k) => {
    if (scene.numberOf.has(cell.i)) scene.cellOf.set(scene.numberOf.get(cell.i), k);
    const inner = readPolygon(data, cell.inner), outer = cell.outer.map((list) => readPolygon(data, list));
    return {tint: cell.i % 4, cell, inner, outer, filled: isTiles(scene) ? outer : [inner]};
  });
  scene.cellGrid = makeGrid(scene.cells.length, (k, out) => {
    out[0] = out[2] = Infinity;
    out[1] = out[3] = -Infinity;
    for (const polygon of scene.cells[k].outer)
      polygon.forEach((v, c) => { const e = 2 * (c & 1); out[e] = Math.min(out[e], v); out[e + 1] = Math.max(out[e + 1], v); });
  });
  const lines = data.edges ?? [];
  scene.edges = [];
  for (let k = 0; k < lines.length; k += 4) scene.edges.push(readPolygon(data, lines.slice(k, k + 4)));
}

const isTiles = (scene) => scene.data.layer === "tiles";

function toPixels(polygon) {
  const out = [];
  for (let k = 0; k < polygon.length; k += 2) out.push([toX(polygon[k]), toY(polygon[k + 1])]);
  return out;
}

// Cells in light tints; the area outside of all of them is undetermined.
function drawCells(ctx, scene, shown, seen, frame) {
  if (!scene.cells.length || !isLast(scene)) return;
  if (shown.has("bands")) {
    const [x0, x1, y0, y1] = scene.data.window.map(toDouble);
    ctx.beginPath();
    pathPolygon(ctx, [[toX(x0), toY(y0)], [toX(x1), toY(y0)], [toX(x1), toY(y1)], [toX(x0), toY(y1)]], frame);
    ctx.fillStyle = colours.band;
    ctx.fill();
  }
  if (!shown.has("cells")) return;
  const tinted = [[], [], [], []];
  visitGrid(scene.cellGrid, seen, (k) => tinted[scene.cells[k].tint].push(...scene.cells[k].filled.map(toPixels)));
  tinted.forEach((polygons, tint) => {
    ctx.beginPath();
    for (const z of polygons) pathPolygon(ctx, z, frame);
    ctx.fillStyle = colours["cell-" + tint];
    ctx.fill();
  });
  ctx.strokeStyle = colours.legal;
  ctx.lineWidth = tinted.flat().length > 500 ? 0.4 : 0.8;
  drawOutlines(ctx, tinted.flat(), frame);
}

function drawOutlines(ctx, polygons, frame) {
  if (polygons.length > DASHED) return;
  ctx.beginPath();
  for (const z of polygons)
    z.forEach((p, k) => {
      const q = z[(k + 1) % z.length];
      if (!cutLine(p[0], p[1], q[0], q[1], frame)) return;
      ctx.moveTo(cut[0], cut[1]);
      ctx.lineTo(cut[2], cut[3]);
    });
  ctx.stroke();
}

// Boxes of sure vertices, of undecided ones, and sure edges.
function drawVertices(ctx, scene, shown, seen, frame) {
  if (!scene.cells.length || !isLast(scene)) return;
  const boxes = (list, colour, dash, least) => {
    ctx.beginPath();
    for (const {x, y} of list) {
      if (x[0] > seen[1] || x[1] < seen[0] || y[0] > seen[3] || y[1] < seen[2]) continue;
      const z = [toX(x[0]), toX(x[1]), toY(y[1]), toY(y[0])], wide = Math.max(z[1] - z[0], least), high = Math.max(z[3] - z[2], least);
      ctx.rect((z[0] + z[1] - wide) / 2, (z[2] + z[3] - high) / 2, wide, high);
    }
    ctx.strokeStyle = colour;
    ctx.lineWidth = 1.2;
    ctx.setLineDash(dash);
    ctx.stroke();
    ctx.setLineDash([]);
  };
  if (shown.has("edges")) {
    ctx.strokeStyle = colours.legal;
    ctx.lineWidth = 1.4;
    ctx.beginPath();
    for (const e of scene.edges) {
      if (!cutLine(toX(e[0]), toY(e[1]), toX(e[2]), toY(e[3]), frame)) continue;
      ctx.moveTo(cut[0], cut[1]);
      ctx.lineTo(cut[2], cut[3]);
    }
    ctx.stroke();
  }
  if (shown.has("vertices")) boxes(scene.data.vertices, colours.legal, [], 5);
  if (shown.has("regions")) boxes(scene.data.regions, colours.indeterminate, [4, 3], 7);
}

// The cell of a marked point: its possible and its certain part.
function drawCellMark(ctx, scene, k, frame) {
  if (!scene.cellOf.has(k) || !isLast(scene)) return;
  const {inner, outer} = scene.cells[scene.cellOf.get(k)];
  ctx.strokeStyle = colours.mark;
  ctx.lineWidth = 1.5;
  ctx.setLineDash([5, 3]);
  drawOutlines(ctx, outer.map(toPixels), frame);
  ctx.setLineDash([]);
  ctx.lineWidth = 2.2;
  drawOutlines(ctx, [toPixels(inner)], frame);
}

function cellLines(scene, k) {
  if (!scene.cellOf.has(k)) return [];
  const {area, undetermined, tile_area: tile} = scene.cells[scene.cellOf.get(k)].cell, unit = scene.data.length_unit === "m" ? " m²" : "";
  return [element("dt", {}, "area of the cell"), element("dd", {id: "area"}, `${directed(area[0], 6, false)} … ${directed(area[1], 6, true)}${unit}`),
    ...(isTiles(scene) ? [element("dt", {}, "area of the tile"), element("dd", {id: "tile-area"}, `at most ${directed(tile, 6, true)}${unit}`)] :
      [element("dt", {}, "undecided"), element("dd", {}, `at most ${directed(100 * undetermined, 3, true)} %`)])];
}
