'use strict';
// Pictures of two sides and their difference, side by side, under a slider or in turns, with each pixel's numbers.

const MODES = ['side by side', 'slider', 'flicker'];
const GRID_FROM = 8;  // least scale at which lines separate pixels [screen pixels per pixel]
const MOST = 64;
const THINNEST = 4;  // least width and height of a picture [screen pixels]

class Viewer {
  /** `view`: of unpackedView(). `changed(viewer)` is called whenever its state, which an address may keep, changes. */
  constructor(view, changed = () => {}) {
    this.view = view;
    this.changed = changed;
    this.layer = view.layers[0];
    this.against = Math.min(1, view.sides.length - 1);
    this.mode = MODES[0];
    this.pixel = null;
    this.marks = null;
    this.judging = '';  // the stage whose tolerance the marks are beyond
    this.scale = 0;  // screen pixels a pixel; 0: the whole picture fits
    this.middle = [view.columns / 2, view.rows / 2];  // of what is shown, in pixels from the upper left
    this.second = false;  // which one flicker shows
    this.cut = 50;
    this.build();
  }

  build() {
    const {view} = this;
    this.layers = new Choice('picture', view.layers.map((l) => l.name), (name) => this.set({layer: name}));
    this.sides = new Choice('against', view.sides.slice(1), (name) => this.set({against: name}));
    this.modes = new Choice('as', MODES, (mode) => this.set({mode}));
    const zoom = element('div', {className: 'set', role: 'group', ariaLabel: 'zoom'});
    for (const [text, label, act] of [['−', 'zoom out', () => this.zoom(0.5)], ['+', 'zoom in', () => this.zoom(2)],
                                      ['fit', 'fit', () => this.set({scale: 0})]]) {
      zoom.append(element('button', {type: 'button', ariaLabel: label, title: label, onclick: act}, text));
    }
    this.zoomText = element('span', {className: 'quiet'});
    zoom.append(this.zoomText);
    this.panes = element('div', {className: 'panes'});
    this.slider = element('input', {type: 'range', min: 0, max: 100, value: 50, ariaLabel: 'share of the first picture',
                                    style: 'width: 100%'});
    this.slider.oninput = () => { this.cut = Number(this.slider.value); this.draw(); };
    this.swap = element('button', {type: 'button', title: 'f', onclick: () => this.turn(true)}, 'show the other');
    this.legend = element('div');
    this.numbers = element('div', {className: 'values'});
    const bar = element('div', {className: 'bar'}, this.layers.host, view.sides.length > 1 ? this.sides.host : '',
                        this.modes.host, zoom);
    this.host = element('section', {className: 'viewer', ariaLabel: `pictures: ${view.title}`}, bar, this.part(),
                        this.panes, this.legend, this.numbers);
    this.host.addEventListener('keydown', (event) => this.key(event));
    this.resized = new ResizeObserver(() => this.draw());
    this.resized.observe(this.panes);
    this.timer = setInterval(() => this.turn(false), 600);
    this.show();
  }

  /** Stops the timer and the observer of sizes. */
  close() {
    clearInterval(this.timer);
    this.resized.disconnect();
  }

  part() {
    const {view} = this;
    if (view.columns === view.width && view.rows === view.height) return '';
    return element('p', {className: 'quiet'}, `${view.columns} x ${view.rows} of ${view.width} x ${view.height} pixels are ` +
      `here, from ${view.x},${view.y}: about the worst, as many as a page of small size holds`);
  }

