// Draws what renderer.py hands out: one scene after the other, into a frame that is read back.
const canvas = document.createElement("canvas");
const gl = canvas.getContext("webgl2", { antialias: false });
for (const name of ["EXT_color_buffer_float", "EXT_float_blend", "OES_texture_float_linear"]) {
  if (!gl.getExtension(name)) throw new Error(`WebGL lacks ${name}`);
}

function makeProgram(vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

const text = await (await fetch("/draw.glsl")).text();
const drawing = makeProgram("#version 300 es\n#define VERTEX\n" + text, "#version 300 es\n" + text);
// Depth to a colour that can be read: WebGL reads no depth back.
const showing = makeProgram(
  "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }",
  `#version 300 es
  precision highp float;
  uniform highp sampler2D depth;
  out vec4 color;
  void main() { color = vec4(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r); }`);

const VERTEX_FLOATS = 24;
const COLORS = { rgba8: [gl.RGBA8, gl.UNSIGNED_BYTE], rgba32f: [gl.RGBA32F, gl.FLOAT] };
const DEPTHS = {
  z16: [gl.DEPTH_COMPONENT16, gl.DEPTH_ATTACHMENT],
  z24: [gl.DEPTH24_STENCIL8, gl.DEPTH_STENCIL_ATTACHMENT],
  z32f: [gl.DEPTH32F_STENCIL8, gl.DEPTH_STENCIL_ATTACHMENT],
};

function makeTarget(format, width, height) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

function makeTexture(of, floats) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  of.levels.forEach(([width, height, at], level) => {
    const texels = floats.subarray(at, at + 4 * width * height);
    gl.texImage2D(gl.TEXTURE_2D, level, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, texels);
  });
  for (const [name, value] of Object.entries(of.integers)) {
    gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], typeof value === "string" ? gl[value] : value);
  }
  for (const [name, value] of Object.entries(of.floats)) gl.texParameterf(gl.TEXTURE_2D, gl["TEXTURE_" + name], value);
  return texture;
}

function enable(what, wanted) {
  if (wanted) gl.enable(what);
  else gl.disable(what);
}

function setState(draw) {
  enable(gl.CULL_FACE, draw.cull !== null);
  if (draw.cull) gl.cullFace(gl[draw.cull]);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl[draw.depth_func]);
  gl.depthMask(draw.depth_mask);
  gl.depthRange(...draw.depth_range);
  gl.enable(gl.POLYGON_OFFSET_FILL);
  gl.polygonOffset(...draw.polygon_offset);
  gl.colorMask(...draw.color_mask);
  enable(gl.SCISSOR_TEST, draw.scissor !== null);
  if (draw.scissor) gl.scissor(...draw.scissor);
  enable(gl.STENCIL_TEST, draw.stencil !== null);
  for (const [face, s] of Object.entries(draw.stencil ?? {})) {
    gl.stencilFuncSeparate(gl[face], gl[s.func], s.reference, s.mask);
    gl.stencilOpSeparate(gl[face], gl[s.fail], gl[s.depth_fail], gl[s.pass]);
    gl.stencilMaskSeparate(gl[face], s.write_mask);
  }
  enable(gl.BLEND, draw.blend !== null);
  if (draw.blend) {
    const { rgb, alpha, color } = draw.blend;
    gl.blendFuncSeparate(gl[rgb.source], gl[rgb.destination], gl[alpha.source], gl[alpha.destination]);
    gl.blendEquationSeparate(gl[rgb.equation], gl[alpha.equation]);
    gl.blendColor(...color);
  }
}

function drawOne(draw, scene, bytes, floats, textures) {
  setState(draw);
  gl.bufferData(gl.ARRAY_BUFFER, floats.subarray(draw.first, draw.first + draw.count * VERTEX_FLOATS), gl.STREAM_DRAW);
  gl.bufferData(gl.UNIFORM_BUFFER, bytes.subarray(draw.uniforms, draw.uniforms + 80), gl.STREAM_DRAW);
  gl.bindTexture(gl.TEXTURE_2D, textures[draw.texture]);
  gl.drawArrays(gl[draw.topology], 0, draw.count);
}

function drawScene(scene, bytes, floats) {
  const { width, height } = scene;
  const [colorFormat, colorType] = COLORS[scene.color], [depthFormat, attachment] = DEPTHS[scene.depth];
  const color = makeTarget(colorFormat, width, height), depth = makeTarget(depthFormat, width, height);
  const shown = makeTarget(gl.RGBA32F, width, height), frame = gl.createFramebuffer();
  const textures = scene.textures.map((texture) => makeTexture(texture, floats));
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, depth, 0);
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error("this frame's formats");
  gl.viewport(0, 0, width, height);
  gl.disable(gl.SCISSOR_TEST);
  gl.colorMask(true, true, true, true);
  gl.depthMask(true);
  gl.stencilMask(255);
  gl.clearColor(...scene.clear_color);
  gl.clearDepth(scene.clear_depth);
  gl.clearStencil(scene.clear_stencil);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  gl.useProgram(drawing);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, gl.createBuffer());
  for (let i = 0; i < VERTEX_FLOATS / 4; ++i) {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, 4, gl.FLOAT, false, VERTEX_FLOATS * 4, i * 16);
  }
  for (const draw of scene.draws) drawOne(draw, scene, bytes, floats, textures);
  const colors = colorType === gl.FLOAT ? new Float32Array(4 * width * height) : new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, colorType, colors);

  gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, null, 0);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, shown, 0);
  for (const test of [gl.DEPTH_TEST, gl.BLEND, gl.SCISSOR_TEST, gl.STENCIL_TEST, gl.CULL_FACE]) gl.disable(test);
  gl.colorMask(true, true, true, true);
  gl.useProgram(showing);
  gl.bindTexture(gl.TEXTURE_2D, depth);
  for (let i = 0; i < VERTEX_FLOATS / 4; ++i) gl.disableVertexAttribArray(i);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const depths = new Float32Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, depths);
  for (const texture of [color, depth, shown, ...textures]) gl.deleteTexture(texture);
  gl.deleteFramebuffer(frame);
  const error = gl.getError();
  if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
  return [new Float32Array(colors), depths.filter((z, i) => i % 4 === 0)];
}

for (;;) {
  const bytes = new Uint8Array(await (await fetch("/scene")).arrayBuffer());
  const [length] = new Uint32Array(bytes.buffer, 0, 1);
  const scene = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const floats = new Float32Array(bytes.buffer, 4 + length);
  try {
    await fetch("/frame", { method: "POST", body: new Blob(drawScene(scene, bytes.subarray(4 + length), floats)) });
  } catch (error) {
    await fetch("/failed", { method: "POST", body: String(error) });
  }
}
