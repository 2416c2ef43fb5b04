// SPDX-License-Identifier: BSD-3-Clause
// Paints the mesh with WebGL 2.

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