  /**
   * Sets any of layer, against, mode (by name), pixel ([x, y] of the frame, or null), scale, marks, and judging (the
   * stage whose tolerance the marks are beyond).
   */
  set(state) {
    const {view} = this;
    const before = this.seen();
    if (state.layer) this.layer = view.layers.find((l) => l.name === state.layer) ?? this.layer;
    if (state.against) this.against = Math.max(1, view.sides.indexOf(state.against));
    if (MODES.includes(state.mode)) this.mode = state.mode;
    if (state.scale !== undefined) this.scale = Math.min(Math.max(Number(state.scale) || 0, 0), MOST);
    if (state.marks !== undefined) this.marks = state.marks;
    this.judging = state.judging ?? this.judging;
    if (state.pixel !== undefined) {
      this.pixel = this.inside(state.pixel) ? state.pixel : null;
      if (this.pixel && state.centred) this.middle = this.place(this.pixel).map((v) => v + 0.5);
    }
    if (String(this.seen()) === String(before)) this.draw(), this.showNumbers();  // and the focus stays where it is
    else this.show();
    this.changed(this);
  }
  /** State that the pictures depend on. */
  seen() {
    return [this.layer?.name, this.against, this.mode, this.view.marks.indexOf(this.marks), this.judging];
  }

  inside(pixel) {
    const {x, y, columns, rows} = this.view;
    return pixel !== null && pixel[0] >= x && pixel[1] >= y && pixel[0] < x + columns && pixel[1] < y + rows;
  }
  /** From a pixel of the frame to its place in the picture, counted from the upper left; and back. */
  place([x, y]) {
    const {view} = this;
    return [x - view.x, view.from_top ? y - view.y : view.rows - 1 - (y - view.y)];
  }
  at(column, row) {
    const {view} = this;
    return [view.x + column, view.y + (view.from_top ? row : view.rows - 1 - row)];
  }
  index([x, y]) {
    return (y - this.view.y) * this.view.columns + (x - this.view.x);
  }

  /** Paints the pictures of the layer, the sides and the mode, and rebuilds legend, canvases and numbers. */
  show() {
    const {view, layer, against} = this;
    this.layers.show(layer?.name);
    this.sides.show(view.sides[against]);
    this.modes.show(this.mode);
    this.pictures = [];
    this.difference = null;
    if (layer) {
      for (const side of [0, against]) {
        const plane = layer.planes[side];
        this.pictures.push(plane ? this.painted(PAINTERS[layer.paint](view, plane, layer, side)) : null);
      }
      this.difference = differenceOf(view, layer, against, this.marks);
      if (this.difference) {
        const painter = PAINTERS[layer.paint](view, layer.planes[0], layer, 0);
        this.pictures.push(this.painted(differencePainter(this.difference, painter, muchOf(layer.planes[0], layer.paint))));
      }
    }
    this.legend.replaceChildren(...this.says());
    this.layout();
    this.draw();
    this.showNumbers();
  }

  says() {
    const {layer, difference, against, view} = this;
    if (!layer) return [element('p', {className: 'quiet'}, 'no picture: nothing was drawn')];
    const out = [element('p', {className: 'quiet'}, `${layer.name}: ${layer.says}`)];
    if (difference) out.push(differenceLegend(difference, layer.judged.includes(this.judging)));
    else if (against > 0) out.push(element('p', {}, `${view.sides[layer.planes[0] ? against : 0]} hands out none`));
    return out;
  }

