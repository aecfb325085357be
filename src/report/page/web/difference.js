'use strict';
// Difference of two sides' pixels, as a picture with its legend.

const CLASSES = [
  {name: 'equal', color: [0, 0, 0]},  // shown as the picture itself, in dark grey
  {name: 'apart', color: [240, 190, 40]},
  {name: 'beyond the tolerance', color: [235, 40, 40]},
  {name: 'disputed', color: [60, 150, 255]},
  {name: 'on one side alone', color: [0, 200, 200]},
];

/**
 * Difference of a layer's side 0 from side `against`: class and distance of each pixel, number of pixels by class, and
 * largest distance. `marks`: the chosen row's mark of each pixel (1: beyond its tolerance, 2: disputed), or null.
 */
function differenceOf(view, layer, against, marks) {
  const [a, b] = [layer.planes[0], layer.planes[against]];
  if (!a || !b || a.channels !== b.channels) return null;
  const count = a.values.length / a.channels;
  const out = {classes: new Uint8Array(count), sizes: new Float64Array(count), counts: [0, 0, 0, 0, 0], largest: 0};
  const ofFragments = layer.paint !== 'count' && layer.paint !== 'stencil';
  for (let p = 0; p < count; ++p) {
    const alone = ofFragments && isBackground(view, 0, p) !== isBackground(view, against, p) && hasIds(view, against);
    const off = a === b ? 0 : apart(a, b, p);
    out.sizes[p] = layer.paint === 'id' ? Math.min(off, 1) : off;
    const mark = marks ? marks[p] : 0;
    out.classes[p] = mark === 1 ? 2 : mark === 2 ? 3 : off === 0 ? 0 : alone ? 4 : 1;
    ++out.counts[out.classes[p]];
    if (!alone) out.largest = Math.max(out.largest, out.sizes[p]);
  }
  return out;
}

const hasIds = (view, side) => {
  const ids = view.layers.find((layer) => layer.paint === 'id');
  return Boolean(ids?.planes[0] && ids.planes[side]);
};

/** Painter of a difference: brighter is farther apart; full brightness at a distance of `much`. */
function differencePainter(difference, painter, much) {
  return (p) => {
    const kind = difference.classes[p];
    if (kind === 0) {
      const [r, g, b] = painter(p);
      return Array(3).fill(0.3 * (0.2126 * r + 0.7152 * g + 0.0722 * b));
    }
    if (kind === 4) return CLASSES[kind].color;
    const least = kind === 1 ? 0.2 : 0.5;  // what no row objects to stays in the background
    const share = Math.min(Math.max(1 + Math.log10(difference.sizes[p] / much) / 2, least), 1);
    return CLASSES[kind].color.map((v) => v * share);
  };
}

/** Distance painted brightest: a tenth of the range of codes or values, 1e-3 of float depths, 1 of whole numbers. */
const muchOf = (numbers, paint) =>
  numbers.scale > 0 ? 0.1 * numbers.scale : numbers.scale < 0 ? 1 : paint === 'depth' ? 1e-3 : 0.1;

function differenceText(difference, numbers, paint) {
  const off = difference.counts.reduce((sum, n) => sum + n, 0) - difference.counts[0];
  if (off === 0) return 'no pixel differs';
  const by = paint === 'id' || difference.largest === 0 ? '' :
    `, by ${numberText(difference.largest)}${numbers.scale > 0 ? `/${numbers.scale}` : ''} at most`;
  return `${off} pixels differ${by}`;
}

function differenceLegend(difference, isJudged) {
  const host = element('div', {className: 'legend'});
  CLASSES.forEach(({name, color}, kind) => {
    const shown = kind === 0 ? [70, 70, 70] : color;
    if (difference.counts[kind] === 0) return;
    host.append(element('span', {}, element('i', {style: `background: rgb(${shown.join(' ')})`}),
                        `${kind === 1 && isJudged ? 'apart, as is allowed' : name}: ${difference.counts[kind]}`));
  });
  return host;
}
