"use strict";
// Unpacks the pictures that apps/output/files/packed_pictures.h packs.

// The value of a half float, indexed by its 16 bits.
const halves = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
  const exponent = bits >> 10 & 31, fraction = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
  halves[bits] = sign * (exponent === 31 ? (fraction ? NaN : Infinity) : exponent ? (1024 + fraction) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}
// The bytes of a text of 91 different characters: each two characters hold 13 bits, and a single last one holds 6.
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
// Undoes the subtraction of the red channel from green and blue. `n`: values of a channel.
const addRed = (values, n) => {
  for (let k = 0; k < n; ++k) { values[k + n] += values[k]; values[k + 2 * n] += values[k]; }
};
// Undoes the subtraction of the previous picture's codes of errors, kind by kind, where the previous picture has errors of that
// kind.
const addCodes = (errors, before = {}) => {
  for (const [kind, { codes }] of Object.entries(errors)) {
    const others = before[kind]?.codes;
    if (others) for (let k = 0; k < codes.length; ++k) codes[k] += others[k];
  }
};
// Returns the means of a picture, channel by channel, and its errors by kind: `codes`, which addCodes() has to complete, `values`,
// the standard error of each code, and `block`, the side in pixels of the square that shares a code.
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