  painted(painter) {
    const {view} = this;
    const canvas = new OffscreenCanvas(view.columns, view.rows);
    const image = new ImageData(view.columns, view.rows);
    for (let row = 0; row < view.rows; ++row) {
      for (let column = 0; column < view.columns; ++column) {
        const [r, g, b] = painter(this.index(this.at(column, row)));
        image.data.set([r, g, b, 255], 4 * (row * view.columns + column));
      }
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas;
  }

  /** Makes the mode's canvases. Each shows one picture, or, of two, one in turn (flicker) or parts of both (slider). */
  layout() {
    const [ours, theirs] = [this.view.sides[0], this.view.sides[this.against]];
    const [a, b, difference] = this.pictures;
    const wanted = [];
    if (this.mode === 'side by side' || !a || !b) {
      if (a) wanted.push([[a], ours]);
      if (b && this.against > 0) wanted.push([[b], theirs]);
    } else {
      wanted.push([[a, b], `${ours} | ${theirs}`]);
    }
    if (difference && this.against > 0)
      wanted.push([[difference], differenceText(this.difference, this.layer.planes[0], this.layer.paint)]);
    this.shown = wanted.map(([pictures, caption]) => {
      const canvas = element('canvas', {tabIndex: 0, ariaLabel: `${caption}; arrow keys move from pixel to pixel`});
      canvas.setAttribute('role', 'img');
      canvas.onpointermove = (event) => this.hover(event, canvas);
      canvas.ondblclick = () => this.set({scale: this.scale >= 16 ? 0 : 16, pixel: this.pixel, centred: true});
      canvas.onpointerdown = (event) => this.grab(event, canvas);
      canvas.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
      const both = pictures.length < 2 ? '' : this.mode === 'slider' ? this.slider : this.swap;
      return {pictures, canvas, both, caption: element('figcaption', {}, caption)};
    });
    this.panes.replaceChildren(...this.shown.map((s) => element('figure', {}, s.canvas, s.caption, s.both)));
  }

  /** Part of the picture in a canvas: scale [screen pixels per pixel], and the picture's place at the upper left. */
  window(width, height) {
    const {view} = this;
    // Fits the whole picture, unless its shorter side would fall below THINNEST.
    const fit = Math.max(Math.min(width / view.columns, height / view.rows), THINNEST / Math.min(view.columns, view.rows));
    const scale = this.scale || (fit >= 1 ? Math.floor(fit) : fit);
    const start = (middle, size, all) =>
      size >= all * scale ? (all - size / scale) / 2
                          : Math.min(Math.max(middle - size / scale / 2, 0), all - size / scale);
    return {scale, left: start(this.middle[0], width, view.columns), top: start(this.middle[1], height, view.rows)};
  }

  draw() {
    const {view} = this;
    for (const {pictures, canvas, caption} of this.shown) {
      const width = canvas.clientWidth;
      if (width === 0) continue;
      const height = Math.round(Math.min(Math.max(width * view.rows / view.columns, 120), 420));
      const ratio = window.devicePixelRatio;
      canvas.style.height = `${height}px`;
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      const context = canvas.getContext('2d');
      context.scale(ratio, ratio);
      context.imageSmoothingEnabled = false;
      const at = this.window(width, height);
      const put = (picture) => context.drawImage(picture, -at.left * at.scale, -at.top * at.scale,
                                                 view.columns * at.scale, view.rows * at.scale);
      const turned = this.mode === 'flicker' && this.second && pictures.length > 1;
      put(pictures[turned ? 1 : 0]);
      if (pictures.length > 1 && this.mode === 'slider') this.drawCut(context, width, height, () => put(pictures[1]));
      if (this.mode === 'flicker' && pictures.length > 1) caption.textContent = view.sides[turned ? this.against : 0];
      this.drawGrid(context, at, width, height);
      this.zoomText.textContent = `${numberText(Number(at.scale.toPrecision(3)))} x`;
    }
  }

  drawCut(context, width, height, put) {
    const x = width * this.cut / 100;
    context.save();
    context.beginPath();
    context.rect(x, 0, width - x, height);
    context.clip();
    context.clearRect(x, 0, width - x, height);
    put();
    context.restore();
    context.fillStyle = '#ff3b30';
    context.fillRect(x - 0.5, 0, 1, height);
  }

  drawGrid(context, at, width, height) {
    const {view} = this;
    const x = (column) => (column - at.left) * at.scale, y = (row) => (row - at.top) * at.scale;
    if (at.scale >= GRID_FROM) {
      context.strokeStyle = 'rgb(128 128 128 / 0.5)';
      context.beginPath();
      for (let c = 0; c <= view.columns; ++c) { context.moveTo(x(c), y(0)); context.lineTo(x(c), y(view.rows)); }
      for (let r = 0; r <= view.rows; ++r) { context.moveTo(x(0), y(r)); context.lineTo(x(view.columns), y(r)); }
      context.stroke();
    }
    if (!this.pixel) return;
    const [column, row] = this.place(this.pixel);
    const side = Math.max(at.scale, 5);
    for (const [color, wider] of [['#000', 1.5], ['#fff', 0.5]]) {
      context.strokeStyle = color;
      context.strokeRect(x(column) - wider, y(row) - wider, side + 2 * wider, side + 2 * wider);
    }
  }

  /** The pixel under a pointer, or null. */
  under(event, canvas) {
    const box = canvas.getBoundingClientRect();
    const at = this.window(canvas.clientWidth, parseFloat(canvas.style.height));
    const column = Math.floor(at.left + (event.clientX - box.left - 1) / at.scale);
    const row = Math.floor(at.top + (event.clientY - box.top - 1) / at.scale);
    const pixel = this.at(column, row);
    return this.inside(pixel) ? pixel : null;
  }

  hover(event, canvas) {
    if (this.grabbed) {
      const {scale} = this.window(canvas.clientWidth, canvas.clientHeight);
      this.middle = [this.grabbed.middle[0] - (event.clientX - this.grabbed.x) / scale,
                     this.grabbed.middle[1] - (event.clientY - this.grabbed.y) / scale];
      return this.draw();
    }
    const pixel = this.under(event, canvas);
    if (!pixel || String(pixel) === String(this.pixel)) return;
    this.pixel = pixel;
    this.draw();
    this.showNumbers();
    this.changed(this);
  }

  grab(event, canvas) {
    const {scale} = this.window(canvas.clientWidth, canvas.clientHeight);
    if (this.view.columns * scale <= canvas.clientWidth && this.view.rows * scale <= canvas.clientHeight) return;
    this.grabbed = {x: event.clientX, y: event.clientY, middle: this.middle};
    canvas.setPointerCapture(event.pointerId);
    canvas.onpointerup = () => { this.grabbed = null; };
    canvas.onpointercancel = canvas.onpointerup;
  }

  wheel(event) {
    if (!event.ctrlKey) return;  // else the page scrolls
    event.preventDefault();
    this.zoom(event.deltaY < 0 ? 2 : 0.5);
  }

  zoom(by) {
    const canvas = this.shown[0]?.canvas;
    if (!canvas) return;
    const {scale} = this.window(canvas.clientWidth, parseFloat(canvas.style.height));
    this.set({scale: Math.max(1, 2 ** Math.round(Math.log2(scale * by))), pixel: this.pixel, centred: true});
  }

  turn(asked) {
    if (this.mode !== 'flicker' || (!asked && this.paused)) return;
    if (asked) this.paused = true;  // a turn by hand stops the timer's turns
    this.second = !this.second;
    this.draw();
  }

  key(event) {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (step && event.target.tagName === 'CANVAS') {
      const from = this.pixel ? this.place(this.pixel) : this.middle.map(Math.floor);
      const pixel = this.at(from[0] + step[0], from[1] + step[1]);
      if (this.inside(pixel)) this.set({pixel, centred: this.scale > 0});
    } else if (event.key === '+' || event.key === '=') {
      this.zoom(2);
    } else if (event.key === '-') {
      this.zoom(0.5);
    } else if (event.key === '0') {
      this.set({scale: 0});
    } else if (event.key === 'f' && this.mode === 'flicker') {
      this.turn(true);
    } else {
      return;
    }
    event.preventDefault();
  }

  showNumbers() {
    const {view, pixel} = this;
    if (!pixel || view.layers.length === 0) {
      this.numbers.replaceChildren(element('p', {className: 'quiet'}, 'numbers: point at a pixel'));
      return;
    }
    const p = this.index(pixel);
    const rows = view.layers.map((layer) => element('tr', {}, element('th', {scope: 'row'}, layer.name),
      ...layer.planes.map((plane) => {
        const ours = layer.planes[0];
        const differs = plane && ours && plane !== ours && plane.channels === ours.channels && apart(ours, plane, p) > 0;
        return element('td', {className: differs ? 'apart' : ''}, plane ? (differs ? '≠ ' : '') + plane.text(p, ours?.scale ?? plane.scale) : '-');
      })));
    const head = element('tr', {}, element('th', {scope: 'col'}, `pixel ${pixel[0]},${pixel[1]}`),
                         ...view.sides.map((side) => element('th', {scope: 'col'}, side)));
    this.numbers.replaceChildren(element('table', {className: 'numbers'}, head, ...rows));
  }
}
