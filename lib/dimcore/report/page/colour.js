// From CIE XYZ to a screen's sRGB, as `dimout image` does it: exposure, adaptation to the lamps' white (Bradford),
// highlights rolled off, colours brought in at constant luminance, a fixed dither.
const D65 = [0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290];
const BRADFORD = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];
const SHOULDER = 0.6, AUTO_KEY = 0.35, MOST_ABOVE = 2;

const timesVector = (m, v) => m.map((r) => r[0] * v[0] + r[1] * v[1] + r[2] * v[2]);
const timesMatrix = (a, b) => a.map((r) => [0, 1, 2].map((j) => r[0] * b[0][j] + r[1] * b[1][j] + r[2] * b[2][j]));
function inverse(m) {
  const [[a, b, c], [d, e, f], [g, h, i]] = m;
  const det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  return [[e * i - f * h, c * h - b * i, b * f - c * e], [f * g - d * i, a * i - c * g, c * d - a * f],
    [d * h - e * g, b * g - a * h, a * e - b * d]].map((r) => r.map((v) => v / det));
}
const RGB_TO_XYZ = (() => {
  const columns = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]].map(([x, y]) => [x / y, 1, (1 - x - y) / y]);
  const rows = [0, 1, 2].map((i) => columns.map((c) => c[i]));
  const amount = timesVector(inverse(rows), D65);
  return rows.map((r) => r.map((v, j) => v * amount[j]));
})();
const XYZ_TO_RGB = inverse(RGB_TO_XYZ);

// XYZ of the scene to linear display RGB, 1 being the display's white.
function displayMatrix(sceneWhite, whiteLuminance) {
  const shown = timesVector(XYZ_TO_RGB, sceneWhite);
  const neutral = shown.every((v) => v > 0) ? sceneWhite : D65;
  const from = timesVector(BRADFORD, neutral.map((v) => v / neutral[1])), to = timesVector(BRADFORD, D65);
  const scale = [0, 1, 2].map((i) => [0, 1, 2].map((j) => (i === j ? to[i] / from[i] : 0)));
  const adapt = timesMatrix(inverse(BRADFORD), timesMatrix(scale, BRADFORD));
  return timesMatrix(XYZ_TO_RGB, adapt).map((r) => r.map((v) => v / whiteLuminance));
}

// The luminance shown as white that suits a picture: nine tenths of it, in their logarithmic mean, look mid-grey.
function automaticWhite(Y) {
  const lit = Y.filter((v) => v > 0).sort();
  if (lit.length === 0) return 1;
  const rank = Math.floor(0.9 * (lit.length - 1)), bright = lit[rank];
  let sum = 0;
  for (let i = 0; i <= rank; i++) sum += Math.log(Math.max(lit[i] / bright, 1e-3));
  return Math.max(bright * Math.exp(sum / (rank + 1)) / AUTO_KEY, bright / MOST_ABOVE);
}

const ENCODED = (() => {
  const table = new Float32Array(16385);
  for (let i = 0; i <= 16384; i++) {
    const v = i / 16384;
    table[i] = 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055);
  }
  return table;
})();

function ditherPattern(width, height) {
  const fraction = (v) => v - Math.floor(v);
  const pattern = new Float32Array(width * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      pattern[y * width + x] = 1e-3 + 0.998 * fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
  return pattern;
}

// X, Y, Z [n] to RGBA bytes.
function paintLight(X, Y, Z, m, dither, rgba) {
  const [m00, m01, m02] = m[0], [m10, m11, m12] = m[1], [m20, m21, m22] = m[2];
  const [w0, w1, w2] = RGB_TO_XYZ[1];
  for (let i = 0, at = 0; i < Y.length; i++, at += 4) {
    const x = X[i], y = Y[i], z = Z[i];
    let r = m00 * x + m01 * y + m02 * z, g = m10 * x + m11 * y + m12 * z, b = m20 * x + m21 * y + m22 * z;
    let luminance = w0 * r + w1 * g + w2 * b;
    if (luminance > SHOULDER) {
      const t = (luminance - SHOULDER) / (1 - SHOULDER);
      const shown = SHOULDER + (1 - SHOULDER) * t / (1 + t), factor = shown / luminance;
      r *= factor; g *= factor; b *= factor; luminance = shown;
    }
    const low = r < g ? (r < b ? r : b) : (g < b ? g : b), high = r > g ? (r > b ? r : b) : (g > b ? g : b);
    if (low < 0 || high > 1) {
      const grey = luminance > 0 ? luminance : 0;
      let kept = 1;
      if (low < 0) kept = grey / (grey - low);
      if (high > 1) kept = Math.min(kept, (1 - grey) / (high - grey));
      r = grey + kept * (r - grey); g = grey + kept * (g - grey); b = grey + kept * (b - grey);
    }
    const step = dither[i];
    rgba[at] = ENCODED[(r * 16384 + 0.5) | 0] + step;
    rgba[at + 1] = ENCODED[(g * 16384 + 0.5) | 0] + step;
    rgba[at + 2] = ENCODED[(b * 16384 + 0.5) | 0] + step;
    rgba[at + 3] = 255;
  }
}
