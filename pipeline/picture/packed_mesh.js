// SPDX-License-Identifier: BSD-3-Clause
// The mesh that a page carries, as packed_picture.h says, and the colours of its elements. The scripts of a page are parts of
// one function: metrics.js, packed_mesh.js, painter.js, viewer.js.

const about = JSON.parse(document.getElementById('mesh-about').textContent);
const row = 2048;         // places in a row of a texture
const chunk = 3 * 16384;  // corners that are drawn together or not at all

// --- What the page carries.

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function bytesOf(text) {
  if (Uint8Array.fromBase64) {
    return Uint8Array.fromBase64(text);
  }
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) {
    bytes[i] = characters.charCodeAt(i);
  }
  return bytes;
}

function joined(bytes, count, planes) {
  const numbers = new Uint32Array(count);
  const [second, third, fourth] = [count, 2 * count, 3 * count];
  for (let i = 0; i < count; ++i) {
    numbers[i] = bytes[i] | (planes > 1 ? bytes[second + i] << 8 : 0) | (planes > 2 ? bytes[third + i] << 16 : 0) |
      (planes > 3 ? bytes[fourth + i] << 24 : 0);
  }
  return numbers;
}

const signed = (number) => (number >>> 1) ^ -(number & 1);

async function unpacked() {
  const bytes = bytesOf(document.getElementById('mesh-data').textContent);
  const found = {};
  let at = 0;
  await Promise.all(about.streams.map(async ([name, count, planes, size]) => {
    const part = bytes.subarray(at, at + size);
    at += 3 * Math.ceil(size / 3);
    found[name] = joined(await inflated(part), count, planes);
  }));
  return found;
}

// --- The mesh.

function meshOf(streams) {
  const mesh = {
    vertices: about.vertices, triangles: about.triangles, quads: about.quadrilaterals,
    elements: about.triangles + about.quadrilaterals, held: streams.held || null, regions: streams.region || null,
    boundary: streams.boundary || new Uint32Array(0), interfaces: streams.interface || new Uint32Array(0),
    turned: new Set(streams.turned || []),
  };
  const places = mesh.places = new Int32Array(row * Math.ceil(Math.max(mesh.vertices, 1) / row) * 4);
  const none = new Uint32Array(mesh.vertices);
  const {x = none, y = none, dx = none, dy = none} = streams;
  for (let v = 0, atX = 0, atY = 0; v < mesh.vertices; ++v) {
    places[4 * v] = atX += signed(x[v]);
    places[4 * v + 1] = atY += signed(y[v]);
    places[4 * v + 2] = atX + signed(dx[v]);
    places[4 * v + 3] = atY + signed(dy[v]);
  }
  const {a = [], b, c, d} = streams;
  const {triangles} = mesh;
  // What is drawn: three corners a triangle, six a quadrilateral.
  const drawn = mesh.drawn = new Uint32Array(3 * triangles + 6 * mesh.quads);
  const quads = mesh.quadCorners = new Uint32Array(4 * mesh.quads);
  const numbers = mesh.numbers = new Float64Array(mesh.elements);
  for (let e = 0, first = 0, number = 0; e < mesh.elements; ++e) {
    first += signed(a[e]);
    numbers[e] = number += signed(streams.number[e]);
    if (e < triangles) {
      drawn[3 * e] = first;
      drawn[3 * e + 1] = first + b[e];
      drawn[3 * e + 2] = first + c[e];
    } else {
      const q = e - triangles;
      const corners = [first, first + b[e], first + c[e], first + d[q]];
      quads.set(corners, 4 * q);
      // By the diagonal that stays inside: from the corner on that points inwards, if any.
      const by = quadArea(places, corners, 0, 1, 2) > 0 && quadArea(places, corners, 0, 2, 3) > 0 ? 0 : 1;
      drawn.set([0, 1, 2, 0, 2, 3].map((i) => corners[(i + by) % 4]), 3 * triangles + 6 * q);
    }
  }
  // Of elements that whole steps show otherwise, their corners as they are.
  mesh.exact = new Map();
  mesh.isOtherwise = new Uint8Array(mesh.elements);  // exact, or turned
  const exact = streams.exact || [];
  const halves = streams.exactplaces;
  const exactPlaces = halves ? new Float64Array(halves.buffer) : null;
  for (let i = 0, at = 0; i < exact.length; ++i) {
    const size = exact[i] < triangles ? 6 : 8;
    const before = exactPlaces.subarray(at, at += size);
    const now = about.moved ? exactPlaces.subarray(at, at += size) : before;
    mesh.exact.set(exact[i], [before, now]);
    mesh.isOtherwise[exact[i]] = 1;
  }
  mesh.turned.forEach((e) => { mesh.isOtherwise[e] = 1; });
  return mesh;
}

