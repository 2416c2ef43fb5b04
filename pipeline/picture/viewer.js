// SPDX-License-Identifier: BSD-3-Clause
// Shows the mesh that a page carries: zooming and panning, colours by a metric, before and after. mesh_view_html.cpp writes
// the page. Needs WebGL 2 and DecompressionStream; where they are missing, the still picture stays.

const root = document.getElementById('mesh-view');
const find = (name) => root.querySelector('.' + name);
const stage = find('view-stage');
const canvas = find('view-canvas');
const slowFrame = 60;  // milliseconds from which on frames are painted when the hand rests

// --- The view.

let mesh = null;
let painter = null;
let chosen = -1;
let legend = null;
let frameTime = 0;
let isAsked = false;  // for the next frame of the browser's
let isStale = true;   // what was painted is not what is to be seen
let resting = 0;
const view = {x: 0, y: 0, zoom: 1, width: 1, height: 1, ratio: 1, now: about.moved ? 1 : 0};
let painted = null;  // the view of the last frame
const show = {lines: true, held: false, moves: false, isDark: false};
const isDark = matchMedia('(prefers-color-scheme: dark)');

// How far the mesh goes, in steps.
function extent() {
  let [lowX, lowY, highX, highY] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const box of [...painter.boxes, ...(about.backdrop ? [about.backdrop] : [])]) {
    [lowX, lowY] = [Math.min(lowX, box.lowX), Math.min(lowY, box.lowY)];
    [highX, highY] = [Math.max(highX, box.highX), Math.max(highY, box.highY)];
  }
  return highX >= lowX ? {lowX, lowY, highX, highY} : {lowX: 0, lowY: 0, highX: 1, highY: 1};
}

function resize() {
  if (stage.clientWidth === 0 || stage.clientHeight === 0) {
    return false;  // it is hidden, and will be there again
  }
  view.ratio = Math.min(window.devicePixelRatio || 1, 2);
  const width = Math.round(stage.clientWidth * view.ratio);
  const height = Math.round(stage.clientHeight * view.ratio);
  if (width === view.width && height === view.height) {
    return false;
  }
  view.zoom *= view.width > 1 ? width / view.width : 1;
  [canvas.width, canvas.height] = [view.width, view.height] = [width, height];
  return true;
}

// At which a box is as large as the window allows.
const zoomOf = (box) => Math.min(view.width / (box.highX - box.lowX || 1), view.height / (box.highY - box.lowY || 1));

function lookAt(box, margin) {
  view.x = (box.lowX + box.highX) / 2;
  view.y = (box.lowY + box.highY) / 2;
  view.zoom = zoomOf(box) / margin;
  ask();
}
const fit = () => lookAt(extent(), 1.06);

const toSteps = (x, y) => [view.x + (x * view.ratio - view.width / 2) / view.zoom, view.y - (y * view.ratio - view.height / 2) / view.zoom];
const toWindow = (x, y) => [((x - view.x) * view.zoom + view.width / 2) / view.ratio, (view.height / 2 - (y - view.y) * view.zoom) / view.ratio];

function zoomBy(factor, x = stage.clientWidth / 2, y = stage.clientHeight / 2) {
  const [fromX, fromY] = toSteps(x, y);
  view.zoom = Math.min(Math.max(view.zoom * factor, 0.2 * zoomOf(extent())), 400);
  const [toX, toY] = toSteps(x, y);
  view.x += fromX - toX;
  view.y += fromY - toY;
  ask();
}

// Frames are painted at once where they take little; else the last one is moved along until the hand rests.
function ask() {
  isStale = true;
  if (frameTime > slowFrame && painted) {
    const zoom = view.zoom / painted.zoom;
    const x = (painted.x - view.x) * view.zoom / view.ratio;
    const y = (view.y - painted.y) * view.zoom / view.ratio;
    canvas.style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    placeMarks();
    clearTimeout(resting);
    resting = setTimeout(paint, 120);
  } else if (!isAsked) {
    isAsked = true;
    requestAnimationFrame(paint);
  }
}

