// Numbers that the program packed: base64 of deflated little-endian values.
async function unpackBytes(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function unpackFloats(text) { return new Float32Array((await unpackBytes(text)).buffer); }
async function unpackIndices(text) { return new Uint32Array((await unpackBytes(text)).buffer); }

// Codes of a picture: differences to the left (a row's first: from above), zigzag, low bytes before high ones.
async function unpackCodes(text, width) {
  const bytes = await unpackBytes(text);
  const n = bytes.length / 2;
  const codes = new Uint16Array(n);
  for (let i = 0; i < n; i++) {
    const zigzag = bytes[i] | (bytes[n + i] << 8);
    const difference = zigzag & 1 ? -((zigzag + 1) >> 1) : zigzag >> 1;
    codes[i] = (i % width !== 0 ? codes[i - 1] : i >= width ? codes[i - width] : 0) + difference;
  }
  return codes;
}

const LUMINANCE_CODES = 16383, LUMINANCE_STEP = 8.5e-4, CHROMATICITY_STEP = 1 / 1024;

// A group's light in a picture, CIE XYZ in cd/m2 at full output: Y of each pixel, and X and Z as shares of it, one
// number each where the light is of one colour.
async function unpackPicture(part, width, height) {
  const n = width * height;
  const light = { Y: new Float32Array(n), x: part.xy[0] / part.xy[1], z: (1 - part.xy[0] - part.xy[1]) / part.xy[1] };
  if (part.greatest === 0) return light;
  const luminances = new Float32Array(LUMINANCE_CODES + 1);
  for (let c = 1; c <= LUMINANCE_CODES; c++) luminances[c] = part.greatest * Math.exp((c - LUMINANCE_CODES) * LUMINANCE_STEP);
  const codes = await unpackCodes(part.luminance, width);
  for (let i = 0; i < n; i++) light.Y[i] = luminances[codes[i]];
  if (!part.x) return light;
  const x = await unpackCodes(part.x, width), y = await unpackCodes(part.y, width);
  light.X = new Float32Array(n);
  light.Z = new Float32Array(n);
  for (let i = 0; i < n; i++) {
    if (y[i] === 0) continue;
    light.X[i] = light.Y[i] * x[i] / y[i];
    light.Z[i] = light.Y[i] * (1 / CHROMATICITY_STEP - x[i] - y[i]) / y[i];
  }
  return light;
}