function quadArea(places, corners, i, j, k) {
  const at = (n, axis) => places[4 * corners[n] + 2 + axis];
  return (at(j, 0) - at(i, 0)) * (at(k, 1) - at(i, 1)) - (at(j, 1) - at(i, 1)) * (at(k, 0) - at(i, 0));
}

const isTriangle = (e) => e < mesh.triangles;
const cornersOf = (e) => isTriangle(e)
  ? mesh.drawn.subarray(3 * e, 3 * e + 3)
  : mesh.quadCorners.subarray(4 * (e - mesh.triangles), 4 * (e - mesh.triangles) + 4);

// The corners' places in steps; now: 0 before, 1 after. One that was listed the other way is turned.
function placesOf(e, now, into, isForValues = false) {
  const {places} = mesh;
  const corners = isTriangle(e) ? mesh.drawn : mesh.quadCorners;
  const first = isTriangle(e) ? 3 * e : 4 * (e - mesh.triangles);
  const count = isTriangle(e) ? 3 : 4;
  for (let i = 0; i < count; ++i) {
    const at = 4 * corners[first + i] + 2 * now;
    into[2 * i] = places[at];
    into[2 * i + 1] = places[at + 1];
  }
  if (mesh.isOtherwise[e] === 0) {
    return into;
  }
  if (mesh.exact.has(e)) {
    into.set(mesh.exact.get(e)[now]);
    // Metrics take them as they are: from where whole steps begin, flat elements near the middle would lose digits.
    for (let i = 0; !isForValues && i < 2 * count; ++i) {
      into[i] -= about.base[i % 2];
    }
  }
  if (now === 0 && mesh.turned.has(e)) {
    const last = 2 * (count - 1);
    [into[0], into[1], into[last], into[last + 1]] = [into[last], into[last + 1], into[0], into[1]];
    if (last === 6) {
      [into[2], into[3], into[4], into[5]] = [into[4], into[5], into[2], into[3]];
    }
  }
  return into;
}

const scratch = new Float64Array(8);
function valueOf(metric, e, now) {
  const evaluate = meshMetrics[isTriangle(e) ? 'triangle' : 'quadrilateral'][metric];
  if (!evaluate) {
    return NaN;
  }
  const p = placesOf(e, now, scratch, true);
  const value = isTriangle(e) ? evaluate(p[0], p[1], p[2], p[3], p[4], p[5])
    : evaluate(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]);
  return metric === 'area' ? value * about.step * about.step : value;
}

function movedDistance(e) {
  let most = 0;
  for (const v of cornersOf(e)) {
    most = Math.max(most, Math.hypot(mesh.places[4 * v + 2] - mesh.places[4 * v], mesh.places[4 * v + 3] - mesh.places[4 * v + 1]));
  }
  return most * about.step;
}

// --- Colours: for each element a byte before and one after; 0 is inverted, 1 has none of the metric.

const lacking = 1;
const worstByte = 2;

const placeOnScale = (scale, value) => scale.reciprocal ? scale.ideal / value : (value - scale.worst) / (scale.ideal - scale.worst);
const byteOf = (place) => place >= 0 ? worstByte + Math.round((255 - worstByte) * Math.min(place, 1)) : Number.isNaN(place) ? lacking : 0;