function paint() {
  isAsked = false;
  if (!isStale) {
    return;
  }
  isStale = false;
  clearTimeout(resting);
  const begin = performance.now();
  painter.paint(view, show);
  painter.gl.readPixels(0, 0, 1, 1, painter.gl.RGBA, painter.gl.UNSIGNED_BYTE, new Uint8Array(4));  // until it is done
  frameTime = performance.now() - begin;
  canvas.style.transform = '';
  painted = {...view};
  placeMarks();
  // A finger moves the page as long as all of the mesh is there, and the mesh when it is near.
  stage.style.touchAction = view.zoom > zoomOf(extent()) ? 'none' : 'pan-y';
  root.dataset.frames = Number(root.dataset.frames || 0) + 1;
  root.dataset.frameTime = Math.round(frameTime);
  root.dataset.view = JSON.stringify({x: view.x, y: view.y, zoom: view.zoom, now: view.now});
}

// --- The worst elements, as marks over the picture; what lies behind a large mesh.

let marks = [];
const middle = (e, now) => {
  const p = placesOf(e, now, new Float64Array(8));
  const count = cornersOf(e).length;
  let [x, y] = [0, 0];
  for (let i = 0; i < count; ++i) {
    x += p[2 * i] / count;
    y += p[2 * i + 1] / count;
  }
  return [x, y];
};

function placesByNumber(wanted) {
  const found = new Map();
  const numbers = new Set(wanted);
  for (let e = 0; e < mesh.elements; ++e) {
    if (numbers.has(mesh.numbers[e]) && !found.has(mesh.numbers[e])) {
      found.set(mesh.numbers[e], e);
    }
  }
  return found;
}

function makeMarks() {
  const found = placesByNumber([...about.worst.before, ...about.worst.after]);
  const layer = find('view-marks');
  for (const [state, numbers] of [['before', about.worst.before], ['after', about.worst.after]]) {
    numbers.filter((number) => found.has(number)).forEach((number) => {
      const mark = document.createElement('button');
      mark.type = 'button';
      mark.tabIndex = -1;
      mark.title = `element ${number}, among the worst ${state}`;
      mark.className = 'view-mark';
      mark.addEventListener('click', () => choose(found.get(number)));
      layer.append(mark);
      marks.push({mark, state, e: found.get(number)});
    });
  }
}

// All of a large mesh is a picture, over which those around the worst elements are painted.
function makeBackdrop() {
  for (const [from, state] of [['view-still-before', 'before'], ['view-still', 'after']]) {
    if (about.backdrop && find(from)) {
      const image = find(from).cloneNode();
      image.className = 'view-backdrop ' + state;
      stage.prepend(image);
    }
  }
  stage.prepend(...stage.querySelectorAll('.view-backdrop.before'));
}

function placeMarks() {
  const state = about.moved && view.now >= 0.5 ? 'after' : 'before';
  for (const {mark, state: of, e} of marks) {
    const [x, y] = toWindow(...middle(e, of === 'after' ? 1 : 0));
    mark.hidden = of !== state || x < 0 || y < 0 || x > stage.clientWidth || y > stage.clientHeight;
    mark.style.transform = `translate(${x}px, ${y}px)`;
  }
  for (const image of stage.querySelectorAll('.view-backdrop')) {
    const box = about.backdrop;
    const [x, y] = toWindow(box.lowX, box.highY);
    const [right, bottom] = toWindow(box.highX, box.lowY);
    image.style.transform = `translate(${x}px, ${y}px)`;
    [image.style.width, image.style.height] = [`${right - x}px`, `${bottom - y}px`];
    image.style.opacity = image.classList.contains('after') && about.moved ? view.now : 1;
  }
}

// --- Choosing an element.

function contains(e, now, x, y) {
  const p = placesOf(e, now, scratch);
  const count = cornersOf(e).length;
  let isInside = false;
  for (let i = 0, j = count - 1; i < count; j = i++) {
    if ((p[2 * i + 1] > y) !== (p[2 * j + 1] > y) &&
        x < (p[2 * j] - p[2 * i]) * (y - p[2 * i + 1]) / (p[2 * j + 1] - p[2 * i + 1]) + p[2 * i]) {
      isInside = !isInside;
    }
  }
  return isInside;
}

