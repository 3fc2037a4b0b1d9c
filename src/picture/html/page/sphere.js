// SPDX-License-Identifier: LGPL-3.0-or-later
// A sphere: degrees as a map, sides along great circles. Lines beyond the meridian of 180 degrees continue at the other
// side.

const STEP = 2;          // degrees between places that are joined by straight lines
const MAP = [-180, 180]; // of longitudes

const radians = (degrees) => degrees * Math.PI / 180, degrees = (radians) => radians * 180 / Math.PI;
const inSpace = (lon, lat) => [Math.cos(radians(lat)) * Math.cos(radians(lon)), Math.cos(radians(lat)) * Math.sin(radians(lon)), Math.sin(radians(lat))];
const turns = (from, to) => 360 * Math.round((from - to) / 360); // that bring one longitude next to the other

// Appends the way from the last place of `line` to lon, lat, the shorter one; longitudes run on beyond 180 degrees. A pole
// is left, and reached, along the side of the map that represents it.
function goAlong(line, lon, lat) {
  if (Math.abs(line[line.length - 1]) === 90) line.push(lon + turns(line[line.length - 2], lon), line[line.length - 1]);
  const lon0 = line[line.length - 2], lat0 = line[line.length - 1], a = inSpace(lon0, lat0), b = inSpace(lon, lat);
  const dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  const angle = Math.atan2(cross, dot), count = cross < 1e-9 ? 1 : Math.ceil(degrees(angle) / STEP);
  for (let k = 1, last = lon0; k <= count; k++) {
    const s = Math.sin((1 - k / count) * angle) / cross, t = Math.sin(k / count * angle) / cross;
    const [x, y, z] = [0, 1, 2].map((axis) => s * a[axis] + t * b[axis]);
    const at = k < count ? degrees(Math.atan2(y, x)) : lon;
    if (k === count && Math.abs(lat) === 90) line.push(last, lat);
    line.push(last = at + turns(last, at), k < count ? degrees(Math.atan2(z, Math.hypot(x, y))) : lat);
  }
}

// The way along points; a closed one comes back to the first. Around a pole it goes along the pole's side of the map.
function wayAlong(scene, points, closed) {
  const at = (k) => [middle(scene, k, 0), middle(scene, k, 1)], line = at(points[0]);
  for (const k of closed ? [...points.slice(1), points[0]] : points.slice(1)) goAlong(line, ...at(k));
  const turned = line[line.length - 2] - line[0], pole = turned > 0 ? 90 : -90;
  if (closed && Math.abs(turned) > 180) line.push(line[line.length - 2], pole, line[0], pole);
  return Float64Array.from(line);
}

function spanOf(line, out) {
  out[0] = out[2] = Infinity;
  out[1] = out[3] = -Infinity;
  line.forEach((v, k) => { const e = 2 * (k & 1); out[e] = Math.min(out[e], v); out[e + 1] = Math.max(out[e + 1], v); });
  if (out[0] < MAP[0] || out[1] > MAP[1]) [out[0], out[1]] = MAP;
}

// Ways of pairs and triangles; a triangle no smaller than half of the sphere is omitted: it lies on the other side of its corners.
function makeWays(scene) {
  const {ends, triangles} = scene, pairs = [], rings = [];
  for (let p = 0; p < scene.pairs; p++) pairs.push(wayAlong(scene, [ends[2 * p], ends[2 * p + 1]], false));
  for (let k = 0; k < triangles.length; k += 3) {
    const corner = [...triangles.subarray(k, k + 3)], [a, b, c] = corner.map((q) => inSpace(middle(scene, q, 0), middle(scene, q, 1)));
    const volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    rings.push(volume > 0 ? wayAlong(scene, corner, true) : new Float64Array(0));
  }
  scene.ways = {pairs, rings};
}

// The part of the frame on the map.
const mapFrame = (frame) => [Math.max(frame[0], toX(MAP[0])), Math.min(frame[1], toX(MAP[1])), frame[2], frame[3]];

// Calls visit(shift) for each whole turn at which some of a way is on the map.
function visitTurns(line, visit) {
  const box = [];
  spanOf(line, box);
  for (const shift of box[0] === MAP[0] && box[1] === MAP[1] ? [-360, 0, 360] : [0]) visit(shift);
}

function pathWay(ctx, line, frame) {
  visitTurns(line, (shift) => {
    for (let k = 2; k < line.length; k += 2) {
      if (!cutLine(toX(line[k - 2] + shift), toY(line[k - 1]), toX(line[k] + shift), toY(line[k + 1]), frame)) continue;
      ctx.moveTo(cut[0], cut[1]);
      ctx.lineTo(cut[2], cut[3]);
    }
  });
}

function pathRing(ctx, line, frame) {
  if (!line.length) return;
  visitTurns(line, (shift) => {
    const z = [];
    for (let k = 0; k < line.length; k += 2) z.push([toX(line[k] + shift), toY(line[k + 1])]);
    pathPolygon(ctx, z, frame);
  });
}
