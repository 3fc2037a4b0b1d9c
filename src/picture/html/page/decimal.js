// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact numbers as decimals: as many digits as a rectangle needs, rounded outward.

// [p, q] with q > 0: the number of an exact text ("7", "-3*2^-5", "22/7") or of a double.
function fractionOf(number) {
  if (typeof number === "number") {
    let e = 0;
    for (; !Number.isInteger(number); e++) number *= 2;
    return [BigInt(number), 1n << BigInt(e)];
  }
  const [text, power] = number.split("*2^"), [p, q] = text.split("/").map(BigInt), e = BigInt(power ?? 0);
  return e < 0n ? [p, 1n << -e] : [p << e, q ?? 1n];
}

const floorOf = (p, q) => (p % q < 0n ? p / q - 1n : p / q); // of p / q, where q > 0

// n * 10^-d, without zeros at the end; small ones with an exponent.
function decimalText(n, d) {
  for (; d > 0 && n % 10n === 0n; d--) n /= 10n;
  const sign = n < 0n ? "-" : "", digits = String(n < 0n ? -n : n);
  if (d === 0) return sign + digits;
  if (d - digits.length >= 6) return `${sign}${digits[0]}${digits.length > 1 ? "." + digits.slice(1) : ""}e${digits.length - 1 - d}`;
  const padded = digits.padStart(d + 1, "0");
  return `${sign}${padded.slice(0, -d)}.${padded.slice(-d)}`;
}

// The interval [lo, hi] as "MIDDLE±RADIUS" that holds it and is at most a hundredth wider, or as long as MOST digits allow; exact:
// is it the interval itself? A single number has no radius, and "≈" where it is no short decimal.
function decimalOf(lo, hi) {
  const MOST = 28, [a, b] = fractionOf(lo), [c, e] = fractionOf(hi), q = 2n * b * e, middle = a * e + c * b, radius = c * b - a * e;
  if (!radius) return decimalPoint(lo);
  for (let d = 0, ten = 1n; ; d++, ten *= 10n) {
    const n = floorOf(2n * middle * ten + q, 2n * q), off = middle * ten - n * q;
    const wide = (off < 0n ? -off : off) + radius * ten, r = -floorOf(-wide, q), long = String(n).length > MOST || d > 400;
    if (r * q * 100n > 101n * radius * ten && !long) continue;
    return {text: `${decimalText(n, d)}±${decimalText(r, d)}`, exact: off === 0n && r * q === wide};
  }
}

function decimalPoint(number) {
  const LONGEST = 17, DIGITS = 12, [p, q] = fractionOf(number);
  for (let d = 0, ten = 1n; d <= LONGEST; d++, ten *= 10n)
    if (p * ten % q === 0n && String(p * ten / q).length <= LONGEST) return {text: decimalText(p * ten / q, d), exact: true};
  const near = typeof number === "number" ? number : toDouble(number);
  return {text: `≈ ${Number(near.toPrecision(DIGITS))}`, exact: false};
}