// The worst of the elements under the pointer; where they are smaller than a fingertip, of those that touch it.
function elementAt(x, y) {
  const now = about.moved && view.now >= 0.5 ? 1 : 0;
  const [atX, atY] = toSteps(x, y);
  const reach = 3 * view.ratio / view.zoom;
  let [best, worst] = [-1, Infinity];
  for (const box of painter.boxes) {
    if (atX < box.lowX - reach || atX > box.highX + reach || atY < box.lowY - reach || atY > box.highY + reach) {
      continue;
    }
    for (let i = box.begin; i < box.begin + box.count; i += 3) {
      const at = 4 * mesh.drawn[i] + 2 * now;
      const second = 4 * mesh.drawn[i + 1] + 2 * now;
      const third = 4 * mesh.drawn[i + 2] + 2 * now;
      const {places} = mesh;
      const [lowX, highX] = [Math.min(places[at], places[second], places[third]), Math.max(places[at], places[second], places[third])];
      const [lowY, highY] = [Math.min(places[at + 1], places[second + 1], places[third + 1]),
        Math.max(places[at + 1], places[second + 1], places[third + 1])];
      if (atX < lowX - reach || atX > highX + reach || atY < lowY - reach || atY > highY + reach) {
        continue;
      }
      const drawn = i / 3;
      const e = drawn < mesh.triangles ? drawn : mesh.triangles + Math.floor((drawn - mesh.triangles) / 2);
      const isTiny = highX - lowX < 2 * reach && highY - lowY < 2 * reach;
      const shape = valueOf('shape', e, now);
      if (shape < worst && (isTiny || contains(e, now, atX, atY))) {
        [best, worst] = [e, shape];
      }
    }
  }
  return best;
}

const digits = (value) => !Number.isFinite(value) ? '∞'
  : value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6) ? value.toExponential(3) : String(Number(value.toPrecision(4)));

function textOf(name, text, ...more) {
  const made = document.createElement(name);
  made.textContent = text;
  made.append(...more);
  return made;
}

function shownPlace([x, y]) {
  const [placeX, placeY] = [about.origin[0] + x * about.step, about.origin[1] + y * about.step];
  // On the map, Mercator's, in degrees.
  return about.geographic ? [placeX, Math.atan(Math.sinh(placeY * Math.PI / 180)) * 180 / Math.PI] : [placeX, placeY];
}

function tell(e) {
  const info = find('view-info');
  info.replaceChildren();
  if (e < 0) {
    info.append(textOf('p', about.backdrop ? 'No element there that can be clicked.' : 'No element there.'));
    return;
  }
  const [x, y] = shownPlace(middle(e, about.moved && view.now >= 0.5 ? 1 : 0));
  const kind = isTriangle(e) ? 'triangle' : 'quadrilateral';
  const title = textOf('h3', `Element ${mesh.numbers[e]}`);
  const facts = [kind, mesh.regions ? `region ${about.regions[mesh.regions[e]]}` : '', `at ${Number(x.toPrecision(7))}, ${Number(y.toPrecision(7))}`];
  if (about.moved) {
    facts.push(`corners moved up to ${digits(movedDistance(e))}`);
  }
  if (mesh.held) {
    const reasons = new Set();
    let count = 0;
    for (const v of cornersOf(e)) {
      count += mesh.held[v] !== 0;
      about.held.filter((reason, bit) => mesh.held[v] >> bit & 1).forEach((reason) => reasons.add(reason));
    }
    facts.push(count === 0 ? 'no corner held' : `${count} of ${cornersOf(e).length} corners held: ${[...reasons].join(', ')}`);
  }
  const table = document.createElement('table');
  const head = document.createElement('tr');
  head.append(textOf('th', 'metric'), ...(about.moved ? [textOf('th', 'before'), textOf('th', 'after')] : [textOf('th', 'value')]));
  table.append(head);
  for (const {name, unit} of about.metrics) {
    if (meshMetrics[kind][name]) {
      const line = textOf('tr', '', textOf('td', unit ? `${name}, ${unit}` : name), textOf('td', digits(valueOf(name, e, 0))));
      if (about.moved) {
        line.append(textOf('td', digits(valueOf(name, e, 1))));
      }
      table.append(line);
    }
  }
  info.append(title, textOf('p', facts.filter(Boolean).join('; ') + '.'), table);
  if (!mesh.exact.has(e)) {
    info.append(textOf('p', 'Values of this picture, whose coordinates are rounded: shape is right to 0.005 and to 5 %. The tables of the report are exact.'));
    info.lastChild.className = 'soft';
  }
}

function choose(e) {
  chosen = e;
  root.dataset.chosen = e < 0 ? '' : mesh.numbers[e];
  painter.choose(e);
  tell(e);
  for (const button of document.querySelectorAll('[data-element]')) {
    button.classList.toggle('chosen', e >= 0 && Number(button.dataset.element) === mesh.numbers[e]);
  }
  ask();
}

