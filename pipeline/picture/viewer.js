// SPDX-License-Identifier: BSD-3-Clause
// Shows the mesh that a page carries: zooming and panning, colours by a metric, before and after. mesh_view_html.cpp
// writes the page; packed_picture.h says how the mesh is packed. Needs WebGL 2 and DecompressionStream; where they are
// missing, the still picture stays.
'use strict';

(() => {
  const root = document.getElementById('mesh-view');
  const about = JSON.parse(document.getElementById('mesh-about').textContent);
  const find = (name) => root.querySelector('.' + name);
  const stage = find('view-stage');
  const canvas = find('view-canvas');
  const row = 2048;         // places in a row of a texture
  const chunk = 3 * 16384;  // corners that are drawn together or not at all
  const slowFrame = 60;     // milliseconds from which on frames are drawn when the hand rests

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
      const part = bytes.subarray(at, at += size);
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
  function placesOf(e, now, into) {
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
    const p = placesOf(e, now, scratch);
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

  // --- Colours: for each element a byte before and one after; 0 is inverted.

  const placeOnScale = (scale, value) => scale.reciprocal ? scale.ideal / value : (value - scale.worst) / (scale.ideal - scale.worst);
  const byteOf = (place) => place >= 0 ? 1 + Math.round(254 * Math.min(place, 1)) : Number.isNaN(place) ? 1 : 0;

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
        bytes.fill(255, 2 * begin, 2 * end);
        continue;
      }
      const p = scratch;
      for (let now = 0; now < 2; ++now) {
        for (let e = begin; e < end; ++e) {
          if (now === 1 && !about.moved) {
            bytes[2 * e + 1] = bytes[2 * e];
            continue;
          }
          placesOf(e, now, p);
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
      byte = (e) => 1 + (mesh.regions ? mesh.regions[e] % about.colours.regions.length : 0);
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
        return area > 0 ? Math.max(byteOf(Math.log(area / low) / wide), 1) : area < 0 ? 0 : 1;
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
    const colour = (i) => legend.kind === 'region' ? about.colours.regions[(i + about.colours.regions.length - 1) % about.colours.regions.length]
      : i === 0 ? about.colours.inverted
        : mixed(legend.kind === 'amount' ? about.colours.amount : about.colours.quality, (i - 1) / 254);
    for (let i = 0; i < 256; ++i) {
      palette.set(colour(i), 4 * i);
    }
    return palette;
  }

  // --- Drawing.

  const placeCode = `#version 300 es
    precision highp float; precision highp int; precision highp isampler2D; precision highp sampler2D;
    uniform isampler2D places; uniform ivec2 centre; uniform vec2 rest; uniform vec2 scale; uniform float now;
    // In parts of the window from its middle on. Whole steps are subtracted as such: no digit is lost, however near.
    vec2 shown(uint vertex, float when) {
      ivec4 place = texelFetch(places, ivec2(vertex & 2047u, vertex >> 11u), 0);
      return (mix(vec2(place.xy - centre), vec2(place.zw - centre), when) - rest) * scale;
    }`;
  const elementVertexCode = placeCode + `
    uniform sampler2D values; uniform int triangles;
    in uint vertex; flat out float value; out vec3 corner; flat out vec3 hidden;
    void main() {
      int drawn = gl_VertexID / 3;
      int element = drawn < triangles ? drawn : triangles + (drawn - triangles) / 2;
      vec2 both = texelFetch(values, ivec2(element & 2047, element >> 11), 0).rg;
      value = mix(both.r, both.g, now);
      int i = gl_VertexID - 3 * drawn;
      corner = vec3(i == 0, i == 1, i == 2);
      // The diagonal of a quadrilateral is not drawn: it is opposite to the second corner, then to the third.
      hidden = drawn < triangles ? vec3(0) : (drawn - triangles) % 2 == 0 ? vec3(0, 1, 0) : vec3(0, 0, 1);
      gl_Position = vec4(shown(vertex, now), value * 1.8 - 0.9, 1);  // the worst in front
    }`;
  const elementCode = `#version 300 es
    precision highp float;
    uniform sampler2D palette; uniform vec3 line; flat in float value; in vec3 corner; flat in vec3 hidden; out vec4 colour;
    void main() {
      vec3 width = max(fwidth(corner), vec3(1e-9));
      vec3 pixels = corner / width + hidden * 1e4;
      float near = min(pixels.x, min(pixels.y, pixels.z));
      float size = 1.0 / max(width.x, max(width.y, width.z));
      float edge = smoothstep(4.0, 14.0, size) * (1.0 - smoothstep(0.4, 1.2, near)) * 0.6;
      vec3 fill = texelFetch(palette, ivec2(int(value * 255.0 + 0.5), 0), 0).rgb;
      colour = vec4(mix(fill, line, edge), 1);
    }`;
  const lineVertexCode = placeCode + `
    uniform vec2 size; uniform float width; uniform bool areMoves;
    in uvec2 ends;
    void main() {
      vec2 from = shown(ends.x, areMoves ? 0.0 : now) * size;
      vec2 to = shown(ends.y, areMoves ? 1.0 : now) * size;
      vec2 along = to - from;
      float length = max(length(along), 1e-6);
      vec2 across = vec2(-along.y, along.x) / length * width;
      int i = gl_VertexID;
      vec2 at = (i == 0 || i == 1 || i == 3 ? from : to) + (i == 1 || i == 3 || i == 5 ? across : -across);
      gl_Position = vec4(at / size, -0.95, 1);
    }`;
  const pointVertexCode = placeCode + `
    uniform float width;
    in uint vertex;
    void main() { gl_Position = vec4(shown(vertex, now), -0.97, 1); gl_PointSize = width; }`;
  const plainCode = `#version 300 es
    precision highp float; uniform vec4 ink; out vec4 colour;
    void main() { colour = ink; }`;

  class Painter {
    constructor(gl, own) {
      this.gl = gl;
      this.mesh = own;
      this.elements = this.program(elementVertexCode, elementCode);
      this.lines = this.program(lineVertexCode, plainCode);
      this.points = this.program(pointVertexCode, plainCode);
      this.texture(0, gl.RGBA32I, gl.RGBA_INTEGER, gl.INT, own.places, 4);
      this.corners = this.buffer(own.drawn);
      this.boundary = this.buffer(own.boundary);
      this.interfaces = this.buffer(own.interfaces);
      this.chosen = this.buffer(new Uint32Array(0));
      this.held = null;
      this.moves = null;
      this.findBoxes();
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
    }

    program(vertexCode, code) {
      const {gl} = this;
      const program = gl.createProgram();
      for (const [kind, text] of [[gl.VERTEX_SHADER, vertexCode], [gl.FRAGMENT_SHADER, code]]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
      }
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getProgramInfoLog(program));
      }
      return {program, uniform: (name) => gl.getUniformLocation(program, name), attribute: (name) => gl.getAttribLocation(program, name)};
    }

    buffer(numbers) {
      const {gl} = this;
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
      return {buffer, size: numbers.length};
    }

    texture(unit, kept, format, type, numbers, channels) {
      const {gl} = this;
      const width = Math.min(row, numbers.length / channels);
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
      gl.texImage2D(gl.TEXTURE_2D, 0, kept, width, numbers.length / channels / width, 0, format, type, numbers);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }

    colour({bytes, legend}) {
      const {gl} = this;
      this.texture(1, gl.RG8, gl.RG, gl.UNSIGNED_BYTE, bytes, 2);
      this.texture(2, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, paletteOf(legend), 4);
    }

    // What of each chunk there is to see, so that what lies outside of the window costs nothing.
    findBoxes() {
      const {drawn, places} = this.mesh;
      this.boxes = [];
      for (let begin = 0; begin < drawn.length; begin += chunk) {
        const end = Math.min(begin + chunk, drawn.length);
        let [lowX, lowY, highX, highY] = [Infinity, Infinity, -Infinity, -Infinity];
        for (let i = begin; i < end; ++i) {
          const at = 4 * drawn[i];
          lowX = Math.min(lowX, places[at], places[at + 2]);
          highX = Math.max(highX, places[at], places[at + 2]);
          lowY = Math.min(lowY, places[at + 1], places[at + 3]);
          highY = Math.max(highY, places[at + 1], places[at + 3]);
        }
        this.boxes.push({begin, count: end - begin, lowX, lowY, highX, highY});
      }
    }

    use(which, view) {
      const {gl} = this;
      gl.useProgram(which.program);
      const centre = [Math.round(view.x), Math.round(view.y)];
      gl.uniform1i(which.uniform('places'), 0);
      gl.uniform2i(which.uniform('centre'), ...centre);
      gl.uniform2f(which.uniform('rest'), view.x - centre[0], view.y - centre[1]);
      gl.uniform2f(which.uniform('scale'), 2 * view.zoom / view.width, 2 * view.zoom / view.height);
      gl.uniform1f(which.uniform('now'), view.now);
    }

    attach(which, name, {buffer}, size, isInstance) {
      const {gl} = this;
      const place = which.attribute(name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribIPointer(place, size, gl.UNSIGNED_INT, 0, 0);
      gl.vertexAttribDivisor(place, isInstance ? 1 : 0);
      return () => {
        gl.disableVertexAttribArray(place);
        gl.vertexAttribDivisor(place, 0);
      };
    }

    paintElements(view) {
      const {gl} = this;
      this.use(this.elements, view);
      gl.uniform1i(this.elements.uniform('values'), 1);
      gl.uniform1i(this.elements.uniform('palette'), 2);
      gl.uniform1i(this.elements.uniform('triangles'), this.mesh.triangles);
      gl.uniform3f(this.elements.uniform('line'), 0.22, 0.26, 0.31);
      const detach = this.attach(this.elements, 'vertex', this.corners, 1, false);
      const [halfX, halfY] = [view.width / 2 / view.zoom, view.height / 2 / view.zoom];
      for (const box of this.boxes) {
        if (box.highX >= view.x - halfX && box.lowX <= view.x + halfX && box.highY >= view.y - halfY && box.lowY <= view.y + halfY) {
          gl.drawArrays(gl.TRIANGLES, box.begin, box.count);
        }
      }
      detach();
    }

    paintLines(view, lines, ink, width, areMoves = false) {
      if (lines.size === 0) {
        return;
      }
      const {gl} = this;
      this.use(this.lines, view);
      gl.uniform2f(this.lines.uniform('size'), view.width / 2, view.height / 2);
      gl.uniform1f(this.lines.uniform('width'), width / 2);
      gl.uniform1i(this.lines.uniform('areMoves'), areMoves ? 1 : 0);
      gl.uniform4f(this.lines.uniform('ink'), ...ink, 1);
      const detach = this.attach(this.lines, 'ends', lines, 2, true);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, 6, lines.size / 2);
      detach();
    }

    paintHeld(view) {
      const {gl} = this;
      this.held ||= this.buffer(Uint32Array.from(Array.from(this.mesh.held.keys()).filter((v) => this.mesh.held[v] !== 0)));
      this.use(this.points, view);
      gl.uniform1f(this.points.uniform('width'), 5 * view.ratio);
      gl.uniform4f(this.points.uniform('ink'), 0.9, 0.62, 0, 1);
      const detach = this.attach(this.points, 'vertex', this.held, 1, false);
      gl.drawArrays(gl.POINTS, 0, this.held.size);
      detach();
    }

    paintMoves(view) {
      if (!this.moves) {
        const ends = [];
        const {places} = this.mesh;
        for (let v = 0; v < this.mesh.vertices; ++v) {
          if (places[4 * v] !== places[4 * v + 2] || places[4 * v + 1] !== places[4 * v + 3]) {
            ends.push(v, v);
          }
        }
        this.moves = this.buffer(Uint32Array.from(ends));
      }
      this.paintLines(view, this.moves, [0.1, 0.1, 0.1], 1.2 * view.ratio, true);
    }

    choose(e) {
      const corners = e < 0 ? [] : cornersOf(e);
      const ends = new Uint32Array(2 * corners.length);
      for (let i = 0; i < corners.length; ++i) {
        ends.set([corners[i], corners[(i + 1) % corners.length]], 2 * i);
      }
      this.chosen = this.buffer(ends);
    }

    paint(view, show) {
      const {gl} = this;
      gl.viewport(0, 0, view.width, view.height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      this.paintElements(view);
      const ink = show.isDark ? [0.93, 0.95, 0.97] : [0.07, 0.09, 0.11];
      if (show.lines) {
        this.paintLines(view, this.boundary, ink, 1.3 * view.ratio);
        this.paintLines(view, this.interfaces, [0.07, 0.09, 0.11], 2.4 * view.ratio);
      }
      if (show.moves && about.moved) {
        this.paintMoves(view);
      }
      if (show.held && this.mesh.held) {
        this.paintHeld(view);
      }
      this.paintLines(view, this.chosen, [0, 0.83, 0.35], 3 * view.ratio);
    }
  }

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
    view.ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(Math.round(stage.clientWidth * view.ratio), 1);
    const height = Math.max(Math.round(stage.clientHeight * view.ratio), 1);
    if (width === view.width && height === view.height) {
      return false;
    }
    view.zoom *= view.width > 1 ? width / view.width : 1;
    [canvas.width, canvas.height] = [view.width, view.height] = [width, height];
    return true;
  }

  function lookAt(box, margin) {
    view.x = (box.lowX + box.highX) / 2;
    view.y = (box.lowY + box.highY) / 2;
    view.zoom = Math.min(view.width / (box.highX - box.lowX || 1), view.height / (box.highY - box.lowY || 1)) / margin;
    ask();
  }
  const fit = () => lookAt(extent(), 1.06);

  const toSteps = (x, y) => [view.x + (x * view.ratio - view.width / 2) / view.zoom, view.y - (y * view.ratio - view.height / 2) / view.zoom];
  const toWindow = (x, y) => [((x - view.x) * view.zoom + view.width / 2) / view.ratio, (view.height / 2 - (y - view.y) * view.zoom) / view.ratio];

  function zoomBy(factor, x = stage.clientWidth / 2, y = stage.clientHeight / 2) {
    const [fromX, fromY] = toSteps(x, y);
    const box = extent();
    const least = 0.2 * Math.min(view.width / (box.highX - box.lowX || 1), view.height / (box.highY - box.lowY || 1));
    view.zoom = Math.min(Math.max(view.zoom * factor, least), 400);
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
    const now = about.moved ? 1 : 0;
    const [x, y] = shownPlace(middle(e, now));
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

  let nextWorst = 0;
  function toWorst(step) {
    const state = about.moved && view.now >= 0.5 ? 'after' : 'before';
    const known = marks.filter((mark) => mark.state === state);
    if (known.length > 0) {
      nextWorst = (nextWorst + step + known.length) % known.length;
      zoomTo(known[(nextWorst + known.length - 1) % known.length].e, state === 'after' ? 1 : 0);
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
        root.scrollIntoView({block: 'nearest'});
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
    makeMarks();
    makeBackdrop();
    connectPointer();
    connectTools();
    colourBy(find('view-metric').value);
    setNow(view.now);
    fit();
    paint();
    root.classList.add('live');
    root.dataset.state = 'live';
    root.dataset.firstPicture = Math.round(performance.now());
  }

  // For tests, and for those who want to look closer by the browser's console.
  window.trismooth = {valueOf: (metric, number, now) => valueOf(metric, placesByNumber([number]).get(number), now), toWindow: (number) => {
    const e = placesByNumber([number]).get(number);
    return toWindow(...middle(e, about.moved && view.now >= 0.5 ? 1 : 0));
  }};

  begin().catch((error) => leaveStill(`The mesh cannot be shown (${error.message}): here is a still picture of it.`));
})();
