// SPDX-License-Identifier: LGPL-3.0-or-later
// The panel next to the map: stages, layers, the point selected.

const $ = (id) => document.getElementById(id);

function element(tag, attributes = {}, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "onclick") out.addEventListener("click", value);
    else out.setAttribute(name, value);
  }
  out.append(...children);
  return out;
}

// The layers: name, meaning; the first list of diagrams only.
const CELLS = [
  ["cells", "certainly nearest to a point"],
  ["bands", "undecided"],
  ["vertices", "boxes of certain vertices"],
  ["regions", "boxes of undecided vertices"],
  ["edges", "certain Voronoi edges"],
];
const PAIRS = [
  ["legal", "legal: for every choice"],
  ["indeterminate", "indeterminate: for some"],
  ["tie", "tie: stays undecided"],
  ["triangles", "certain triangles"],
  ["areas", "where these edges may be"],
  ["boxes", "points, rectangles"],
  ["names", "numbers or names"],
];

// Of a graph of neighbours there are edges alone, and areas of the plane are none of a sphere.
const OF_GRAPHS = {legal: "certain: for every choice", indeterminate: "possible: for some"};
const OF_PLANS = {legal: "legal already", indeterminate: "undecided: in the colour of the point that decides it, dotted if none does", names: "ranks: points"};
function pairEntries({data}) {
  if (data.graph) return PAIRS.filter(([name]) => !["tie", "triangles"].includes(name)).map(([name, text]) => [name, OF_GRAPHS[name] ?? text]);
  if (data.plan) return PAIRS.filter(([name]) => !["tie", "areas"].includes(name)).map(([name, text]) => [name, OF_PLANS[name] ?? text]);
  return data.surface === "sphere" ? PAIRS.filter(([name]) => name !== "areas") : PAIRS;
}

// What a layer shows first.
const LAYERS = {
  pairs: PAIRS.map(([name]) => name), points: ["boxes", "names"], triangles: ["triangles", "boxes", "names"],
  cells: ["cells", "bands", "boxes", "names"], vertices: ["vertices", "cells", "bands", "boxes", "names"],
  regions: ["regions", "cells", "bands", "boxes", "names"], edges: ["edges", "boxes", "names"], tiles: ["cells", "boxes", "names"],
};

function buildLegend(scene, shown, onChange) {
  const entries = pairEntries(scene);
  const cells = isTiles(scene) ? [["cells", "tile of one point"], ...CELLS.slice(2)] : CELLS;
  for (const [name, text] of scene.cells.length ? [...cells, ...entries] : entries) {
    const box = element("input", {type: "checkbox", id: "show-" + name});
    box.checked = shown.has(name);
    box.addEventListener("change", () => {
      if (box.checked) shown.add(name); else shown.delete(name);
      onChange();
    });
    const count = element("span", {class: "count", id: "count-" + name});
    $("legend").append(element("label", {}, box, element("i", {class: /s$/.test(name) ? "patch " + name : name}),
      scene.data.discs ? text.replace("rectangles", "discs") : text, count));
  }
}

const grouped = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, ","); // toLocaleString takes 30 ms at first

function showCounts(scene) {
  const tell = (name, n) => { if ($("count-" + name)) $("count-" + name).textContent = grouped(n); };
  for (const s of [TIE, INDETERMINATE, LEGAL]) tell(STATUS[s], scene.count[s]);
  let sure = 0;
  for (let k = 0; k < scene.triangles.length; k += 3) sure += triangleIsSure(scene, k);
  tell("triangles", sure);
  $("count-boxes").textContent = grouped(scene.n);
  if (!scene.cells.length) return;
  for (const name of ["cells", "vertices", "regions", "edges"]) $("count-" + name).textContent = grouped(scene[name]?.length ?? scene.data[name].length);
}