function zoomTo(e, now) {
  const p = placesOf(e, now, new Float64Array(8));
  const count = cornersOf(e).length;
  const xs = Array.from({length: count}, (_, i) => p[2 * i]);
  const ys = Array.from({length: count}, (_, i) => p[2 * i + 1]);
  const reach = Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys), 1);
  lookAt({lowX: Math.min(...xs) - 2 * reach, highX: Math.max(...xs) + 2 * reach,
    lowY: Math.min(...ys) - 2 * reach, highY: Math.max(...ys) + 2 * reach}, 1);
  choose(e);
}

// --- The tools.

function setNow(now) {
  view.now = now;
  find('view-slider').value = now;
  find('view-state').textContent = now === 0 ? 'before' : now === 1 ? 'after' : 'between';
  ask();
}

function showLegend() {
  const place = find('view-legend');
  place.replaceChildren();
  const strip = (stops) => {
    const bar = document.createElement('span');
    bar.className = 'view-scale';
    bar.style.background = `linear-gradient(90deg, ${stops.map(([at, colour]) => `rgb(${colour}) ${100 * at}%`).join(', ')})`;
    return bar;
  };
  const swatch = (colour, text) => {
    const made = textOf('span', text);
    const box = document.createElement('i');
    box.style.background = `rgb(${colour})`;
    made.prepend(box);
    return made;
  };
  if (legend.kind === 'region') {
    about.regions.slice(0, 24).forEach((name, i) => place.append(swatch(about.colours.regions[i % about.colours.regions.length], name)));
    if (about.regions.length > 24) {
      place.append(textOf('span', `and ${about.regions.length - 24} more; colours repeat`));
    }
    return;
  }
  const {unit} = about.metrics.find(({name}) => name === legend.metric) || {unit: ''};
  if (legend.kind === 'amount') {
    place.append(textOf('span', digits(legend.ends[0])), strip(about.colours.amount),
      textOf('span', digits(legend.ends[1]) + (legend.isLogarithmic ? ' (logarithmic)' : '') + ' and more'));
  } else {
    const scale = about.scales[mesh.triangles > 0 ? 'triangle' : 'quadrilateral'][legend.metric] || about.scales.quadrilateral[legend.metric];
    const end = scale.reciprocal ? '∞' : digits(scale.worst);
    place.append(textOf('span', `worst ${end}`), strip(about.colours.quality),
      textOf('span', `${digits(scale.ideal)}${unit ? ' ' + unit : ''} ideal`));
  }
  place.append(swatch(about.colours.inverted, 'inverted'));
  const kinds = [['triangle', mesh.triangles], ['quadrilateral', mesh.quads]];
  for (const [kind] of kinds.filter(([name, count]) => count > 0 && legend.kind === 'quality' && !meshMetrics[name][legend.metric])) {
    place.append(swatch(about.colours.lacking, `${kind}s have none`));
  }
}

function colourBy(metric) {
  const made = bytesOfElements(metric);
  painter.colour(made);
  legend = made.legend;
  root.dataset.metric = metric;
  showLegend();
  ask();
}

function connectPointer() {
  const pointers = new Map();
  let isDrag = false;
  const spread = () => {
    const [p, q] = pointers.values();
    return {x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, wide: Math.hypot(p.x - q.x, p.y - q.y)};
  };
  const local = (event) => {
    const box = stage.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, local(event));
    isDrag = pointers.size > 1;
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) {
      return;
    }
    const at = local(event);
    if (pointers.size === 1) {
      isDrag ||= Math.hypot(at.x - last.x, at.y - last.y) > 3;
      if (!isDrag) {
        return;
      }
      view.x -= (at.x - last.x) * view.ratio / view.zoom;
      view.y += (at.y - last.y) * view.ratio / view.zoom;
      pointers.set(event.pointerId, at);
      ask();
    } else if (pointers.size === 2) {
      const from = spread();
      pointers.set(event.pointerId, at);
      const to = spread();
      view.x -= (to.x - from.x) * view.ratio / view.zoom;
      view.y += (to.y - from.y) * view.ratio / view.zoom;
      zoomBy(to.wide / (from.wide || 1), to.x, to.y);
    }
  });
  const leave = (event) => {
    if (pointers.delete(event.pointerId) && !isDrag && event.type === 'pointerup') {
      const {x, y} = local(event);
      choose(elementAt(x, y));
    }
    isDrag = pointers.size > 0;
  };
  canvas.addEventListener('pointerup', leave);
  canvas.addEventListener('pointercancel', leave);
  stage.addEventListener('wheel', (event) => {
    event.preventDefault();
    const {x, y} = local(event);
    zoomBy(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), x, y);
  }, {passive: false});
}

