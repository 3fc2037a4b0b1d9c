// SPDX-License-Identifier: LGPL-3.0-or-later
// The data of the page: base64, packed by zlib, JSON. Numbers that are texts are exact.

const STATUS = ["illegal", "tie", "indeterminate", "legal"];
const [ILLEGAL, TIE, INDETERMINATE, LEGAL] = [0, 1, 2, 3];

async function unpack(text) {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; k++) bytes[k] = binary.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

// m * 2^e near a double, where m alone or 2^e alone may be none.
function scaled(m, e) {
  let value = Number(m);
  if (!Number.isFinite(value)) {
    const big = BigInt(m), drop = big.toString(16).length * 4 - 1000;
    value = Number(big >> BigInt(drop));
    e += drop;
  }
  const half = Math.trunc(e / 2);
  return value * 2 ** half * 2 ** (e - half);
}

// A double next to an exact number: "7", "-3*2^-5", "22/7". For drawing alone.
function toDouble(text) {
  const star = text.indexOf("*2^"), slash = text.indexOf("/");
  if (star >= 0) return scaled(text.slice(0, star), Number(text.slice(star + 3)));
  if (slash < 0) return scaled(text, 0);
  const p = BigInt(text.slice(0, slash)), q = BigInt(text.slice(slash + 1));
  const shift = Math.max(0, q.toString(16).length - p.toString(16).length + 1) * 4 + 64;
  return scaled(String((p << BigInt(shift)) / q), -shift);
}

// The lists of pairs: differences to the pair before, and from i to j.
function readPairs(list, visit) {
  for (let k = 0, i = 0; k < list.length; k += 2) visit(i += list[k], i + list[k + 1]);
}

function readTriangles(list) {
  const out = new Uint32Array(list.length);
  for (let k = 0, i = 0; k < list.length; k += 3) {
    out[k] = i += list[k];
    out[k + 1] = i + list[k + 1];
    out[k + 2] = i + list[k + 2];
  }
  return out;
}
