'use strict';
// Planes of numbers as numbers.h packs them, and the colours that they are shown in.

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Values of a packed side. `base`: values to which the packed differences are added, or undefined. */
async function unpacked({data, bytes, channels}, base) {
  const packed = await inflated(data);
  const count = packed.length / bytes;
  const values = new Uint32Array(count);
  for (let byte = 0; byte < bytes; ++byte) {
    for (let i = 0; i < count; ++i) values[i] |= packed[byte * count + i] << (8 * byte);
  }
  for (let i = channels; i < count; ++i) values[i] += values[i - channels];
  if (base) for (let i = 0; i < count; ++i) values[i] += base[i];
  if (bytes < 4) for (let i = 0; i < count; ++i) values[i] &= (1 << (8 * bytes)) - 1;
  return values;
}

/** A side's numbers. `scale` above 0: codes; 0: floats; below: whole numbers. */
class Numbers {
  constructor(values, scale, channels) {
    this.values = values;
    this.floats = new Float32Array(values.buffer);
    this.scale = scale;
    this.channels = channels;
  }
  /** What is compared: a code, a float, a whole number. */
  stored(i) {
    return this.scale > 0 ? this.values[i] : this.scale === 0 ? this.floats[i] : this.values[i] | 0;
  }
  value(i) {
    return this.scale > 0 ? this.values[i] / this.scale : this.stored(i);
  }
  /** Text of a pixel's numbers. Where `scale` is above 0, floats are given in codes of `scale`, with a fraction. */
  text(pixel, scale = this.scale) {
    const parts = [];
    for (let c = 0; c < this.channels; ++c) {
      const i = pixel * this.channels + c;
      const v = this.scale === 0 && scale > 0 ? Number((this.floats[i] * scale).toPrecision(7)) : this.stored(i);
      parts.push(numberText(v));
    }
    const codes = parts.join(' ');
    if (scale <= 255) return codes;
    return this.channels === 1 ? `${codes} (${numberText(this.value(pixel))})` : `${codes} /${scale}`;
  }
}

function numberText(v) {
  return Number.isFinite(v) ? String(Number(v.toPrecision(9))) : Number.isNaN(v) ? 'NaN' : v > 0 ? 'inf' : '-inf';
}

/**
 * Distance of two sides at a pixel, in codes or in the values' unit; Infinity: one of the two is no number. A number
 * that rounds to the other side's code is at distance 0.
 */
function apart(a, b, pixel) {
  let most = 0;
  for (let c = 0; c < a.channels; ++c) {
    const i = pixel * a.channels + c;
    const same = a.scale === b.scale, scale = Math.max(a.scale, b.scale);
    const v = same ? a.stored(i) : a.value(i) * scale, w = same ? b.stored(i) : b.value(i) * scale;
    if (v === w || (Number.isNaN(v) && Number.isNaN(w)) || (!same && Math.abs(v - w) <= 0.5)) continue;
    const off = Math.abs(v - w);
    most = Math.max(most, Number.isFinite(off) ? off : Infinity);
  }
  return most;
}

/** The view, unpacked: layers[].planes[side], marks[], comparisons[]. */
async function unpackedView(view) {
  const layers = [];
  for (const layer of view.layers) {
    const planes = [];
    for (const side of layer.sides) {
      const base = side?.base === null ? undefined : planes[side?.base];
      if (side === null) planes.push(null);
      else if (side.data === undefined) planes.push(base);  // no data: every number equals the base's
      else planes.push(new Numbers(await unpacked(side, base?.values), side.scale, side.channels));
    }
    layers.push({...layer, planes});
  }
  const marks = [];
  for (const data of view.marks) marks.push(await unpacked({data, bytes: 1, channels: 1}));
  const comparisons = JSON.parse(new TextDecoder().decode(await inflated(view.comparisons)));
  return {...view, layers, marks, comparisons};
}

// From dark blue over green to yellow: brighter is more, for any eye and in print.
const RAMP = [[69, 0, 84], [59, 82, 140], [33, 145, 140], [94, 201, 97], [253, 232, 38]];
function ramp(t) {
  if (!Number.isFinite(t)) return [255, 0, 255];
  const at = Math.min(Math.max(t, 0), 1) * (RAMP.length - 1);
  const i = Math.min(Math.floor(at), RAMP.length - 2);
  return RAMP[i].map((v, c) => v + (RAMP[i + 1][c] - v) * (at - i));
}

const byteOf = (v) => (Number.isFinite(v) ? Math.min(Math.max(v, 0), 1) * 255 : 255);
const fraction = (v) => (Number.isFinite(v) ? v - Math.floor(v) : 1);

/** Painters: each makes a function from a pixel to its colour, for one side of a layer. */
const PAINTERS = {
  color: (_view, numbers) => (p) => [0, 1, 2].map((c) => byteOf(numbers.value(4 * p + c))),
  id: (_view, numbers) => (p) => {
    const id = numbers.stored(p);
    if (id < 0) return [0, 0, 0];
    const h = Math.imul(id + 1, 0x9e3779b1) >>> 0;  // neighbouring numbers get colours far apart
    return [24, 16, 8].map((shift) => 64 + 0.75 * ((h >>> shift) & 255));
  },
  count: (_view, numbers) => (p) => (numbers.stored(p) === 0 ? [0, 0, 0] : ramp((numbers.stored(p) - 1) / 7)),
  stencil: (_view, numbers) => (p) => (numbers.stored(p) === 0 ? [0, 0, 0] : ramp(numbers.stored(p) / 255)),
  lod: (_view, numbers) => (p) => (Number.isNaN(numbers.value(p)) ? [0, 0, 0] : ramp(numbers.value(p) / 8)),
  coordinates: (_view, numbers) => (p) => [byteOf(fraction(numbers.value(4 * p))), byteOf(fraction(numbers.value(4 * p + 1))), 0],
  depth: (view, numbers, layer, side) => {
    const drawn = (of, p) => of >= 0 && !isBackground(view, of, p) && Number.isFinite(layer.planes[of].value(p));
    let low = Infinity, high = -Infinity;
    layer.planes.forEach((plane, of) => {
      if (plane === null) return;
      for (let p = 0; p < plane.values.length; ++p) {
        if (!drawn(of, p)) continue;
        low = Math.min(low, plane.value(p));
        high = Math.max(high, plane.value(p));
      }
    });
    const share = (p) => (high > low ? (numbers.value(p) - low) / (high - low) : 0);
    const level = (p) => (drawn(side, p) ? Math.floor(share(p) * 20) : -1);
    return (p) => {
      if (!drawn(side, p)) return [0, 0, 0];
      const edge = ((p + 1) % view.columns !== 0 && level(p + 1) !== level(p)) ||
                   (p + view.columns < numbers.values.length && level(p + view.columns) !== level(p));
      return ramp(1 - share(p)).map((v) => (edge ? 0.45 * v : v));
    };
  },
};

/** True: by the side's plane of winners, no primitive won the pixel. */
function isBackground(view, side, pixel) {
  const ids = view.layers.find((layer) => layer.paint === 'id')?.planes[side];
  return ids ? ids.stored(pixel) < 0 : false;
}