// To the next one, or the last, from the chosen one on.
function toWorst(step) {
  const state = about.moved && view.now >= 0.5 ? 'after' : 'before';
  const known = marks.filter((mark) => mark.state === state);
  if (known.length > 0) {
    const at = known.findIndex((mark) => mark.e === chosen);
    const next = at < 0 ? (step > 0 ? 0 : known.length - 1) : (at + step + known.length) % known.length;
    zoomTo(known[next].e, state === 'after' ? 1 : 0);
  }
}

function connectTools() {
  const metric = find('view-metric');
  metric.addEventListener('change', () => colourBy(metric.value));
  for (const name of ['lines', 'held', 'moves']) {
    const box = find('view-' + name);
    box.checked = show[name];
    box.addEventListener('change', () => {
      show[name] = box.checked;
      ask();
    });
  }
  find('view-slider').addEventListener('input', (event) => setNow(Number(event.target.value)));
  find('view-in').addEventListener('click', () => zoomBy(1.6));
  find('view-out').addEventListener('click', () => zoomBy(1 / 1.6));
  find('view-fit').addEventListener('click', fit);
  find('view-worst').addEventListener('click', () => toWorst(1));
  find('view-full').addEventListener('click', () => document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen());
  const step = 0.15;
  const keys = {
    '+': () => zoomBy(1.4), '=': () => zoomBy(1.4), '-': () => zoomBy(1 / 1.4), 0: fit, n: () => toWorst(1), p: () => toWorst(-1),
    ' ': () => about.moved && setNow(view.now < 0.5 ? 1 : 0),
    ArrowLeft: () => { view.x -= step * view.width / view.zoom; ask(); }, ArrowRight: () => { view.x += step * view.width / view.zoom; ask(); },
    ArrowUp: () => { view.y += step * view.height / view.zoom; ask(); }, ArrowDown: () => { view.y -= step * view.height / view.zoom; ask(); },
  };
  stage.addEventListener('keydown', (event) => {
    if (keys[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      keys[event.key]();
    }
  });
  document.addEventListener('click', (event) => {
    const button = event.target.closest('button[data-element]');
    if (!button) {
      return;
    }
    const e = placesByNumber([Number(button.dataset.element)]).get(Number(button.dataset.element));
    if (e !== undefined) {
      const now = about.moved && button.dataset.state !== 'before' ? 1 : 0;
      setNow(now);
      zoomTo(e, now);
      stage.focus({preventScroll: true});
      stage.scrollIntoView({block: 'center'});
    }
  });
  isDark.addEventListener('change', () => {
    show.isDark = isDark.matches;
    ask();
  });
  new ResizeObserver(() => resize() && ask()).observe(stage);
  canvas.addEventListener('webglcontextlost', () => leaveStill('The browser has taken the graphics memory back; reload the page to see the mesh again.'));
}

function leaveStill(reason) {
  root.classList.remove('live');
  root.dataset.state = 'still';
  find('view-note').prepend(textOf('p', reason));
}

async function begin() {
  const gl = canvas.getContext('webgl2', {antialias: about.triangles + about.quadrilaterals < 300000, preserveDrawingBuffer: true});
  if (!gl || typeof DecompressionStream === 'undefined') {
    leaveStill(`This browser has no ${gl ? 'DecompressionStream' : 'WebGL 2'}: here is a still picture of the mesh.`);
    return;
  }
  mesh = meshOf(await unpacked());
  const largest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  if (Math.max(mesh.vertices, mesh.elements) > row * largest) {
    leaveStill('The mesh is too large for the textures of this browser: here is a still picture of it.');
    return;
  }
  painter = new Painter(gl, mesh);
  show.isDark = isDark.matches;
  resize();
  makeBackdrop();
  connectPointer();
  connectTools();
  colourBy(find('view-metric').value);
  setNow(view.now);
  fit();
  paint();
  root.classList.add('live');
  root.dataset.firstPicture = Math.round(performance.now());
  makeMarks();
  placeMarks();
  root.dataset.state = 'live';
}

// For tests, and for those who want to look closer by the browser's console.
window.trismooth = {valueOf: (metric, number, now) => valueOf(metric, placesByNumber([number]).get(number), now), toWindow: (number) => {
  const e = placesByNumber([number]).get(number);
  return toWindow(...middle(e, about.moved && view.now >= 0.5 ? 1 : 0));
}};

begin().catch((error) => leaveStill(`The mesh cannot be shown (${error.message}): here is a still picture of it.`));
