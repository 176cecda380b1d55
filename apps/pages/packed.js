"use strict";
// Pictures as apps/pages/packed_pictures.h packs them.

// What the bits of a half float stand for.
const halves = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
  const exponent = bits >> 10 & 31, fraction = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
  halves[bits] = sign * (exponent === 31 ? (fraction ? NaN : Infinity) : exponent ? (1024 + fraction) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}
const inflated = async text => {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
};
// A picture's means, a plane a channel, and by kind the codes of its errors with what they stand for.
const decoded = async (text, head, pixels) => {
  const bytes = await inflated(text), n = 3 * pixels, scale = 2 ** head.exponent;
  const mean = new Float32Array(n), errors = {};
  for (let k = 0; k < n; ++k) mean[k] = halves[bytes[k] << 8 | bytes[k + n]] * scale;
  head.errors.forEach(({ kind, low, step }, e) => {
    const values = Float64Array.from({ length: 256 }, (_, c) => c === 0 ? 0 : c === 255 ? Infinity : 2 ** (low + (c - 1) * step));
    errors[kind] = { codes: bytes.subarray((2 + e) * n, (3 + e) * n), values };
  });
  return { mean, errors };
};