function showSummary({data, n}) {
  const goal = data.goal === "decided" ? "" : `, goal ${data.goal} 2^-${data.goal_bits}`;
  const part = n === data.sites ? "" : ` of ${grouped(data.sites)}`;
  const title = {delaunay: "Delaunay triangulation", plan: "Plan of measurements", voronoi: "Voronoi diagram", converge: "Convergence"}[data.kind];
  const what = data.graph ? data.graph[0].toUpperCase() + data.graph.slice(1) : title + (data.surface && !data.plan ? " of a " + data.surface : "");
  $("title").textContent = data.name ? `${data.name}: ${what}` : what;
  document.title = `${data.name ?? "dyadel"}: ${what}`;
  $("summary").textContent = `${grouped(n)}${part} points, outcome ${data.outcome}${goal}` +
    (data.capped ? "; the cap on pairs was met: not all possible pairs are known" : "");
  const bound = (value) => decimalOf(value, value).text;
  $("about").textContent = (data.crs ? `Coordinates are those of ${data.crs}. ` : "") +
    (data.window ? `Window: x from ${bound(data.window[0])} to ${bound(data.window[1])}, y from ${bound(data.window[2])} to ${bound(data.window[3])}. ` : "") +
    (data.undetermined_area ? `Undecided area: at most ${upper(data.undetermined_area)}. ` : "") +
    (data.distance_to_true_diagram ? `Distance to the true diagram: at most ${upper(data.distance_to_true_diagram)}. ` : data.cells ? "The distance to the true diagram is not known. " : "") +
    (data.tolerance ? `No edge changes while every point stays within ${data.tolerance[0] === null ? "any distance" : directed(data.tolerance[0], 4, false)} of its place. ` : "");
  $("rounding").textContent = "Decimals are rounded outward, and ≈ marks those rounded to nearest; m*2^e and p/q are exact" +
    (data.unit === undefined ? "" : `. Polygons are drawn in multiples of 2^${data.unit}`) +
    ". Drawings are rounded to pixels: the statuses are proved, the drawing is not.";
}

// Points far from all others, that leave these little of the map: more than FAR times the range of the middle half away.
function findOutliers(scene) {
  const FAR = 20, MOST = Math.max(1, Math.floor(scene.n / 50)), out = new Set();
  for (const axis of scene.n < 5 || scene.globe ? [] : [0, 1]) {
    const at = (k) => scene.final[4 * k + 2 * axis] / 2 + scene.final[4 * k + 2 * axis + 1] / 2;
    const sorted = Float64Array.from({length: scene.n}, (_, k) => at(k)).sort(), low = sorted[scene.n >> 2], high = sorted[(3 * scene.n) >> 2];
    for (let k = 0; k < scene.n && high > low; k++) if (at(k) < low - FAR * (high - low) || at(k) > high + FAR * (high - low)) out.add(k);
  }
  return out.size > MOST ? [] : [...out];
}

// choose(k) shows a point, fit(list) all but these.
function showOutliers(scene, choose, fit) {
  const far = findOutliers(scene);
  $("outliers").hidden = !far.length;
  $("outliers").replaceChildren(`${far.length === 1 ? "One point is" : far.length + " points are"} far from all others: `,
    ...far.slice(0, 8).map((k) => element("button", {onclick: () => choose(k)}, nameOf(scene, k))), element("button", {id: "fit-others", onclick: () => fit(far)}, "Fit the others"));
}

// ---- plans ----

// The points to measure, in order.
function showPlan(scene, choose) {
  const {plan} = scene.data, MOST = 200;
  if (!plan) return;
  $("plan").hidden = false;
  document.documentElement.style.setProperty("--legal", "var(--decided)");
  const left = plan.points.length ? plan.points.at(-1)[4] : plan.pairs.length;
  $("plan-about").textContent = `${grouped(plan.points.length)} points, ${grouped(left)} of ${grouped(plan.pairs.length)} undecided pairs stay so` +
    (plan.finished ? "." : "; the plan is not finished.");
  $("plan-points").replaceChildren(...plan.points.slice(0, MOST).map(([row, , needed, decided], k) => {
    const at = scene.numberOf.get(row), name = at === undefined ? String(row) : nameOf(scene, at);
    return element("li", {class: "plan-" + planClass(scene, k + 1)},
      element("button", {onclick: () => { if (at !== undefined) choose(at); }}, name), ` ±${needed}: ${decided} pair${decided === 1 ? "" : "s"}`);
  }));
}

