"use strict";
// Pictures as apps/output/files/packed_pictures.h packs them.

// What the bits of a half float stand for.
const halves = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
  const exponent = bits >> 10 & 31, fraction = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
  halves[bits] = sign * (exponent === 31 ? (fraction ? NaN : Infinity) : exponent ? (1024 + fraction) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}
// Bytes, of which 13 bits are in two characters, and 6 in a last one that is alone.
const digits = new Uint8Array(128);
[..."!\"#$%'()*+,-./0123456789:;=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[]^_`abcdefghijklmnopqrstuvwxyz{|}~"].forEach((c, k) => { digits[c.charCodeAt(0)] = k; });
const bytesOf = text => {
  const pairs = text.length >> 1, alone = text.length & 1, bytes = new Uint8Array(13 * pairs + 6 * alone >> 3);
  for (let k = 0, at = 0, bits = 0, count = 0; k < text.length; k += 2) {
    bits |= digits[text.charCodeAt(k)] + (k + 1 < text.length ? 91 * digits[text.charCodeAt(k + 1)] : 0) << count;
    for (count += k + 1 < text.length ? 13 : 6; count >= 8; count -= 8, bits >>>= 8) bytes[at++] = bits & 255;
  }
  return bytes;
};
const inflated = async text =>
  new Uint8Array(await new Response(new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
// Green and blue are kept less red.
const addRed = (values, n) => {
  for (let k = 0; k < n; ++k) { values[k + n] += values[k]; values[k + 2 * n] += values[k]; }
};
// The codes of errors are kept less those of the picture before, where it has some of that kind.
const addCodes = (errors, before = {}) => {
  for (const [kind, { codes }] of Object.entries(errors)) {
    const others = before[kind]?.codes;
    if (others) for (let k = 0; k < codes.length; ++k) codes[k] += others[k];
  }
};
// A picture's means, a plane a channel, and by kind the codes of its errors (see addCodes), with what they stand for.
const decoded = async (text, head, pixels) => {
  const n = 3 * pixels, bytes = await inflated(text), scale = 2 ** head.exponent;
  const bits = Uint16Array.from({ length: n }, (_, k) => bytes[k] << 8 | bytes[k + n]), errors = {};
  addRed(bits, pixels);
  let at = 2 * n;
  for (const { kind, channels, block, codes: count, low, step } of head.errors) {
    const values = Float64Array.from({ length: 256 }, (_, c) => c === 0 ? 0 : c === 255 ? Infinity : 2 ** (low + (c - 1) * step));
    const codes = bytes.subarray(at, at += count);
    if (channels === 3) addRed(codes, pixels);
    errors[kind] = { codes, values, block };
  }
  return { mean: Float32Array.from(bits, b => halves[b] * scale), errors };
};
