// A plane's values as a field: a lattice over its rectangle, and the lines of equal value on it.

// Place and weights of a cubic through four neighbours (Catmull and Rom) at t squares from the first middle; straight on
// beyond the outermost middles.
function cubicAt(values, known, n, at) {
  const i = Math.max(0, Math.min(n - 2, Math.floor(at))), t = n > 1 ? at - i : 0;
  const v = (k) => values[Math.max(0, Math.min(n - 1, k))];
  if (n === 1) return v(0);
  if (!known(i) || !known(i + 1)) return known(i) && t <= 0.5 ? v(i) : known(i + 1) && t >= 0.5 ? v(i + 1) : NaN;
  const a = v(i), b = v(i + 1);
  const before = i > 0 && known(i - 1) ? v(i - 1) : 2 * a - b, after = i + 2 < n && known(i + 2) ? v(i + 2) : 2 * b - a;
  if (t < 0 || t > 1) return a + (b - a) * t;
  const s = (b - before) / 2, e = (after - a) / 2, t2 = t * t, t3 = t2 * t;
  return a * (2 * t3 - 3 * t2 + 1) + s * (t3 - 2 * t2 + t) + b * (3 * t2 - 2 * t3) + e * (t3 - t2);
}

// grid: values [nv][nu] at the middles of squares, NaN where none is known.
function latticeOf(grid, nu, nv, most) {
  const perSquare = Math.max(1, Math.floor(most / Math.max(nu, nv)));
  const nx = nu * perSquare + 1, ny = nv * perSquare + 1;
  const rows = new Float64Array(nx * nv), values = new Float64Array(nx * ny);
  for (let j = 0; j < nv; j++) {
    const row = grid.subarray(j * nu, (j + 1) * nu), known = (k) => k >= 0 && k < nu && !Number.isNaN(row[k]);
    for (let i = 0; i < nx; i++) rows[j * nx + i] = cubicAt(row, known, nu, i / perSquare - 0.5);
  }
  const column = new Float64Array(nv), known = (k) => k >= 0 && k < nv && !Number.isNaN(column[k]);
  for (let i = 0; i < nx; i++) {
    for (let j = 0; j < nv; j++) column[j] = rows[j * nx + i];
    for (let j = 0; j < ny; j++) values[j * nx + i] = Math.max(0, cubicAt(column, known, nv, j / perSquare - 0.5));
  }
  return { nx, ny, values };
}

// Segments [x0, y0, x1, y1] of one level, in lattice steps, by marching squares; saddles as their mean has it.
function segmentsAt(lattice, level) {
  const { nx, ny, values } = lattice, segments = [];
  const cut = (a, b) => (level - a) / (b - a);
  for (let j = 0; j + 1 < ny; j++) {
    for (let i = 0; i + 1 < nx; i++) {
      const a = values[j * nx + i], b = values[j * nx + i + 1];
      const c = values[(j + 1) * nx + i + 1], d = values[(j + 1) * nx + i];
      let kind = (a >= level ? 1 : 0) | (b >= level ? 2 : 0) | (c >= level ? 4 : 0) | (d >= level ? 8 : 0);
      if (kind === 0 || kind === 15 || Number.isNaN(a + b + c + d)) continue;
      const south = () => [i + cut(a, b), j], east = () => [i + 1, j + cut(b, c)];
      const north = () => [i + cut(d, c), j + 1], west = () => [i, j + cut(a, d)];
      if (kind === 5 || kind === 10) {
        const joined = ((a + b + c + d) / 4 >= level) === (kind === 5);
        segments.push([...west(), ...(joined ? north() : south())], [...east(), ...(joined ? south() : north())]);
        continue;
      }
      if (kind > 7) kind = 15 - kind;
      const ends = { 1: [west, south], 2: [south, east], 3: [west, east], 4: [east, north], 6: [south, north], 7: [west, north] };
      segments.push([...ends[kind][0](), ...ends[kind][1]()]);
    }
  }
  return segments;
}

// The customary series … 100 150 200 300 500 750 …, as `dimout contour` has it.
function customaryLevels(least, greatest) {
  if (!(greatest - least > 1e-9 * greatest)) return [];
  const series = (mantissas) => {
    const levels = [], low = Math.max(least, 0.01 * greatest);
    for (let decade = Math.floor(Math.log10(low)); decade <= Math.floor(Math.log10(greatest)); decade++)
      for (const mantissa of mantissas) {
        const level = decade < 0 ? mantissa / Math.pow(10, -decade) : mantissa * Math.pow(10, decade);
        if (level > low && level < greatest) levels.push(level);
      }
    return levels;
  };
  const levels = series([1, 1.5, 2, 3, 5, 7.5]);
  if (levels.length > 12) return series([1, 2, 5]);
  if (levels.length >= 4) return levels;
  const span = greatest - least, power = Math.pow(10, Math.floor(Math.log10(span)));
  const step = power * [0.1, 0.2, 0.5, 1].find((factor) => span / (factor * power) <= 8);
  const steps = [];
  for (let i = Math.floor(least / step) + 1; i * step < greatest; i++) steps.push(Number((i * step).toPrecision(6)));
  return steps;
}

// A round upper end of a colour scale from zero, and its step.
function roundScale(greatest) {
  if (!(greatest > 0)) return { top: 1, step: 0.25 };
  const roundUp = (v) => {
    const power = Math.pow(10, Math.floor(Math.log10(v)));
    return power * [1, 2, 2.5, 5, 10].find((m) => m * power >= v * (1 - 1e-9));
  };
  const step = roundUp(greatest / 8);
  return { top: step * Math.ceil(greatest / step * (1 - 1e-6)), step };
}