function planLines(scene, k) {
  const rank = scene.place?.[k];
  if (!rank) return [];
  const [, now, needed, decided, left] = scene.data.plan.points[rank - 1], unit = scene.globe ? " m" : "";
  return [element("dt", {}, "measure"), element("dd", {id: "measure"}, `as number ${rank}, within ${needed}${unit} (now ${now}${unit}): decides ${decided}, leaves ${left}`)];
}

// ---- stages ----

function buildStages(scene, go) {
  const last = scene.stages.length;
  if (last < 2) return;
  $("stages").hidden = false;
  $("stage").max = last;
  $("stage").addEventListener("input", () => go(Number($("stage").value)));
  const counts = scene.stages.map((_, k) => { setStage(scene, k + 1); return scene.count; });
  const most = Math.max(...counts.map((c) => c[TIE] + c[INDETERMINATE] + c[LEGAL]), 1);
  counts.forEach((c, k) => {
    const bar = element("div", {title: "stage " + (k + 1), onclick: () => go(k + 1)});
    for (const s of [TIE, INDETERMINATE, LEGAL]) {
      const part = element("div", {class: STATUS[s]});
      part.style.height = `${100 * c[s] / most}%`;
      bar.append(part);
    }
    $("chart").append(bar);
  });
}

function showStage(scene) {
  $("stage").value = scene.stage;
  $("stage-number").textContent = `${scene.stage} of ${scene.stages.length}`;
  [...$("chart").children].forEach((bar, k) => bar.classList.toggle("now", k + 1 === scene.stage));
  const row = scene.data.convergence?.stages[scene.stage - 1];
  if (row) showRow(row);
  if (scene.cells.length) $("row").replaceChildren(element("dd", {}, isLast(scene) ? "" : "Cells are those of the last stage; here are the pairs."));
}

// The line of the table of converge.
function showRow(row) {
  const bound = (value) => (value ? "≤ " + upper(value) : "not known");
  const lines = [["bits asked for", `${row.bits_least} to ${row.bits_most}, ${grouped(row.bits_total)} in all`],
    ["widths", `largest ${bound(row.width_largest)}, median ${bound(row.width_median)}`],
    ["undecided faces", grouped(row.faces)], ["area open", bound(row.area)], ["Hausdorff distance", bound(row.hausdorff)]];
  if (row.v_area) lines.push(["Voronoi: area open", bound(row.v_area)], ["Voronoi: distance", bound(row.v_hausdorff)]);
  lines.push(["stream calls", grouped(row.calls)]);
  if ("seconds" in row) lines.push(["seconds", row.seconds]);
  $("row").replaceChildren(...lines.flatMap(([term, value]) => [element("dt", {}, term), element("dd", {}, String(value))]));
}

// ---- a point ----

// A decimal of the given number of digits, not above (below) v.
function directed(v, digits, up) {
  const near = Number(v.toPrecision(digits));
  if (up ? near >= v : near <= v) return String(near);
  const step = 10 ** (Math.floor(Math.log10(Math.abs(v))) - digits + 1);
  return String(Number((v + (up ? step : -step)).toPrecision(digits)));
}

// A bound, as json has it, rounded up.
function upper({decimal, exact}) {
  return decimal === null ? exact : directed(decimal, 4, true);
}

// A side of a box as a decimal, then exactly where that says less.
function sideLines(scene, k, axis) {
  const point = scene.data.points[k], name = "xy"[axis], text = point[name], at = 4 * k + 2 * axis;
  const box = scene.box.subarray(at, at + 2), final = scene.final.subarray(at, at + 2);
  const now = box[0] === final[0] && box[1] === final[1], unit = {m: " m", degree: "°"}[scene.data.length_unit] ?? "";
  const near = now || Math.abs(box[1] - box[0]) < 1e299 ? decimalOf(...(now ? text : box)) : {text: "not known", exact: true};
  const lines = [element("dt", {}, scene.globe ? ["longitude", "latitude"][axis] : name), element("dd", {id: "side-" + name}, near.text + unit)];
  const exact = text[0] === text[1] ? text[0] : `[${text[0]}, ${text[1]}]`;
  return near.exact || !now ? lines : [...lines, element("dd", {class: "exact", id: "exact-" + name}, exact)];
}

