// Figures of receivers and eyes for the lights as the sliders have them, and what they mean for a requirement.

// Mean, least and greatest value and U0 with their stated errors. Errors of mixed light are at most the sum of the
// groups' own.
function figuresOf(target, factors) {
  const n = target.values.length ? target.values[0].length : 0;
  if (n === 0) return { mean: NaN, min: NaN, max: NaN, u0: NaN, meanError: NaN, u0Error: NaN, lx: new Float32Array(0) };
  const lx = new Float64Array(n);
  let meanError = 0;
  target.values.forEach((values, g) => {
    if (factors[g] === 0) return;
    for (let i = 0; i < n; i++) lx[i] += factors[g] * values[i];
    meanError += factors[g] * target.meanErrors[g];
  });
  let sum = 0, weight = 0, min = Infinity, max = -Infinity, darkest = 0;
  for (let i = 0; i < n; i++) {
    const w = target.weights ? target.weights[i] : 1;
    sum += w * lx[i];
    weight += w;
    if (lx[i] < min) { min = lx[i]; darkest = i; }
    if (lx[i] > max) max = lx[i];
  }
  const mean = sum / weight, u0 = mean > 0 ? min / mean : 0;
  let minError = 0;
  target.errors.forEach((errors, g) => { minError += factors[g] * errors[darkest]; });
  return { mean, min, max, u0, meanError, u0Error: mean > 0 ? (minError + u0 * meanError) / mean : 0, lx };
}

// The greatest UGR over the eyes of a rating, NaN where no light dazzles. Each source's luminance goes as its group's
// factor, so the sum of L^2 omega / p^2 by its square and the background as the factor itself.
function worstUgr(rating, factors) {
  let worst = NaN, at = -1;
  for (let eye = 0; eye < rating.sums[0].length; eye++) {
    let sum = 0, background = 0;
    for (let g = 0; g < factors.length; g++) {
      sum += factors[g] * factors[g] * rating.sums[g][eye];
      background += factors[g] * rating.backgrounds[g][eye];
    }
    if (!(sum > 0) || !(background > 0)) continue;
    const ugr = 8 * Math.log10(0.25 / background * sum);
    if (!(ugr <= worst)) { worst = ugr; at = eye; }
  }
  return { ugr: worst, eye: at };
}

// Of mixed light on all surfaces, relative to it: what a UGR's logarithm may be off by.
function errorShare(groups, factors) {
  let flux = 0, error = 0;
  groups.forEach((g, k) => { flux += factors[k] * g.surfaces_lm; error += factors[k] * g.surfaces_error_lm; });
  return flux > 0 ? error / flux : 0;
}

function verdictOf(value, error, limit, atMost) {
  if (!Number.isFinite(value)) return "undecided";
  const v = atMost ? -value : value, l = atMost ? -limit : limit;
  return v - error >= l ? "met" : v + error < l ? "not met" : "undecided";
}

// A finding for other lights than it was made for; `follows` is false where only the program can tell.
function findingFor(finding, room, factors) {
  const asIs = { value: finding.value, initial: finding.initial, error: finding.error, verdict: finding.verdict, follows: false };
  const night = factors.map((f, g) => (room.groups[g].daylight ? 0 : f));
  const kept = night.map((f, g) => f * room.groups[g].kept);
  const target = room.targets.find((t) => t.name === finding.where && (t.kind === "surface") === finding.surface);
  const judged = (value, initial, error) =>
    ({ value, initial, error, verdict: verdictOf(value, error, finding.limit, finding.at_most), follows: true });
  if (finding.what === "illuminance" && target) {
    const f = figuresOf(target, kept);
    return judged(f.mean, figuresOf(target, night).mean, f.meanError);
  }
  if (finding.what === "uniformity" && target) {
    const f = figuresOf(target, kept);
    return judged(f.u0, figuresOf(target, night).u0, f.u0Error);
  }
  if (finding.what === "power per 100 lx" && target && finding.installed !== undefined) {
    const f = figuresOf(target, kept), power = finding.installed;
    return judged(100 * power / f.mean, 100 * power / figuresOf(target, night).mean, f.meanError / f.mean * 100 * power / f.mean);
  }
  if (finding.what === "ugr") {
    const rating = room.glare.find((r) => r.kind === "plane" && r.name === finding.where);
    if (!rating) return asIs;
    const { ugr } = worstUgr(rating, night);
    const result = judged(ugr, ugr, 8 / Math.LN10 * errorShare(room.groups, night));
    if (!Number.isFinite(ugr)) result.verdict = "met";
    return result;
  }
  if (finding.what === "power density") return { ...asIs, follows: true };
  return asIs;
}
