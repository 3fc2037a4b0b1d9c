// SPDX-License-Identifier: LGPL-3.0-or-later
// Facts about points and pairs, as of the stage shown.

// Boxes are x lower, x upper, y lower, y upper, point after point. status[p], since[p]: of pair p at this stage, and the
// stage from which on it is so. end: of pairs of each point, one list behind the other (first[n] .. first[n + 1]).
function makeScene(data) {
  const n = data.points.length, final = new Float64Array(4 * n);
  data.points.forEach((p, k) => [...p.x, ...p.y].forEach((text, e) => { final[4 * k + e] = toDouble(text); }));
  const scene = {data, n, final, box: final.slice(), stages: [], stage: 0, triangles: readTriangles(data.triangles),
    globe: data.surface === "sphere", numberOf: new Map(data.points.map((p, k) => [p.i, k]))};
  const known = new Map(), ends = [];
  for (const stage of data.stages) {
    const pair = [], status = [];
    STATUS.forEach((name, s) => readPairs(stage[name], (i, j) => {
      const key = i * n + j;
      if (!known.has(key)) { known.set(key, known.size); ends.push(i, j); }
      pair.push(known.get(key));
      status.push(s);
    }));
    scene.stages.push({pair: Uint32Array.from(pair), status: Uint8Array.from(status), boxes: stage.boxes, final: stage.final});
  }
  scene.pairs = known.size;
  scene.ends = Uint32Array.from(ends);
  scene.status = new Uint8Array(scene.pairs);
  scene.since = new Uint32Array(scene.pairs);
  scene.sides = triangleSides(scene, known);
  if (data.plan) readPlan(scene, known);
  Object.assign(scene, partnersByPoint(scene));
  return scene;
}

// rank[p]: of the point of the plan that decides pair p, 0: none. place[k]: the rank of point k, 0: it is not in the plan.
function readPlan(scene, known) {
  const {plan} = scene.data, at = (row) => scene.numberOf.get(row);
  scene.rank = new Uint32Array(scene.pairs);
  scene.place = new Uint32Array(scene.n);
  plan.points.forEach(([row], k) => { if (at(row) !== undefined) scene.place[at(row)] = k + 1; });
  for (const [i, j, rank] of plan.pairs) {
    const p = known.get(Math.min(at(i), at(j)) * scene.n + Math.max(at(i), at(j)));
    if (p !== undefined) scene.rank[p] = rank;
  }
}

// Ranks in four classes of colours, 1 to 4; 0: no rank.
const planClass = (scene, rank) => (rank ? 1 + Math.floor(4 * (rank - 1) / scene.data.plan.points.length) : 0);

// The pairs that are the sides of each triangle.
function triangleSides(scene, known) {
  const t = scene.triangles, out = new Uint32Array(t.length);
  for (let k = 0; k < t.length; k++) {
    const a = t[k], b = t[k % 3 === 2 ? k - 2 : k + 1];
    out[k] = known.get(Math.min(a, b) * scene.n + Math.max(a, b));
  }
  return out;
}

function partnersByPoint({n, ends}) {
  const first = new Uint32Array(n + 1), own = new Uint32Array(ends.length);
  for (const i of ends) first[i + 1]++;
  for (let i = 0; i < n; i++) first[i + 1] += first[i];
  const next = first.slice();
  ends.forEach((i, k) => { own[next[i]++] = k >> 1; });
  return {first, own};
}

// Goes to a stage, from 1 to scene.stages.length; the last one shows the final result.
function setStage(scene, stage) {
  if (stage < scene.stage) {
    scene.stage = 0;
    scene.status.fill(ILLEGAL);
    scene.box.set(scene.final);
  }
  while (scene.stage < stage) applyStage(scene, scene.stages[scene.stage++]);
  if (isLast(scene)) scene.box.set(scene.final);
  scene.count = [0, 0, 0, 0];
  for (const s of scene.status) scene.count[s]++;
}

const isLast = (scene) => scene.stage === scene.stages.length;

function applyStage(scene, {pair, status, boxes, final}) {
  pair.forEach((p, k) => { scene.status[p] = status[k]; scene.since[p] = scene.stage; });
  for (let k = 0; k < boxes.length; k += 5)
    for (let e = 0; e < 4; e++) scene.box[4 * boxes[k] + e] = boxes[k + 1 + e] ?? (e & 1 ? 1 : -1) * 1e300;
  for (const k of final) scene.box.set(scene.final.subarray(4 * k, 4 * k + 4), 4 * k);
}

// A triangle is sure once its sides are: no point can cross one of them from then on.
function triangleIsSure({status, sides}, k) {
  return status[sides[k]] === LEGAL && status[sides[k + 1]] === LEGAL && status[sides[k + 2]] === LEGAL;
}

function middle(scene, k, axis) {
  return scene.box[4 * k + 2 * axis] / 2 + scene.box[4 * k + 2 * axis + 1] / 2;
}

function nameOf(scene, k) {
  return scene.data.points[k].id ?? String(scene.data.points[k].i);
}

// Partners of a point by status: numbers of pairs.
function partners(scene, k) {
  const out = [[], [], [], []];
  for (let e = scene.first[k]; e < scene.first[k + 1]; e++) out[scene.status[scene.own[e]]].push(scene.own[e]);
  return out;
}

function otherEnd(scene, pair, k) {
  return scene.ends[2 * pair] === k ? scene.ends[2 * pair + 1] : scene.ends[2 * pair];
}