const PARTNERS = {[LEGAL]: "legal", [INDETERMINATE]: "undecided", [TIE]: "tied"}, OF_GRAPH = {[LEGAL]: "certain", [INDETERMINATE]: "possible"};

function partnerLines(scene, k, choose) {
  const own = partners(scene, k);
  const words = scene.data.graph ? OF_GRAPH : PARTNERS;
  return [LEGAL, INDETERMINATE, TIE].filter((s) => words[s]).flatMap((s) => {
    const others = own[s].map((p) => [otherEnd(scene, p, k), scene.since[p]]).sort((a, b) => a[0] - b[0]);
    const list = others.map(([other, since]) => element("button", {title: `${words[s] === PARTNERS[s] ? STATUS[s] : words[s]} since stage ${since}`, onclick: () => choose(other)}, nameOf(scene, other)));
    return [element("dt", {}, `${words[s]} (${others.length})`), element("dd", {class: "partners", id: "partners-" + STATUS[s]}, ...list)];
  });
}

function showPoint(scene, k, kept, choose) {
  if (k === null) {
    $("card").replaceChildren(element("h2", {}, "A point"), element("p", {}, "Hover over a point, or search for it, to see its rectangle and neighbours."));
    return;
  }
  const point = scene.data.points[k], lines = [...sideLines(scene, k, 0), ...sideLines(scene, k, 1)];
  const same = scene.data.aliases.filter(([, of]) => of === point.i).map(([row]) => row);
  if (same.length) lines.push(element("dt", {}, "duplicates"), element("dd", {}, same.join(", ")));
  if (point.hull) lines.push(element("dt", {}, "corner of the hull"), element("dd", {}, point.hull));
  if (point.rho !== undefined) lines.push(element("dt", {}, "tolerance"), element("dd", {id: "rho", title: "all points may move this far at once without a change at this one"}, point.rho === null ? "without bound" : String(point.rho)));
  lines.push(...planLines(scene, k), ...cellLines(scene, k), ...partnerLines(scene, k, choose));
  const title = "id" in point ? `${point.id} (point ${point.i})` : `Point ${point.i}`;
  $("card").replaceChildren(element("h2", {}, title), element("dl", {}, ...lines), element("p", {}, kept ? "Pinned. Esc to release." : "Click to pin it."));
}

// ---- finding ----

// Points whose number is the text, then those whose name begins with it, then those whose name holds it.
function findPoints(scene, text) {
  const MOST = 8, wanted = text.trim().toLowerCase(), best = [], begin = [], hold = [];
  if (!wanted) return [];
  const alias = scene.data.aliases.find(([row]) => String(row) === wanted);
  scene.data.points.forEach((p, k) => {
    const name = p.id?.toLowerCase() ?? "";
    if (String(p.i) === wanted || name === wanted || (alias && p.i === alias[1])) best.push(k);
    else if (name.startsWith(wanted) || (!("id" in p) && String(p.i).startsWith(wanted))) begin.push(k);
    else if (name.includes(wanted)) hold.push(k);
  });
  return [...best, ...begin, ...hold].slice(0, MOST);
}

function showFound(scene, choose) {
  const found = findPoints(scene, $("query").value), open = $("query").value.trim() !== "";
  const title = (k) => ("id" in scene.data.points[k] ? `${scene.data.points[k].id} (${scene.data.points[k].i})` : String(scene.data.points[k].i));
  $("found").replaceChildren(...found.map((k) => element("li", {}, element("button", {type: "button", onclick: () => choose(k)}, title(k)))));
  if (open && !found.length) $("found").append(element("li", {}, "no such point"));
  $("found").hidden = !open;
  return found;
}