// Of amounts: the range that most elements are in.
function amountRange(amount, isLogarithmic) {
  const found = [];
  const stride = Math.ceil(mesh.elements / 20000);
  for (let e = 0; e < mesh.elements; e += stride) {
    for (const value of amount(e)) {
      if (value > 0) {
        found.push(value);
      }
    }
  }
  if (found.length === 0) {
    return [0, 1];
  }
  found.sort((p, q) => p - q);
  const high = found[Math.min(Math.floor(found.length * 0.995), found.length - 1)];
  return [isLogarithmic ? found[Math.floor(found.length * 0.005)] : 0, high];
}

function fillByQuality(bytes, metric) {
  for (const kind of ['triangle', 'quadrilateral']) {
    const isOfTriangles = kind === 'triangle';
    const [begin, end] = isOfTriangles ? [0, mesh.triangles] : [mesh.triangles, mesh.elements];
    const evaluate = meshMetrics[kind][metric];
    const shape = metric === 'shape' ? null : meshMetrics[kind].shape;
    const scale = about.scales[kind][metric];
    if (!evaluate) {
      bytes.fill(lacking, 2 * begin, 2 * end);
      continue;
    }
    const p = scratch;
    for (let now = 0; now < 2; ++now) {
      for (let e = begin; e < end; ++e) {
        if (now === 1 && !about.moved) {
          bytes[2 * e + 1] = bytes[2 * e];
          continue;
        }
        placesOf(e, now, p, true);
        const isInverted = shape !== null && shape(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]) < 0;
        bytes[2 * e + now] = isInverted ? 0 : byteOf(placeOnScale(scale, evaluate(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7])));
      }
    }
  }
}

function bytesOfElements(metric) {
  const bytes = new Uint8Array(row * Math.ceil(Math.max(mesh.elements, 1) / row) * 2);
  const states = about.moved ? [0, 1] : [0];
  let legend = {kind: 'quality', metric};
  let byte;
  if (metric === 'region') {
    byte = (e) => worstByte + (mesh.regions ? mesh.regions[e] % about.colours.regions.length : 0);
    legend = {kind: 'region'};
  } else if (metric === 'moved') {
    const [, high] = amountRange((e) => [movedDistance(e)], false);
    byte = (e) => byteOf(high > 0 ? movedDistance(e) / high : 0);
    legend = {kind: 'amount', metric, ends: [0, high], isLogarithmic: false};
  } else if (metric === 'area') {
    const [low, high] = amountRange((e) => states.map((now) => Math.abs(valueOf('area', e, now))), true);
    const wide = Math.log(high / low) || 1;
    byte = (e, now) => {
      const area = valueOf('area', e, now);
      return area > 0 ? Math.max(byteOf(Math.log(area / low) / wide), worstByte) : area < 0 ? 0 : worstByte;
    };
    legend = {kind: 'amount', metric, ends: [low, high], isLogarithmic: true};
  } else {
    fillByQuality(bytes, metric);
    return {bytes, legend};
  }
  for (let e = 0; e < mesh.elements; ++e) {
    bytes[2 * e] = byte(e, 0);
    bytes[2 * e + 1] = about.moved ? byte(e, 1) : bytes[2 * e];
  }
  return {bytes, legend};
}

function mixed(stops, place) {
  let next = 1;
  while (next + 1 < stops.length && place > stops[next][0]) {
    ++next;
  }
  const [low, from] = stops[next - 1];
  const [high, to] = stops[next];
  const part = Math.min(Math.max((place - low) / (high - low), 0), 1);
  return from.map((channel, i) => Math.round(channel + part * (to[i] - channel)));
}

function paletteOf(legend) {
  const palette = new Uint8Array(256 * 4).fill(255);
  const {regions, inverted, amount, quality} = about.colours;
  const colour = (i) => legend.kind === 'region' ? regions[Math.max(i - worstByte, 0) % regions.length]
    : i === 0 ? inverted : i === lacking ? about.colours.lacking
      : mixed(legend.kind === 'amount' ? amount : quality, (i - worstByte) / (255 - worstByte));
  for (let i = 0; i < 256; ++i) {
    palette.set(colour(i), 4 * i);
  }
  return palette;
}
