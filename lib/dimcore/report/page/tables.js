// Pieces of the page. Words from the user are only ever text.
function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function tableOf(columns, rows) {
  const cell = (tag, content, column) => {
    const td = el(tag, { class: column.numbers ? "n" : column.class ?? "" });
    td.append(content instanceof Node ? content : String(content));
    return td;
  };
  return el("div", { class: "wide" }, el("table", {},
    el("thead", {}, el("tr", {}, ...columns.map((c) => { const th = cell("th", c.name, c); th.scope = "col"; return th; }))),
    el("tbody", {}, ...rows.map((row) => el("tr", {}, ...row.map((content, k) => cell("td", content, columns[k])))))));
}

function figure(v, digits = 3) {
  if (v === null || v === undefined || !Number.isFinite(v)) return "–";
  const size = Math.abs(v);
  if (size >= Math.pow(10, digits - 1)) return v.toFixed(0);
  return size === 0 ? "0" : v.toFixed(Math.max(0, Math.min(6, digits - 1 - Math.floor(Math.log10(size)))));
}
const withUnit = (text, unit) => (text === "–" || !unit ? text : `${text} ${unit}`);
const within = (error, unit) => (Number.isFinite(error) ? withUnit("± " + figure(error, 2), unit) : "–");
const ratio = (v) => (Number.isFinite(v) ? v.toFixed(2) : "–");
const plural = (n, one, many = one + "s") => `${n} ${n === 1 ? one : many}`;

function fittingsTable(data) {
  const { fittings } = data.luminaires;
  return tableOf(
    [{ name: "Fitting" }, { name: "Count", numbers: true }, { name: "Flux each, lm", numbers: true },
      { name: "Power each, W", numbers: true }, { name: "lm/W", numbers: true }, { name: "Opening" }, { name: "Intensity", class: "diagram" }],
    fittings.map((f) => [f.name, f.count, figure(f.flux_lm, 4), figure(f.watts), f.watts ? figure(f.flux_lm / f.watts) : "–",
      f.shape + (f.opening_m.some((v) => v > 0) ? ", " + f.opening_m.filter((v) => v > 0).map((v) => figure(v)).join(" × ") + " m" : ""),
      el("img", { src: f.polar, alt: `Polar diagram of the luminous intensity of ${f.name}` })]));
}

// One row a luminaire; of many, one row a field or group of alike ones.
function placesTable(data, most) {
  const { fittings, places } = data.luminaires;
  const rows = [];
  places.forEach((place, k) => {
    const stem = places.length > most ? place.name.replace(/\[.*$/, "").replace(/[\s_-]*\d+$/, "") : place.name;
    const last = rows[rows.length - 1];
    if (places.length > most && last && last.stem === stem && last.fitting === place.fitting && last.group === place.group) {
      last.to = k + 1;
      place.at.forEach((v, axis) => { last.low[axis] = Math.min(last.low[axis], v); last.high[axis] = Math.max(last.high[axis], v); });
    } else {
      rows.push({ stem, from: k + 1, to: k + 1, fitting: place.fitting, group: place.group, aim: place.aim, low: [...place.at], high: [...place.at] });
    }
  });
  const metres = (v) => (Math.abs(v) < 5e-4 ? 0 : v).toFixed(3);
  const range = (row, axis) => (row.high[axis] - row.low[axis] < 1e-9 ? metres(row.low[axis]) : `${metres(row.low[axis])} … ${metres(row.high[axis])}`);
  const aim = (v) => (v[2] < -0.9999 ? "down" : v[2] > 0.9999 ? "up" : v.map((c) => metres(c)).join(", "));
  return tableOf(
    [{ name: "No.", numbers: true }, { name: "Name" }, { name: "Group" }, { name: "Fitting" }, { name: "x, m", numbers: true },
      { name: "y, m", numbers: true }, { name: "z, m", numbers: true }, { name: "Aimed" }],
    rows.map((row) => [row.from === row.to ? row.from : `${row.from}–${row.to}`, row.stem, row.group || "–", fittings[row.fitting].name,
      range(row, 0), range(row, 1), range(row, 2), aim(row.aim)]));
}

function planeFigures(figures) {
  return tableOf(
    [{ name: "Points", numbers: true }, { name: "Mean", numbers: true }, { name: "Stated error", numbers: true }, { name: "Least", numbers: true },
      { name: "Greatest", numbers: true }, { name: "U0", numbers: true }],
    [[figures.lx.length, withUnit(figure(figures.mean, 4), "lx"), within(figures.meanError, "lx"),
      withUnit(figure(figures.min), "lx"), withUnit(figure(figures.max), "lx"), ratio(figures.u0)]]);
}

const REQUIREMENT_NAMES = { illuminance: "Maintained illuminance, mean", uniformity: "Uniformity U0", ugr: "Glare, UGR",
  "colour rendering": "Colour rendering Ra", "power density": "Power density, installed", "daylight factor": "Daylight factor, mean" };

function requirementsTable(findings, moved) {
  return tableOf(
    [{ name: "Where" }, { name: "What" }, { name: "Required", numbers: true }, { name: "Value", numbers: true },
      { name: "Stated error", numbers: true }, { name: "As new", numbers: true }, { name: "Result" }],
    findings.map(({ finding, now }) => {
      const unit = finding.unit === "Ra" ? "" : finding.unit;
      const verdict = el("span", { class: "verdict " + now.verdict.replace(" ", "-") }, now.verdict);
      const result = el("span", {}, verdict, moved && !now.follows ? " (for the lights as reported)" : "");
      return [finding.where, REQUIREMENT_NAMES[finding.what] ?? finding.what,
        (finding.at_most ? "≤ " : "≥ ") + withUnit(String(finding.limit), unit), withUnit(figure(now.value), unit),
        now.error > 0 ? within(now.error, unit) : "–", withUnit(figure(now.initial), unit), result];
    }));
}

function energyTable(data, factors) {
  const percent = (part, whole) => (whole > 0 ? (100 * part / whole).toFixed(2).replace("-0.00", "0.00") + " %" : "–");
  const rows = data.energy.map((e, g) => [data.groups[g].name, figure(factors[g] * data.groups[g].flux_lm, 4), figure(factors[g] * e.emitted_W, 4),
    percent(e.absorbed_W, e.emitted_W), percent(e.escaped_W, e.emitted_W), percent(e.lost_W, e.emitted_W), percent(e.dropped_W, e.emitted_W),
    e.emitted_W > 0 ? (100 * e.open_W / e.emitted_W).toFixed(3) + " %" : "–"]);
  return tableOf([{ name: "Light of" }, { name: "Flux, lm", numbers: true }, { name: "Emitted, W", numbers: true },
    { name: "Absorbed", numbers: true }, { name: "Left the room", numbers: true }, { name: "On backs and bodies", numbers: true },
    { name: "Left out", numbers: true }, { name: "Balance open", numbers: true }], rows);
}
